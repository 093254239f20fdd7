#!/usr/bin/python3
"""`froude validate` seen from outside: the hand-over to froude-validate, the list of cases, the exit status.

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
NAMES = {file.parent.name for file in (SOURCE / "validation").glob("*/accept.toml")}


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
        for arguments in (["--json", "validate"], ["validate", "--list", "--json"]):
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
class List(Validate):
    def test_names_every_case_with_its_question_one_a_line(self):
        lines = self.answer("validate", "--list", "--data", "no_data").splitlines()
        self.assertEqual({line.split()[0] for line in lines}, NAMES)
        self.assertEqual(len(lines), len(NAMES))
        for line in lines:
            self.assertRegex(line, r"^\S+  +[A-Z].*\?( \(reference data are absent: [\w, -]+\))?$")

    def test_tells_which_reference_data_are_absent(self):
        wanted = ["validate", "--list", "hulme", "dispersion", "--data"]
        lines = self.answer(*wanted, "no_data").splitlines()
        self.assertTrue(lines[0].endswith("hemisphere? (reference data are absent: hulme_hemisphere)"), lines[0])
        self.assertNotIn("absent", lines[1])
        (self.folder / "data" / "hulme_hemisphere").mkdir(parents=True)
        self.assertNotIn("absent", self.answer(*wanted, "data"))

    def test_speaks_json(self):
        cases = json.loads(self.answer("validate", "--list", "--json", "--data", "no_data"))["cases"]
        self.assertEqual({case["case"] for case in cases}, NAMES)
        hulme = next(case for case in cases if case["case"] == "hulme")
        self.assertTrue(hulme["question"].startswith("Do coefficients read from a panel code"))
        self.assertEqual((hulme["reference_data"], hulme["reference_data_absent"]), (["hulme_hemisphere"],) * 2)

    def test_refuses_unknown_cases_and_a_page_of_nothing(self):
        self.refuses(self.froude("validate", "--list", "hulm"), 'did you mean "hulme"?')
        self.refuses(self.froude("validate", "--list", "--page", "page.md"), "--list", "--page")


@unittest.skipUnless(CASES_ARE_BUILT, "built without the cases")
class Run(Validate):
    def test_help_is_that_of_validate(self):
        for arguments in (["validate", "-h"], ["-h", "validate"]):
            text = self.answer(*arguments)
            self.assertIn("Usage: froude validate", text)
            self.assertIn("froude validate ", text.split("Example")[1])
            for option in ("--list", "--folder", "--data", "--page", "--reference-curves"):
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
