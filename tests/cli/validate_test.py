#!/usr/bin/python3
"""`froude validate` seen from outside: the hand-over to froude-validate, the exit status.

    validate_test.py FROUDE SOURCE [FROUDE_VALIDATE]

Without the last argument the build has no cases; `froude validate` must then say so, and the rest is skipped.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE = Path(sys.argv[1]).resolve()
SOURCE = Path(sys.argv[2]).resolve()
CASES_ARE_BUILT = len(sys.argv) > 3 and sys.argv[3] != ""


class Validate(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_cli_"))
        (self.folder / "no_data").mkdir()

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments, program=FROUDE):
        return subprocess.run([str(program), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=300)

    def answer(self, *arguments):
        result = self.froude(*arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)
        return result.stdout

    def refuses(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)


class HandOver(Validate):
    def test_the_help_of_froude_names_the_command(self):
        self.assertIn("validate", self.answer("-h"))
        self.refuses(self.froude("valdate"), 'did you mean "validate"?')

    def test_a_lone_froude_says_what_is_missing_and_what_to_do(self):
        alone = shutil.copy(FROUDE, self.folder / "froude")
        result = self.froude("validate", "dispersion", program=alone)
        self.refuses(result, str(self.folder / "froude-validate"), "No such file", "install froude-validate", "build the target")
        self.assertEqual(result.stdout, "")
        for arguments in (["--json", "validate"], ["validate", "--json"]):
            result = self.froude(*arguments, program=alone)
            self.refuses(result)
            self.assertIn("install froude-validate", json.loads(result.stdout)["error"]["remedy"])

    def test_arguments_arrive_as_they_were_given(self):
        alone = shutil.copy(FROUDE, self.folder / "froude")
        other = self.folder / "froude-validate"
        other.write_text('#!/bin/sh\nprintf "<%s>" "$@"\nexit 3\n')
        other.chmod(0o755)
        result = self.froude("--quiet", "validate", "two words", "", "validate", "--page", "p*.md", program=alone)
        self.assertEqual((result.returncode, result.stdout), (3, "<--quiet><two words><><validate><--page><p*.md>"))

    def test_other_commands_are_kept(self):
        self.refuses(self.froude("plan", "validate"), "validate", "No such file")


@unittest.skipUnless(CASES_ARE_BUILT, "built without the cases")
class Run(Validate):
    def test_help_is_that_of_validate(self):
        for arguments in (["validate", "-h"], ["-h", "validate"]):
            text = self.answer(*arguments)
            self.assertIn("Usage: froude validate", text)
            self.assertIn("froude validate ", text.split("Example")[1])
            for option in ("--folder", "--data", "--page", "--reference-curves", "--json", "--quiet"):
                self.assertIn(option, text)

    def test_status_is_zero_within_the_limits_and_one_outside(self):
        self.assertIn("2 passed, 0 failed", self.answer("validate", "dispersion"))
        shutil.copytree(SOURCE / "validation" / "dispersion", self.folder / "cases" / "dispersion")
        file = self.folder / "cases" / "dispersion" / "accept.toml"
        file.write_text(file.read_text().replace("at_most = 1e-14", "at_most = 1e-20"))
        result = self.froude("validate", "dispersion", "--folder", "cases")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("1 passed, 1 failed", result.stdout)

    def test_wrong_words_are_told_as_everywhere(self):
        self.refuses(self.froude("validate", "--fast"), "--fast", "froude validate --help")
        result = self.froude("validate", "dispersal", "--json")
        self.refuses(result, 'did you mean "dispersion"?')
        self.assertIn("dispersal", json.loads(result.stdout)["error"]["rule"])
        self.refuses(self.froude("validate", "--data", "nowhere"), "no such folder of reference data")

    def test_flags_may_stand_before_the_command(self):
        self.assertEqual(json.loads(self.answer("--json", "validate", "dispersion"))["passed"], 2)
        self.assertEqual(self.answer("--quiet", "validate", "dispersion"), "")


if __name__ == "__main__":
    os.environ.pop("FROUDE_REFERENCE_DATA", None)
    unittest.main(argv=sys.argv[:1])
