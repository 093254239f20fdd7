#!/usr/bin/python3
"""`froude bem convert` and `froude bem info` seen from outside: other bodies from the same data, other layouts, wrong input.

    coefficients_test.py FROUDE SOURCE
"""
import json
import math
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE = Path(sys.argv[1]).resolve()
SOURCE = Path(sys.argv[2]).resolve()
PONTOON = SOURCE / "examples" / "data" / "pontoon1.nc"
BOXES = SOURCE / "examples" / "data" / "box2.nc"


class Coefficients(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_coefficients_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments, status=0):
        done = subprocess.run([str(FROUDE), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def convert(self, *arguments):
        return json.loads(self.froude("--json", "bem", "convert", *arguments).stdout)

    def info(self, *arguments):
        return json.loads(self.froude("--json", "bem", "info", *arguments).stdout)["files"][0]

    def refused(self, *arguments, parts):
        message = self.froude("bem", *arguments, status=2).stderr
        for part in parts:
            self.assertIn(part, message)

    def test_the_plan_tells_what_coefficients_of_cylinders_take_before_they_are_computed(self):
        scene = (SOURCE / "examples" / "cylinders.toml").read_text()
        small = self.froude("plan", SOURCE / "examples" / "cylinders.toml").stdout
        self.assertIn("4 cylinders in 1 body, 39 frequencies", small)
        self.assertIn("run:", small)
        scene = scene[:scene.index("[[mooring]]")] + scene[scene.index("[ask]"):].replace("module.", "module_1.")
        scene = scene.replace('name = "module"', 'name = "module"\ncopies = { count = 60, step = "(13, 0, 0) m" }')
        (self.folder / "farm.toml").write_text(scene)
        large = self.froude("plan", self.folder / "farm.toml").stdout
        self.assertIn("240 cylinders in 60 bodies", large)
        self.assertIn("by iteration", large)
        self.assertIn("froude bem solve", large)
        self.assertNotIn("run:", large)

    def test_scaling_there_and_back_gives_the_same_numbers(self):
        self.convert(PONTOON, "--scale", 25, "--density-ratio", 1.025, "-o", "big.h5")
        self.convert("big.h5", "--scale", 0.04, "--density-ratio", 1 / 1.025, "-o", "back.h5")
        before, big, after = self.info(PONTOON), self.info("big.h5"), self.info("back.h5")
        self.assertAlmostEqual(big["omega_rad_per_s"][3] * 5, before["omega_rad_per_s"][3], places=12)
        self.assertAlmostEqual(big["bodies"][0]["C33_N_per_m"] / before["bodies"][0]["C33_N_per_m"] / (1.025 * 625), 1, places=12)
        for key in ("A33_infinite_kg", "C33_N_per_m", "displaced_volume_m3"):
            self.assertAlmostEqual(after["bodies"][0][key] / before["bodies"][0][key], 1, places=12)

    def test_runs_that_were_cut_out_of_a_table_merge_into_it(self):
        omega = self.info(PONTOON)["omega_rad_per_s"]
        low, high = omega[5], omega[10]
        self.convert(PONTOON, "--frequencies", f"{omega[0]!r} rad/s .. {low!r} rad/s, 4 values", "-o", "low.h5")
        changed = self.convert(PONTOON, "--frequencies", f"{high!r} rad/s .. {omega[-1]!r} rad/s, 4 values", "-o", "high.h5")
        self.assertIn("estimated error", changed["changed"][0])
        self.convert("low.h5", "high.h5", "--merge", "-o", "whole.h5")
        whole = self.info("whole.h5")
        self.assertEqual(len(whole["omega_rad_per_s"]), 8)
        self.assertTrue(any("merged from" in note for note in whole["notes"]))
        self.refused("convert", "low.h5", "high.h5", "-o", "x.h5", parts=["--merge"])
        self.refused("convert", PONTOON, BOXES, "--merge", "-o", "x.h5", parts=["differ in"])

    def test_an_array_has_a_body_at_every_place(self):
        changed = self.convert(PONTOON, "--array", "(±20, ±20, 0) m", "-o", "array.h5")
        self.assertIn("4 copies", changed["changed"][0])
        bodies = self.info("array.h5")["bodies"]
        self.assertEqual(sorted(tuple(b["reference_point_m"][:2]) for b in bodies), [(-20, -20), (-20, 20), (20, -20), (20, 20)])
        self.assertEqual(len({b["name"] for b in bodies}), 4)
        self.refused("convert", BOXES, "--array", "(1, 2, 0) m", "-o", "x.h5", parts=["one body can be repeated"])
        self.refused("convert", PONTOON, "--array", "(1, 2, 3) m", "-o", "x.h5", parts=["--array", "z must be 0"])

    def test_points_headings_and_places_are_moved(self):
        self.convert(PONTOON, "--about", "(0, 0, -1) m", "--translate", "(10, 0, 0) m", "--turn", "90 deg", "-o", "moved.h5")
        before, after = self.info(PONTOON), self.info("moved.h5")
        point = after["bodies"][0]["reference_point_m"]
        for value, expected in zip(point, (0, 10, -1)):
            self.assertAlmostEqual(value, expected, places=12)
        self.assertAlmostEqual(after["heading_deg"][0], before["heading_deg"][0] + 90, places=9)
        self.refused("convert", PONTOON, "--turn", "30 m", "-o", "x.h5", parts=["--turn", "30 m"])
        self.refused("convert", BOXES, "--about", "(0, 0, 0) m", "-o", "x.h5", parts=["1 points for 2 bodies"])

    def test_headings_are_completed_by_symmetry(self):
        self.convert(PONTOON, "--symmetric", "y", "-o", "both.h5")
        headings = self.info("both.h5")["heading_deg"]
        given = self.info(PONTOON)["heading_deg"]
        for beta in given:
            self.assertTrue(any(abs(h + beta) < 1e-9 for h in headings), (beta, headings))
        # Two boxes in a row along x: fore and aft are each other's image, not their own.
        self.refused("convert", BOXES, "--symmetric", "x", "-o", "x.h5", parts=["symmetr"])

    def test_a_netcdf_file_is_read_back_and_opened_by_xarray(self):
        self.convert(BOXES, "-o", "again.nc")
        before, after = self.info(BOXES), self.info("again.nc")
        for key in ("bodies", "omega_rad_per_s", "heading_deg", "depth_m", "has_A_zero", "has_A_infinite"):
            self.assertEqual(after[key], before[key])
        try:
            import numpy
            import xarray
        except ImportError:
            self.skipTest("no xarray")
        with xarray.open_dataset(self.folder / "again.nc", engine="h5netcdf" if not has_netcdf4() else "netcdf4") as data, \
                xarray.open_dataset(BOXES) as original:
            self.assertEqual(data.added_mass.dims, ("omega", "influenced_dof", "radiating_dof"))
            label = [str(x) for x in data.influenced_dof.values]
            mine = data.added_mass.sel(omega=1.0, method="nearest").values
            same = original.added_mass.sel(omega=1.0, method="nearest").transpose("influenced_dof", "radiating_dof")
            named = [str(x) for x in original.influenced_dof.values]
            order = [named.index(x) for x in label]
            numpy.testing.assert_array_equal(mine, same.values[numpy.ix_(order, order)])
            self.assertTrue(math.isinf(float(data.omega.values[-1])))

    def test_motions_are_told_by_their_peaks(self):
        (self.folder / "x.4").write_text("10 0 3 1 0 1 0\n5 0 3 2 0 2 0\n")
        told = self.info("x.4")
        self.assertEqual(told["kind"], "motions")
        self.assertEqual(told["largest"][0]["value"], 2)
        self.assertAlmostEqual(told["largest"][0]["omega_rad_per_s"], 2 * math.pi / 5)
        self.assertIn("heave of body 1", self.froude("bem", "info", "x.4").stdout)
        self.refused("check", "x.4", parts=["motions or second-order loads", ".1 file"])

    def test_second_order_loads_are_told_by_their_peaks(self):
        water = ("--density", "1000 kg/m^3", "--gravity", "10 m/s^2")
        (self.folder / "x.8").write_text("10 0 0 1 2 180 -2 0\n5 0 0 1 1 180 -1 0\n")
        drift = self.info("x.8", *water)
        self.assertEqual(drift["kind"], "mean drift (momentum)")
        self.assertAlmostEqual(drift["largest"][0]["value"], 2e4)
        self.assertEqual(drift["largest"][0]["unit"], "N/m^2")
        (self.folder / "x.12d").write_text("10 5 0 0 3 3 0 3 0\n10 10 0 0 3 1 0 1 0\n")
        loads = self.info("x.12d", *water)
        self.assertEqual(loads["kind"], "quadratic loads, differences")
        self.assertAlmostEqual(loads["largest"][0]["value"], 3e4)
        self.refused("info", "x.12d", parts=["density, gravity"])

    def test_wamits_options_are_refused_for_other_formats(self):
        self.refused("info", PONTOON, "--ulen", "1 m", parts=["ULEN"])
        self.refused("info", PONTOON, "--iperout", "1", parts=["IPEROUT"])


def has_netcdf4():
    try:
        import netCDF4  # noqa: F401
    except ImportError:
        return False
    return True


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
