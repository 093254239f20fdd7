"""Tutorials are followed as they stand: each command runs, and prints what the page shows. Usage: tutorials_test.py FROUDE SOURCE

Where froude-film is not built beside froude, the tutorial on films is skipped.
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from documents import commands_of, missing_line, same_line

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
TUTORIALS = SOURCE / "docs" / "tutorials"
HAS_FILMS = (FROUDE.parent / "froude-film").exists()


class Tutorials(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_tutorial_"))
        shutil.copytree(SOURCE / "examples", self.folder / "examples")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def follow(self, name, least):
        commands = commands_of((TUTORIALS / name).read_text(encoding="utf-8"))
        self.assertGreaterEqual(len(commands), least)
        self.assertTrue(any(command.printed for command in commands))
        for command in commands:
            with self.subTest(command=command.words):
                done = subprocess.run([str(FROUDE), *command.words[1:]], cwd=self.folder, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, text=True, timeout=300, check=False)
                self.assertEqual(done.returncode, 0, done.stdout)
                missing = missing_line(command.printed, done.stdout.splitlines())
                self.assertIsNone(missing, f"the page shows\n{missing}\nand the command printed\n{done.stdout}")

    def test_on_coefficients(self):
        self.follow("coefficients.md", 3)

    def test_on_arrays(self):
        self.follow("arrays.md", 4)

    def test_on_spectra(self):
        self.follow("spectra.md", 4)

    @unittest.skipUnless(HAS_FILMS, "froude-film is not built")
    def test_on_film(self):
        self.follow("film.md", 4)

    def test_have_a_test_each(self):
        tested = {f"{name.removeprefix('test_on_')}.md" for name in dir(self) if name.startswith("test_on_")}
        self.assertEqual(tested, {path.name for path in TUTORIALS.glob("*.md")} - {"README.md"})


class Comparison(unittest.TestCase):
    def test_takes_a_difference_of_one_in_the_last_digit_and_no_other(self):
        for shown, printed, same in (
                ("cd 1.2185, 95 %", "  cd         1.2186, 95 %", True),
                ("cd 1.2185, 95 %", "  cd         1.2187, 95 %", False),
                ("cd 1.2185", "cd -1.2185", False),
                ("cd 1.2185", "ca 1.2185", False),
                ("noise 2.9e-05 m/s", "noise 3e-05 m/s", True),
                ("noise 2.9e-05 m/s", "noise 2.9e-04 m/s", False),
                ("1.78 s …", "1.78 s of work and more", True),
                ("1.78 s", "1.78 s of work and more", False)):
            with self.subTest(shown=shown, printed=printed):
                self.assertEqual(same_line(shown, printed), same)

    def test_takes_lines_in_order_and_one_after_the_other(self):
        printed = ["a 1", "b 2", "c 3"]
        for shown, missing in ((["a 1", "b 2"], None), (["a 1", "…", "c 3"], None), (["a 1", "c 3"], "c 3"),
                               (["b 2", "…", "a 1"], "a 1"), (["c 3", "d 4"], "d 4")):
            with self.subTest(shown=shown):
                self.assertEqual(missing_line(shown, printed), missing)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
