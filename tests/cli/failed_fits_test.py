#!/usr/bin/python3
"""No value leaves a fit that failed: neither on the screen, nor in JSON, nor in a file.

    failed_fits_test.py FROUDE SOURCE

Exit status 1 for a check that failed, 3 for numerics that gave up.
"""
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE = Path(sys.argv[1]).resolve()
SOURCE = Path(sys.argv[2]).resolve()


class FitsWithoutAnEnd(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_fits_"))
        self.addCleanup(shutil.rmtree, self.folder)
        example = SOURCE / "examples" / "fit"
        shutil.copy(example / "pendulums_scene.toml", self.folder)
        # Two windows of 2 s of the six are enough to fail.
        rows = (example / "pendulums.csv").read_text(encoding="utf-8").splitlines(keepends=True)
        (self.folder / "pendulums.csv").write_text("".join(rows[:103]), encoding="utf-8")
        self.scene = (example / "pendulums.toml").read_text(encoding="utf-8")

    def fit(self, *options):
        return subprocess.run([str(FROUDE), *options, "fit", "pendulums.toml", "-o", "fit.toml"], cwd=self.folder,
                              capture_output=True, text=True, timeout=300)

    def fails(self, old, new, status, *words):
        self.assertIn(old, self.scene)
        (self.folder / "pendulums.toml").write_text(self.scene.replace(old, new), encoding="utf-8")
        told, document = self.fit(), self.fit("--json")
        for result in (told, document):
            self.assertEqual(result.returncode, status, result.stderr)
            for word in ("no value is told", *words):
                self.assertIn(word, result.stderr)
        self.assertNotIn("interval", told.stdout)
        self.assertEqual(list(json.loads(document.stdout)), ["error"])
        self.assertFalse((self.folder / "fit.toml").exists())

    def test_iterations_that_are_used_up_are_numerics_that_gave_up(self):
        self.fails('window = "2 s"', 'window = "2 s"\niterations = 1', 3, "all 1 of its iterations", "starts")

    def test_residuals_that_the_statement_does_not_allow_are_a_check_that_failed(self):
        self.fails("0.6 deg", "0.1 deg", 1, "pendulums.toml:8:61:", "stated as 0.00175 rad, which allows", "accept")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
