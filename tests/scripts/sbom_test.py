#!/usr/bin/python3
"""The list of libraries is whole, and the archive of a commit is the same bits twice.

    sbom_test.py SOURCE
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()


def run(*words):
    return subprocess.run([str(word) for word in words], cwd=SOURCE, capture_output=True, text=True, check=False)


class Shipped(unittest.TestCase):
    def test_every_library_that_cmake_looks_for_is_listed_with_version_and_licence(self):
        answer = run("scripts/sbom")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        document = json.loads(answer.stdout)
        self.assertEqual(document["bomFormat"], "CycloneDX")
        needed = [each for each in document["components"] if each["scope"] == "required"]
        self.assertGreater(len(needed), 10)
        for component in needed:
            self.assertTrue(component.get("version"), component["name"] + " is not installed")
        self.assertTrue(all(each["licenses"][0]["expression"] for each in document["components"]))

    def test_what_reports_bring_from_npm_is_listed_at_the_version_of_the_lock_file(self):
        listed = {each["name"]: each for each in json.loads(run("scripts/sbom").stdout)["components"]}
        wanted = json.loads((SOURCE / "apps/report/web/package.json").read_text())["dependencies"]
        self.assertEqual(set(wanted), {"uplot", "three"})
        for name, version in wanted.items():
            self.assertEqual((listed[name]["version"], listed[name]["licenses"][0]["expression"], listed[name]["scope"]),
                             (version, "MIT", "optional"))

    def test_what_is_needed_is_what_set_up_installs(self):
        listed = {line.strip() for line in (SOURCE / "scripts/apt-packages.txt").read_text().splitlines()}
        for component in json.loads(run("scripts/sbom").stdout)["components"]:
            package = component["properties"][0]["value"]
            if component["scope"] == "required" and package != "libc6-dev":  # which g++ brings
                self.assertIn(package, listed)

    def test_the_archive_is_the_same_bits_twice(self):
        if run("git", "rev-parse", "HEAD").returncode != 0:
            self.skipTest("not a clone: no commit to archive")
        with tempfile.TemporaryDirectory() as folder:
            archives = [Path(folder) / f"{number}.tar.gz" for number in range(2)]
            for archive in archives:
                answer = run("scripts/archive", archive)
                self.assertEqual(answer.returncode, 0, answer.stderr)
            self.assertEqual(archives[0].read_bytes(), archives[1].read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
