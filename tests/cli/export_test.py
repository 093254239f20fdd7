"""froude export: tables, MATLAB files and ParaView collections, read back by other code and held against the result.

    export_test.py FROUDE SOURCE
"""
import base64
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import h5py
import numpy as np

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SCENE = """schema = 1
[water]
density = "1000 kg/m^3"
depth = "20 m"
[waves]
kind = "regular"
height = "0.4 m"
period = "4 s"
heading = "30 deg"
ramp = "6 s"
[[body]]
name = "buoy"
position = "(3, -2, 0) m"
mass = "900 kg"
inertia = "(300, 500, 700) kg m^2"
centre_of_gravity = "(0, 0, -0.1) m"
weight = true
buoyancy = { spheres = { at = "(0, 0, 0) m", diameter = "1.6 m" } }
initial = { yaw = "40 deg", pitch = "10 deg" }
[[member]]
on = "buoy"
from = "(0, 0, 0) m"
to = "(0, 0, 2) m"
diameter = "0.2 m"
drag = { cd = 1.0 }
[[line]]
name = "rope"
from = "(0, 0, 0) m"
to = "(4, 0, 0) m"
length = "6 m"
segments = 4
mass_per_length = "2 kg/m"
[ask]
run = { duration = "4 s", every = "0.1 s", of = ["buoy.*", "rope.*", "wave.elevation"] }
"""


def told(*words, cwd=None, status=0):
    ran = subprocess.run([str(FROUDE), *map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=120)
    assert ran.returncode == status, (words, ran.returncode, ran.stdout, ran.stderr)
    return ran.stdout if status == 0 else ran.stderr


def rows(path):
    """Header and numbers of a table, without its comments."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return lines[0], lines[1:]


def text_of(dataset):
    return "" if dataset.attrs.get("MATLAB_empty", 0) else dataset[()].tobytes().decode("utf-16-le")


class Grid:
    """A .vtu, read by what VTK's description of its XML says."""

    def __init__(self, path):
        root = xml.parse(path).getroot()
        self.arrays = {a.get("Name"): self.numbers(a) for a in root.iter("DataArray")}
        self.points = self.arrays["Points"].reshape(-1, 3)
        self.time = self.arrays["TimeValue"][0]

    @staticmethod
    def numbers(array):
        if array.get("format") == "ascii":
            return np.array([float(word) for word in array.text.split()])
        data = base64.b64decode(array.text)
        kind = {"Float32": "<f4", "Int32": "<i4", "UInt8": "u1"}[array.get("type")]
        assert int.from_bytes(data[:8], "little") == len(data) - 8
        return np.frombuffer(data[8:], kind)


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="froude_export_"))
        (cls.folder / "scene.toml").write_text(SCENE)
        told("run", "scene.toml", "-o", "run.h5", "--csv", "run.csv", cwd=cls.folder)
        cls.kept = {name: data[()] for name, data in h5py.File(cls.folder / "run.h5").items()
                   if isinstance(data, h5py.Dataset)}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def export(self, *words, status=0):
        return told("export", *words, cwd=self.folder, status=status)

    def assert_same_table(self, exported, original):
        """Digit for digit; a result keeps its signals by name, so columns may stand in another order."""
        header, numbers = rows(self.folder / exported)
        names, expected = rows(self.folder / original)
        self.assertEqual(sorted(header.split(",")), sorted(names.split(",")))
        order = [names.split(",").index(name) for name in header.split(",")]
        self.assertEqual([line.split(",") for line in numbers],
                         [[line.split(",")[i] for i in order] for line in expected])

    def test_a_table_of_a_run_is_that_of_the_run_itself(self):
        self.export("run.h5", "-o", "again.csv")
        self.assert_same_table("again.csv", "run.csv")

    def test_a_table_of_responses_is_that_of_rao(self):
        for scene in ("examples/headings.toml", "examples/moored.toml"):
            told("rao", SOURCE / scene, "-o", "rao.h5", "--csv", "rao.csv", cwd=self.folder)
            self.export("rao.h5", "-o", "again.csv")
            self.assert_same_table("again.csv", "rao.csv")
            header, numbers = rows(self.folder / "again.csv")
            self.assertIn(" phase [deg]", header)
            with h5py.File(self.folder / "rao.h5") as rao:  # the last axis of the file is the pair of both parts
                name = header.split(",")[-1].split(" phase")[0]
                whole = rao[name][()].reshape(-1, 2) @ [1, 1j]
            last = np.array([line.split(",")[-2:] for line in numbers], float)
            np.testing.assert_allclose(last[:, 0], abs(whole), rtol=1e-15)  # 17 digits are written
            np.testing.assert_allclose(last[:, 1], np.degrees(np.angle(whole)), rtol=1e-14, atol=1e-13)

    def test_matlab_has_every_array_with_its_name_and_unit(self):
        self.export("run.h5", "-o", "run.mat")
        self.assertTrue((self.folder / "run.mat").read_bytes().startswith(b"MATLAB 7.3 MAT-file"))
        found = set()
        with h5py.File(self.folder / "run.mat") as mat, h5py.File(self.folder / "run.h5") as run:
            self.assertEqual(text_of(mat["froude/kind"]), "froude run")
            self.assertEqual(text_of(mat["froude/scene"]), SCENE)
            for name, variable in mat.items():
                self.assertRegex(name, r"^[A-Za-z]\w{0,62}$|^#refs#$")
                if name in ("froude", "#refs#"):
                    continue
                self.assertEqual(variable.attrs["MATLAB_class"], b"struct")
                original = text_of(variable["name"])
                value = variable["value"]
                self.assertEqual(value.attrs["MATLAB_class"], b"double")
                self.assertEqual(value.shape, (1, len(run["time"])))  # HDF5 has MATLAB's axes the other way round
                np.testing.assert_array_equal(value[0], run[original][()])
                unit = run[original].attrs["units"].decode()
                self.assertEqual(text_of(variable["unit"]), "" if unit == "1" else unit)
                self.assertEqual(text_of(variable["along"]), "time")
                found.add(original)
            self.assertEqual(found, set(self.kept))

    def test_matlab_has_complex_responses(self):
        told("rao", SOURCE / "examples/headings.toml", "-o", "rao.h5", cwd=self.folder)
        self.export("rao.h5", "-o", "rao.mat")
        with h5py.File(self.folder / "rao.mat") as mat, h5py.File(self.folder / "rao.h5") as rao:
            name = next(n for n in rao if "." in n)
            value = mat[name.replace(".", "_")]["value"]
            whole = rao[name][()]
            self.assertEqual(value.shape, whole.shape[:-1])
            np.testing.assert_array_equal(value["real"] + 1j * value["imag"], whole[..., 0] + 1j * whole[..., 1])
            self.assertEqual(text_of(mat[name.replace(".", "_")]["along"]), "omega, heading")

    def test_every_kind_of_result_goes_to_matlab_and_to_a_table(self):
        told("modes", SOURCE / "examples/moored.toml", "-o", "modes.h5", cwd=self.folder)
        told("psd", "run.h5", "--signal", "wave.elevation", "--segment", "2 s", "-o", "psd.h5", cwd=self.folder)
        told("psd", "run.h5", "--signal", "wave.elevation", "--segment", "2 s", "-o", "psd.csv", cwd=self.folder)
        self.export("modes.h5", "psd.h5", "psd.csv", "--format", "matlab", "-o", "all", status=2)  # two called psd
        self.export("modes.h5", "psd.h5", "--format", "matlab", "-o", "all")
        self.export("modes.h5", "psd.h5", "--format", "csv", "-o", "all")
        self.assert_same_table("all/psd.csv", "psd.csv")
        with h5py.File(self.folder / "all/modes.mat") as mat, h5py.File(self.folder / "modes.h5") as modes:
            cells = [text_of(mat[reference]) for reference in mat["motion/value"][0]]
            self.assertEqual(cells, [t.decode() for t in modes["motion"][()]])
            np.testing.assert_array_equal(mat["shape/value"][()], modes["shape"][()])
        self.assertEqual(len(rows(self.folder / "all/modes.csv")[1]), 6)
        self.export("psd.csv", "-o", "table.mat")
        with h5py.File(self.folder / "table.mat") as mat:  # in SI: 2 pi of a hertz
            hertz = h5py.File(self.folder / "psd.h5")["frequency"][()]
            np.testing.assert_allclose(mat["frequency/value"][0], 2 * math.pi * hertz, rtol=1e-15)  # one rounding

    def test_paraview_has_bodies_where_the_run_has_them(self):
        out = json.loads(self.export("run.h5", "-o", "run.pvd", "--every", "0.5 s", "--json"))["exports"][0]
        self.assertEqual(out["instants"], 9)
        listed = xml.parse(self.folder / "run.pvd").getroot().findall("Collection/DataSet")
        self.assertEqual(len(listed), 27)
        self.assertEqual({one.get("name") for one in listed}, {"bodies", "lines", "surface"})
        self.assertEqual((self.folder / "run_vtk/names.csv").read_text(),
                         "part,number,name\nbodies,1,buoy\nlines,1,rope\n")
        for one in listed:
            sample = round(float(one.get("timestep")) / 0.1)
            grid = Grid(self.folder / one.get("file"))
            self.assertAlmostEqual(grid.time, float(one.get("timestep")), places=12)
            self.assertAlmostEqual(grid.time, self.kept["time"][sample], places=12)
            check = getattr(self, "check_" + one.get("name"))
            check(grid, sample)

    def check_bodies(self, grid, sample):
        at = lambda mode: self.kept["buoy." + mode][sample]
        origin = np.array([3 + at("surge"), -2 + at("sway"), at("heave")])
        c, s = math.cos, math.sin
        yaw, pitch, roll = at("yaw"), at("pitch"), at("roll")
        turned = (np.array([[c(yaw), -s(yaw), 0], [s(yaw), c(yaw), 0], [0, 0, 1]])
                  @ np.array([[c(pitch), 0, s(pitch)], [0, 1, 0], [-s(pitch), 0, c(pitch)]])
                  @ np.array([[1, 0, 0], [0, c(roll), -s(roll)], [0, s(roll), c(roll)]]))
        in_axes = (grid.points - origin) @ turned  # back into body axes
        member = np.hypot(in_axes[-98:, 0], in_axes[-98:, 1])
        # Numbers of seven digits of places up to 5 m.
        np.testing.assert_allclose(np.linalg.norm(in_axes[:-98], axis=1), 0.8, atol=2e-6)
        np.testing.assert_allclose(member[:96], 0.1, atol=2e-6)
        np.testing.assert_allclose(in_axes[-98:, 2], [0, 2] * 49, atol=2e-6)
        self.assertEqual(set(grid.arrays["body"]), {1})

    def check_lines(self, grid, sample):
        nodes = [[self.kept[f"rope.node{i}.{axis}"][sample] for axis in "xyz"] for i in range(1, 4)]
        np.testing.assert_allclose(grid.points, [[0, 0, 0], *nodes, [4, 0, 0]], atol=1e-6)
        np.testing.assert_array_equal(grid.arrays["connectivity"].reshape(-1, 2), [[0, 1], [1, 2], [2, 3], [3, 4]])
        tension = [self.kept[f"rope.link{i}.tension"][sample] for i in range(1, 5)]
        np.testing.assert_allclose(grid.arrays["tension"], tension, rtol=1e-6)

    def check_surface(self, grid, sample):
        """Regular waves, which grow by a half cosine: zeta = a r cos(w t - k (x cos b + y sin b))."""
        t, w, h = self.kept["time"][sample], 2 * math.pi / 4, 20
        k = w * w / 9.81
        for _ in range(100):  # w^2 = g k tanh k h
            k = w * w / (9.81 * math.tanh(k * h))
        beta, grown = math.radians(30), 1 if t >= 6 else (1 - math.cos(math.pi * t / 6)) / 2
        x, y, z = grid.points.T
        expected = 0.2 * grown * np.cos(w * t - k * (x * math.cos(beta) + y * math.sin(beta)))
        np.testing.assert_allclose(z, expected, atol=2e-6)
        np.testing.assert_array_equal(grid.arrays["elevation"], z)
        self.assertEqual(len(grid.arrays["connectivity"]), 4 * 96 * 96)

    def test_a_part_of_the_time_and_of_the_signals(self):
        self.export("run.h5", "-o", "part.csv", "--from", "1 s", "--to", "2 s", "--every", "0.25 s", "-s", "buoy.h*")
        header, numbers = rows(self.folder / "part.csv")
        self.assertEqual(header, "time [s],buoy.heave [m]")
        # 1.25 s lies midway between two samples, of which the earlier one is taken.
        self.assertEqual([round(float(line.split(",")[0]), 6) for line in numbers], [1, 1.2, 1.5, 1.7, 2])

    def test_refusals(self):
        told("rao", SOURCE / "examples/headings.toml", "-o", "rao.h5", cwd=self.folder)
        (self.folder / "other.h5").write_bytes(b"not HDF5")
        told("waves", "make", SOURCE / "examples/waves/storm.toml", "-o", "water.h5", cwd=self.folder)
        before = {path: path.stat().st_mtime_ns for path in self.folder.iterdir()}
        for words, said in (
                (["run.h5", "-o", "run.h5"], "ends in none of .csv, .mat (MATLAB) and .pvd (ParaView)"),
                (["run.h5", "-o", "run.xlsx"], "ends in none of"),
                (["run.csv", "-o", "run.csv"], "it is read as a result"),
                (["run.csv", "-o", "two.csv"], "it is a table already"),
                (["run.h5", "rao.h5", "-o", "both.mat"], "several results do not go into one file"),
                (["water.h5", "-o", "water.pvd"], "neither bodies nor lines"),
                (["rao.h5", "-o", "rao.pvd"], "not a result of `froude run`"),
                (["rao.h5", "-o", "rao.csv2", "--format", "pdf"], "pdf not in {csv,matlab,vtk}"),
                (["rao.h5", "-o", "part.csv", "--from", "1 s"], "this result is none in time"),
                (["run.h5", "-o", "part.csv", "--from", "9 s"], "reaches from 0 to 4 s"),
                (["run.h5", "-o", "part.csv", "--every", "0 s"], "--every must be positive"),
                (["run.h5", "-o", "part.csv", "--every", "1 m"], "--every"),
                (["run.h5", "-o", "part.mat", "-s", "buoy.heav"], 'did you mean "buoy.heave"?'),
                (["other.h5", "-o", "other.mat"], "other.h5"),
                (["run.h5", "-o", "nowhere/run.mat"], "create the folder first"),
                (["run.h5", "-o", "run.csv", "--format", "csv"], "-o is a folder"),
        ):
            with self.subTest(words=words):
                self.assertIn(said, self.export(*words, status=2))
        self.assertEqual(before, {path: path.stat().st_mtime_ns for path in self.folder.iterdir()})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
