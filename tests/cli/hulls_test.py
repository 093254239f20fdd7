#!/usr/bin/python3
"""`froude bem solve` of hulls and scenes with meshes: one and two hulls, what the doctor says of the result, what is kept,
wrong input.

    hulls_test.py FROUDE SOURCE
"""
import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
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


SCENE = """schema = 1
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "5 m"
[waves]
kind = "regular"
height = "0.1 m"
period = "2 s"
heading = "30 deg"
[[body]]
name = "box"
mass = "1200 kg"
centre_of_gravity = "(0, 0, -0.2) m"
radii_of_gyration = "(0.4, 0.6, 0.7) m"
[body.hydrodynamics]
{}
excitation = true
radiation = {{ memory_tolerance = 2e-2 }}
hydrostatics = true
[ask]
rao = {{ periods = "1.6 s .. 4 s, 13 values" }}
accuracy = 2e-2
"""
MESH = 'mesh = "box.obj"\nfrequencies = "0.5 rad/s .. 6 rad/s, 23 values"\nmesh_tolerance = 0.2'


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

    def responses(self, name, *, env=None):
        done = subprocess.run([str(FROUDE), "--json", "rao", f"{name}.toml", "-o", f"{name}.rao.h5", "--csv", f"{name}.csv"],
                              cwd=self.folder, capture_output=True, text=True, timeout=240, env=env)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / f"{name}.csv", encoding="utf-8", newline="") as table:
            rows = list(csv.reader(line for line in table if not line.startswith("#")))
        return rows[0], [[float(x) for x in row] for row in rows[1:]], json.loads(done.stdout)

    def test_a_scene_with_a_mesh_answers_as_with_the_file_that_was_solved_of_it(self):
        (self.folder / "mesh.toml").write_text(SCENE.format(MESH))
        (self.folder / "file.toml").write_text(SCENE.format('file = "box.h5"'))
        self.froude("bem", "solve", "box.obj", "--density", "1000 kg/m^3", "--depth", "5 m", "--frequencies",
                    "0.5 rad/s .. 6 rad/s, 23 values", "--headings", "30 deg .. 30 deg, 1 values", "--cog", "(0, 0, 0) m", "--tolerance", "0.2",
                    "-o", "box.h5")
        names, by_mesh, _ = self.responses("mesh")
        same, by_file, _ = self.responses("file")
        self.assertEqual(names, same)
        self.assertGreater(len(by_mesh), 10)
        for ours, theirs in zip(by_mesh, by_file):
            for a, b in zip(ours, theirs):
                self.assertAlmostEqual(a, b, delta=1e-9 * max(abs(b), 1e-6))
        told = json.loads(self.froude("--json", "bem", "solve", "mesh.toml", "-o", "scene.h5").stdout)
        self.assertEqual(told["planes_of_symmetry"], 2)
        again = json.loads(self.froude("--json", "bem", "info", "scene.h5").stdout)["files"][0]
        first = json.loads(self.froude("--json", "bem", "info", "box.h5").stdout)["files"][0]
        self.assertEqual(again["omega_rad_per_s"], first["omega_rad_per_s"])
        self.assertAlmostEqual(again["bodies"][0]["A33_infinite_kg"] / first["bodies"][0]["A33_infinite_kg"], 1, places=12)

    def test_what_was_solved_is_kept_and_the_plan_knows(self):
        environment = {**os.environ, "FROUDE_CACHE": "on", "XDG_CACHE_HOME": str(self.folder / "kept")}
        (self.folder / "mesh.toml").write_text(SCENE.format(MESH))

        def plan():
            return subprocess.run([str(FROUDE), "plan", "mesh.toml"], cwd=self.folder, capture_output=True, text=True, timeout=240,
                                  env=environment, check=True).stdout

        self.assertIn("coefficients of meshes", plan())  # which solves them, since the rest depends on them
        self.assertTrue(list((self.folder / "kept/froude").glob("*.coefficients")))
        self.assertIn("none of which is to be done again", plan())
        _, first, told = self.responses("mesh", env=environment)
        self.assertTrue(any("solved before and kept" in note for note in told["notes"]), told["notes"])
        _, without, _ = self.responses("mesh", env={**os.environ, "FROUDE_CACHE": "off"})
        self.assertEqual(first, without)

    def test_a_run_that_is_interrupted_while_it_solves_ends_soon(self):
        (self.folder / "fine.obj").write_text(box(10))
        scene = SCENE.format(MESH.replace("box.obj", "fine.obj").replace("23 values", "4000 values"))
        (self.folder / "fine.toml").write_text(scene.replace("[ask]", '[ask]\nrun = { duration = "10 s", every = "0.1 s" }'))
        run = subprocess.Popen([str(FROUDE), "run", "fine.toml", "-o", "fine.h5"], cwd=self.folder, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, env={**os.environ, "FROUDE_CACHE": "off"})
        self.addCleanup(run.kill)  # of one that has ended it does nothing
        time.sleep(3)
        self.assertIsNone(run.poll(), "it solves for minutes")
        run.send_signal(signal.SIGINT)
        _, told = run.communicate(timeout=60)  # one frequency of each processor, the refined one among them
        self.assertEqual(run.returncode, 128 + signal.SIGINT, told)
        self.assertIn("interrupted by SIGINT while hulls were solved", told)
        self.assertFalse((self.folder / "fine.h5").exists())

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
        self.refused(str(SOURCE / "examples/cylinders.toml"), "--density", "1000 kg/m^3", *out, parts=["--density is for meshes"])
        self.assertFalse((self.folder / "x.h5").exists())
        narrow = SCENE.format(MESH.replace(".. 6 rad/s", ".. 3 rad/s"))
        (self.folder / "narrow.toml").write_text(narrow)
        message = self.froude("rao", "narrow.toml", "-o", "narrow.h5", status=2).stderr
        for part in ("narrow.toml:17:8", "high-frequency tail", "compute higher frequencies", "accept = ["):
            self.assertIn(part, message)  # the doctor looks at what is used: without the tail there is no memory
        (self.folder / "narrow.toml").write_text(narrow.replace("radiation = { memory_tolerance = 2e-2 }\n", ""))
        message = self.froude("rao", "narrow.toml", "-o", "narrow.h5", status=2).stderr
        for part in ("given from 0.5 to 3 rad/s", "at more frequencies"):
            self.assertIn(part, message)
        (self.folder / "neither.toml").write_text(SCENE.format('file = "box.h5"'))
        self.refused("neither.toml", *out, parts=["no body of the scene has cylinders or a mesh"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
