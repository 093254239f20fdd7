#!/usr/bin/python3
"""What scripts/setup and CMake say on machines that lack something, played by stand-ins for the system's programs.

    refusals_test.py SOURCE_DIR
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
TOOLS = ("bash", "sed", "grep", "mktemp", "rm", "sleep", "tail", "dirname", "env", "cat")


class Refusals(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.bin = pathlib.Path(folder.name)

    def stand_in(self, name, script):
        file = self.bin / name
        file.write_text(f"#!/bin/bash\n{script}\n")
        file.chmod(0o755)

    def setup_with(self, *arguments, **programs):
        """scripts/setup on a machine of these programs alone, beside the plain tools."""
        for tool in TOOLS:
            (self.bin / tool).symlink_to(f"/bin/{tool}" if os.path.exists(f"/bin/{tool}") else f"/usr/bin/{tool}")
        for name, script in programs.items():
            self.stand_in(name.replace("_", "-"), script)
        return subprocess.run(["/bin/bash", SOURCE / "scripts/setup", *arguments], env={"PATH": str(self.bin)}, capture_output=True,
                              text=True)

    def test_nothing_is_done_where_all_packages_are_there(self):
        ran = self.setup_with(dpkg_query="echo installed", apt_get="exit 1")
        self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "", ""))

    def test_without_root_and_sudo_the_missing_packages_are_named_in_one_line(self):
        ran = self.setup_with(dpkg_query="exit 1", apt_get="exit 1", id="echo 1000")
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, r"^setup: packages are missing, and there is neither root nor sudo .*libceres-dev.*\n$")

    def test_without_a_network_the_missing_packages_are_named(self):
        ran = self.setup_with(dpkg_query="exit 1", apt_get="echo 'Could not resolve'; exit 100", id="echo 0")
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr.splitlines()[-1], r"^setup: .* is there a network\? .*libceres-dev")

    def test_an_optional_part_is_installed_by_its_name_and_not_waited_for_else(self):
        ran = self.setup_with("camera", dpkg_query="exit 1", apt_get="exit 1", id="echo 1000")
        self.assertRegex(ran.stderr, r"libopencv-videoio-dev")
        self.assertNotIn("libceres-dev", ran.stderr)
        self.assertNotIn("opencv", (SOURCE / "scripts/apt-packages.txt").read_text())

    def test_a_part_that_there_is_not_is_refused(self):
        ran = self.setup_with("camra", dpkg_query="echo installed", apt_get="exit 1")
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, r'no part "camra"; there are scripts/setup camera, mpi, report and site')

    def test_a_system_without_apt_is_told_so(self):
        ran = self.setup_with(id="echo 0")
        self.assertEqual(ran.returncode, 1)
        self.assertRegex(ran.stderr, r"^setup: this is no Debian: .*apt-packages.txt.*\n$")

    def test_a_compiler_that_is_too_old_is_named(self):
        self.stand_in("old-g++", 'exec g++ -w -U__GNUC__ -D__GNUC__=11 "$@"')
        ran = subprocess.run(["cmake", "-S", SOURCE, "-B", self.bin / "build", "-G", "Ninja",
                              f"-DCMAKE_CXX_COMPILER={self.bin / 'old-g++'}"], capture_output=True, text=True)
        self.assertNotEqual(ran.returncode, 0)
        told = " ".join(ran.stderr.split())
        self.assertIn("Froude needs g++ 12 or newer", told)
        self.assertIn("old-g++", told)


unittest.main(verbosity=2)
