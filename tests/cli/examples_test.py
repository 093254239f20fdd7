"""Every example scene of motion answers what it asks. Usage: examples_test.py FROUDE SOURCE"""
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


class Examples(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_examples_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_answer_what_they_ask(self):
        scenes = sorted((SOURCE / "examples").glob("*.toml"))
        self.assertGreaterEqual(len(scenes), 4)
        for scene in scenes:
            asked = [what for what in ("rao", "modes", "field", "run") if what in tomllib.loads(scene.read_text())["ask"]]
            self.assertTrue(asked, scene.name)
            for what in asked:
                with self.subTest(scene=scene.name, what=what):
                    result = self.folder / f"{scene.stem}.{what}.h5"
                    done = subprocess.run([str(FROUDE), what, str(scene), "-o", str(result)], capture_output=True,
                                          text=True, timeout=300)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertTrue(result.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
