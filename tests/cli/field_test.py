"""`froude field`: the free surface about bodies. Usage: field_test.py FROUDE SOURCE"""
import cmath
import csv
import json
import math
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
OMEGA, HEADING = 1.2, math.radians(30)

SCENE = """schema = 1
[water]
density = "1025 kg/m^3"
depth = "20 m"
[[body]]
name = "float"
position = "({x}, {y}, 0) m"
mass = "258.319 t"
centre_of_gravity = "(-0.46, 0, 0.2) m"
radii_of_gyration = "(3, 6.5, 6.5) m"
[body.hydrodynamics]
excitation = true
radiation = {{}}
hydrostatics = true
{hydrodynamics}
[[damping]]
on = "float"
linear = {{ surge = "2 kN s/m", sway = "2 kN s/m", yaw = "200 kN m s/rad" }}
[[mooring]]
on = "float"
kind = "linear"
stiffness = {{ surge = "20 kN/m", sway = "20 kN/m", yaw = "2 MN m/rad" }}
[ask]
field = {{ omega = "1.2 rad/s", heading = "30 deg", x = "{x0} m .. {x1} m, 3 values", y = "{y0} m .. {y1} m, 2 values"{more} }}
accuracy = 5e-2
"""
MESH = 'mesh = "barge.obj"\nfrequencies = "1.1 rad/s .. 1.3 rad/s, 3 values"'
CYLINDER = ('[body.hydrodynamics.cylinders]\nat = "(0, 0, 0) m"\ndiameter = "10 m"\ndraught = "3.2089 m"\n'
            'frequencies = "1.1 rad/s .. 1.3 rad/s, 3 values"')


def wavenumber(depth=20, gravity=9.81):
    k = OMEGA ** 2 / gravity
    for _ in range(50):
        k = OMEGA ** 2 / gravity / math.tanh(k * depth)
    return k


class Field(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_field_"))
        shutil.copy(SOURCE / "examples/data/barge.obj", self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, scene, *arguments):
        (self.folder / "scene.toml").write_text(scene, encoding="utf-8")
        return subprocess.run([str(FROUDE), "field", "scene.toml", "-o", "field.h5", *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=280)

    def scene(self, hydrodynamics, at=(0, 0), more=""):
        return SCENE.format(x=at[0], y=at[1], hydrodynamics=hydrodynamics, more=more, x0=at[0] - 20, x1=at[0] + 30,
                            y0=at[1] - 15, y1=at[1] + 12)

    def elevations(self, scene):
        done = self.froude(scene, "--csv", "field.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [r for r in csv.reader(r for r in (self.folder / "field.csv").read_text().splitlines() if r[0] != "#")]
        self.assertEqual(rows[0], ["x [m]", "y [m]", "amplitude [m/m]", "phase [rad]"])
        return [cmath.rect(float(a), float(p)) for _, _, a, p in rows[1:]]

    def test_moves_along_with_the_bodies_in_the_phase_of_the_wave(self):
        way = (130, -70)
        phase = cmath.exp(-1j * wavenumber() * (way[0] * math.cos(HEADING) + way[1] * math.sin(HEADING)))
        for hydrodynamics in (MESH, CYLINDER):
            here, there = (self.elevations(self.scene(hydrodynamics, at)) for at in ((0, 0), way))
            self.assertEqual(len(here), 6)
            for a, b in zip(here, there):
                # What is printed has ten digits; the phase, of 130 m, is as good as the wavenumber.
                self.assertLess(abs(a * phase - b), 1e-7)

    def test_of_bodies_that_move_differs_from_that_of_bodies_held_still(self):
        free = self.elevations(self.scene(CYLINDER))
        held = self.elevations(self.scene(CYLINDER, more=', bodies = "held"'))
        self.assertGreater(max(abs(a - b) for a, b in zip(free, held)), 0.05)

    def test_is_told_and_drawn(self):
        done = self.froude(self.scene(CYLINDER), "--json", "--picture", "field.svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual((told["points"], told["points_told"], told["held"]), (6, 6, False))
        self.assertLess(told["error"], 0.05)
        self.assertGreater(told["highest"]["amplitude"], told["lowest"]["amplitude"])
        picture = (self.folder / "field.svg").read_text(encoding="utf-8")
        for text in ("amplitude [m/m]", "elevation at t = 0 [m/m]", "x [m]", "y [m]"):
            self.assertIn(text, picture)

    def test_is_refused_where_it_cannot_be_told(self):
        shutil.copy(SOURCE / "examples/data/pontoon5.nc", self.folder)
        near = self.scene(MESH, more=', bodies = "held"').replace("x = \"-20 m", "x = \"11.8 m").replace(
            "y = \"-15 m", "y = \"0.1 m").replace("accuracy = 5e-2", "accuracy = 1e-5")  # at the bow
        for scene, said in (
                (self.scene(CYLINDER).replace(
                    "field = {", "rao = { omega = \"1.1 rad/s .. 1.3 rad/s, 3 values\", heading = \"30 deg\" }\n#"),
                 "does not ask for"),
                (self.scene('file = "pontoon5.nc"\nbody = 1'), "coefficients come from a file"),
                (self.scene(CYLINDER).replace("-20 m .. 30 m, 3 values", "-20 m .. -20 m, 1 values"), "a grid needs two"),
                (self.scene(CYLINDER).replace('omega = "1.2 rad/s", heading', "heading"), "omega"),
                (near, "is known to")):
            with self.subTest(said=said):
                done = self.froude(scene)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(said, done.stderr)
                self.assertFalse((self.folder / "field.h5").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
