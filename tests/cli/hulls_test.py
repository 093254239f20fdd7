#!/usr/bin/python3
"""`froude bem solve` of hulls: one and two of them, what the doctor says of the result, wrong input.

    hulls_test.py FROUDE SOURCE
"""
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


def box(cuts, at=0.0, low=-0.5):
    """A box 2 m x 1.2 m, closed half a metre above z = 0, its faces cut in squares: OBJ."""
    lines, count = [], 0
    size, corner = (2.0, 1.2, 0.5 - low), (at - 1.0, -0.6, low)
    for axis in range(3):
        for far in (False, True):
            for i in range(cuts):
                for j in range(cuts):
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        t = [0.0, 0.0, 0.0]
                        t[axis], t[(axis + 1) % 3], t[(axis + 2) % 3] = float(far), (i + a) / cuts, (j + b) / cuts
                        lines.append("v " + " ".join(f"{corner[k] + size[k] * t[k]:.9g}" for k in range(3)))
                    four = [count + 1, count + 2, count + 3, count + 4]
                    lines.append("f " + " ".join(map(str, four if far else four[::-1])))
                    count += 4
    return "\n".join(lines) + "\n"


class Hulls(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_hulls_"))
        (self.folder / "box.obj").write_text(box(8))
        self.water = ["--density", "1000 kg/m^3", "--depth", "5 m", "--frequencies", "0.5 rad/s .. 6 rad/s, 56 values"]

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments, status=0):
        done = subprocess.run([str(FROUDE), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=240)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def refused(self, *arguments, parts):
        message = self.froude("bem", "solve", *arguments, status=2).stderr
        for part in parts:
            self.assertIn(part, message)

    def test_a_box_is_solved_and_the_doctor_has_no_warning(self):
        told = json.loads(self.froude("--json", "bem", "solve", "box.obj", *self.water, "--headings", "0 deg .. 90 deg, 4 values",
                                      "--cog", "(0, 0, 0) m", "-o", "box.h5").stdout)
        self.assertEqual(told["planes_of_symmetry"], 2)
        self.assertGreater(told["lid_panels"], 0)
        self.assertLess(told["self_check"]["haskind"], 0.1)
        checked = json.loads(self.froude("--json", "bem", "check", "box.h5").stdout)["files"][0]
        self.assertEqual((checked["errors"], checked["warnings"]), (0, 0), checked)
        info = json.loads(self.froude("--json", "bem", "info", "box.h5").stdout)["files"][0]
        self.assertAlmostEqual(info["bodies"][0]["displaced_volume_m3"], 1.2, places=6)
        self.assertAlmostEqual(info["bodies"][0]["C33_N_per_m"], 1000 * 9.81 * 2.4, delta=1)

    def test_a_tolerance_refines_and_tells_the_error(self):
        (self.folder / "coarse.obj").write_text(box(2))
        told = json.loads(self.froude("--json", "bem", "solve", "coarse.obj", *self.water[:4], "--frequencies", "0.5 rad/s .. 2.5 rad/s, 9 values",
                                      "--headings", "0 deg .. 90 deg, 2 values", "--tolerance", "0.05", "-o", "coarse.h5").stdout)
        self.assertEqual(len(told["extrapolated_from_panels"]), 2)
        self.assertGreater(told["extrapolated_from_panels"][1], 3 * told["extrapolated_from_panels"][0])
        self.assertLess(told["self_check"]["estimated_error"], 0.05)
        self.assertTrue(any("interpolated" in note for note in told["notes"]), told["notes"])

    def test_two_hulls_are_solved_together(self):
        (self.folder / "other.obj").write_text(box(4, at=3.0))
        told = json.loads(self.froude("--json", "bem", "solve", "box.obj", "other.obj", "--density", "1000 kg/m^3", "--depth", "5 m",
                                      "--frequencies", "1 rad/s .. 2 rad/s, 2 values", "--reference", "(0, 0, 0) m",
                                      "--reference", "(3, 0, 0) m", "-o", "both.1").stdout)
        self.assertEqual(told["planes_of_symmetry"], 1)
        self.assertTrue((self.folder / "both.1").exists())

    def test_the_workboat_of_the_guide_is_solved(self):
        shutil.copytree(SOURCE / "examples", self.folder / "examples")
        text = (SOURCE / "docs/guide/coefficients.md").read_text(encoding="utf-8").replace("\\\n", " ")
        commands = [line for line in text.splitlines() if line.startswith("    froude bem solve examples/data/workboat.obj")]
        self.assertEqual(len(commands), 1)
        import shlex
        self.froude(*shlex.split(commands[0])[1:])
        self.froude("bem", "check", "workboat.h5")

    def test_what_is_wrong_is_told_with_its_remedy(self):
        out = ["-o", "x.h5"]
        self.refused("box.obj", *out, parts=["--density is needed", "1025 kg/m^3"])
        self.refused("box.obj", "box.obj", *self.water, *out, parts=["is inside"])
        self.refused("box.obj", *self.water[:2], "--depth", "0.4 m", *self.water[4:], *out, parts=["reaches 0.5 m", "0.4 m"])
        (self.folder / "high.obj").write_text(box(2, low=0.1))
        self.refused("high.obj", *self.water, *out, parts=["under water"])
        self.refused("box.obj", *self.water, "-o", "box.obj", parts=["box.obj"])
        self.refused("box.obj", *self.water, *out, "--cog", "(0, 0, 0) m", "--cog", "(0, 0, 0) m", parts=["--cog gives 2 points"])
        self.refused("box.obj", *self.water, *out, "--reverse", parts=["inside out"])
        (self.folder / "coarse.obj").write_text(box(2))
        self.refused("coarse.obj", *self.water[:4], "--frequencies", "1 rad/s .. 2 rad/s, 2 values", "--tolerance", "0.0001", *out,
                     parts=["estimated at", "0.0001 is asked for", "make the mesh finer"])
        self.refused(str(SOURCE / "examples/cylinders.toml"), "--density", "1000 kg/m^3", *out, parts=["--density is for hulls"])
        self.assertFalse((self.folder / "x.h5").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
