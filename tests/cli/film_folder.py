"""What tests of films share: the examples copied into a folder of their own, and `froude` called there."""
import csv
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


def rows_of(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


class WithFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="froude_film_"))
        for name in ("fit", "film"):
            shutil.copytree(SOURCE / "examples" / name, cls.folder / name)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def froude(cls, *arguments):
        return subprocess.run([str(FROUDE), *map(str, arguments)], cwd=cls.folder, capture_output=True, text=True,
                              timeout=300)

    def done(self, *arguments):
        ran = self.froude(*arguments)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return ran.stdout

    def refused(self, *arguments):
        ran = self.froude(*arguments)
        self.assertEqual(ran.returncode, 2, ran.stdout + ran.stderr)
        return ran.stderr
