"""The commands that pages of the guide tell are run as they stand there. Usage: guide_commands_test.py FROUDE SOURCE"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from documents import commands_of

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
PAGES = {"experiments.md": 6, "export.md": 6, "field.md": 3, "tank-day.md": 4, "lines.md": 4, "response.md": 4, "spectra.md": 3, "stability.md": 2}  # and how many commands at least
HAS_REPORTS = "has no reports" not in subprocess.run(
    [str(FROUDE), "report", "x.h5", "-o", "x.html"], capture_output=True, text=True, check=False).stderr
if HAS_REPORTS:  # an optional part of a build
    PAGES["report.md"] = 5


class GuideCommands(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_guide_"))
        shutil.copytree(SOURCE / "examples", self.folder / "examples")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_froude(self, *arguments):
        return subprocess.run([str(FROUDE), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def test_run_as_they_stand_in_the_guide(self):
        for page, least in PAGES.items():
            commands = [command.words for command in commands_of((SOURCE / "docs/guide" / page).read_text(encoding="utf-8"))]
            self.assertGreaterEqual(len(commands), least, page)
            for command in commands:
                with self.subTest(page=page, command=command):
                    done = self.run_froude(*command[1:])
                    self.assertEqual(done.returncode, 0, done.stderr)
                    for option in ("--picture", "--table", "-o"):
                        if option in command:
                            self.assertTrue((self.folder / command[command.index(option) + 1]).exists())

    def test_have_one_error_with_its_remedy_where_what_they_need_is_wrong(self):
        swing = ["experiment", "oscillation", "--viscosity", "1.05e-6 m^2/s"]
        tow = ["experiment", "tow", "--viscosity", "1.05e-6 m^2/s", "--tank", "60 m"]
        waves = ["experiment", "waves", "--period", "1.6 s", "--height", "0.06 m", "--depth", "1.25 m", "--gauge", "20 m"]
        for arguments, said in (
                (swing + ["--diameter", "0.12 m", "--kc", "20"], "leaves open: period, speed, Re, beta"),
                (swing + ["--diameter", "0.12", "--kc", "20"], "--diameter"),
                (swing + ["--diameter", "0.12 m", "--kc", "20", "--period", "4 s", "--width", "0.05"], "--width needs --noise"),
                (swing + ["--diameter", "0.12 m", "--kc", "20", "--period", "4 s", "--noise", "2 N"],
                 "does not act without --width"),
                (tow + ["--diameter", "0.12 m"], "two are needed"),
                (tow + ["--diameter", "-0.12 m", "--re", "1e5"], "must be positive"),
                (tow + ["--diameter", "0.12 m", "--re", "1e5", "--width", "0.01"], "--width needs --noise"),
                (waves + ["--body", "70 m", "--end", "60 m"], "must stand between"),
        ):
            with self.subTest(arguments=arguments):
                done = self.run_froude(*arguments)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(said, done.stderr)
                self.assertEqual(done.stderr.count("error:"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
