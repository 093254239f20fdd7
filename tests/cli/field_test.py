"""`froude field`: the free surface about bodies. Usage: field_test.py FROUDE SOURCE"""
import base64
import cmath
import csv
import json
import math
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
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
MORE = ", accepted_drift_error = 0.2"  # its panels know the surface to 5e-2, and the drift to 0.12
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
            here, there = (self.elevations(self.scene(hydrodynamics, at, MORE)) for at in ((0, 0), way))
            self.assertEqual(len(here), 6)
            for a, b in zip(here, there):
                # What is printed has ten digits; the phase, of 130 m, is as good as the wavenumber.
                self.assertLess(abs(a * phase - b), 1e-7)

    def pressures(self, scene):
        """Of each panel: centre, normal, area, dynamic and hydrostatic pressure."""
        done = self.froude(scene, "--pressure-csv", "hulls.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = (self.folder / "hulls.csv").read_text().splitlines()
        self.assertIn("# body 1 is float", lines)
        rows = [[float(v) for v in line.split(",")] for line in lines if line[0].isdigit()]
        self.assertEqual({row[0] for row in rows}, {1})
        return [(row[1:4], row[4:7], row[7], cmath.rect(*row[8:10]), cmath.rect(*row[10:12])) for row in rows]

    def test_pressures_move_along_and_accelerate_the_body(self):
        """Heave has neither damper nor mooring, so that pressures alone carry it: Newton's law at the centre of gravity."""
        more, way = ", pressure = true" + MORE, (130, -70)
        here, there = (self.pressures(self.scene(MESH, at, more=more)) for at in ((0, 0), way))
        phase = cmath.exp(-1j * wavenumber() * (way[0] * math.cos(HEADING) + way[1] * math.sin(HEADING)))
        largest = max(abs(p) for *_, p, _ in here)
        for a, b in zip(here, there):
            self.assertLess(math.dist([a[0][0] + way[0], a[0][1] + way[1], a[0][2]], b[0]), 1e-9)
            self.assertLess(abs(a[3] * phase - b[3]), 1e-7 * largest)
            self.assertLess(abs(a[4] * phase - b[4]), 1e-7 * largest)
        heave = -sum((dynamic + still) * normal[2] * area for _, normal, area, dynamic, still in here)
        # A float that keeps its waterplane level in roll: the still water's pressure tells how any place of it rises.
        (x, _, _), *_, first = here[0]
        far = max(here, key=lambda panel: abs(panel[0][0] - x))
        mirrored = next(p for p in here if math.dist(p[0], [far[0][0], -far[0][1], far[0][2]]) < 1e-6)
        opposite = next(p for p in here if math.dist(p[0], [x, -here[0][0][1], here[0][0][2]]) < 1e-6)
        a, b = (first + opposite[4]) / 2, (far[4] + mirrored[4]) / 2  # on the middle line
        rise = (a + (b - a) * (-0.46 - x) / (far[0][0] - x)) / (-1025 * 9.81)
        inertia = -OMEGA ** 2 * 258.319e3 * rise
        # Coefficients of 5e-2 of their modes, and pressures as good; the restoring that both share is larger.
        restoring = 1025 * 9.81 * 24 * 9 * abs(rise)
        self.assertGreater(abs(rise), 0.1)
        self.assertLess(abs(heave - inertia), 0.05 * restoring)

    def test_is_exported_with_its_hulls_over_a_period(self):
        done = self.froude(self.scene(MESH, more=', bodies = "held", pressure = true'))
        self.assertEqual(done.returncode, 0, done.stderr)
        export = [str(FROUDE), "export", "field.h5", "-o", "field.pvd"]
        done = subprocess.run(export, cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = xml.parse(self.folder / "field.pvd").getroot().findall("Collection/DataSet")
        self.assertEqual([one.get("name") for one in listed], 24 * ["surface"] + 24 * ["hulls"])
        self.assertAlmostEqual(float(listed[12].get("timestep")), math.pi / OMEGA, places=12)  # half a period
        self.assertEqual((self.folder / "field_vtk/names.csv").read_text(), "part,number,name\nhulls,1,float\n")
        first, half = (xml.parse(self.folder / listed[24 + i].get("file")).getroot() for i in (0, 12))

        def cells(grid, name):  # under eight bytes of their length, numbers of four
            bytes_of = base64.b64decode(grid.find(f".//CellData/DataArray[@Name='{name}']").text)
            return struct.unpack(f"<{(len(bytes_of) - 8) // 4}f", bytes_of[8:])

        self.assertGreater(max(cells(first, "amplitude")), 5000)
        for a, b in zip(cells(first, "pressure"), cells(half, "pressure")):
            self.assertAlmostEqual(a, -b, delta=1e-2)  # seven digits of ten thousand
        done = subprocess.run([*export, "--every", "1 s"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertIn("do not apply to the .pvd of a field", done.stderr)

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
                (near, "is known to"),
                (self.scene(MESH), "the mean drift is known to 0.12 of its largest, and 0.05 is asked for"),
                (self.scene(CYLINDER, more=", pressure = true"), "the pressure on bodies of cylinders is not told"),
                (self.scene(MESH, more=', bodies = "held", pressure = true').replace("accuracy = 5e-2", "accuracy = 1e-2"),
                 "the pressure is known to"),
                (self.scene(MESH, more=", accepted_pressure_error = 0.1"), "acts only beside")):
            with self.subTest(said=said):
                done = self.froude(scene)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(said, done.stderr)
                self.assertFalse((self.folder / "field.h5").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
