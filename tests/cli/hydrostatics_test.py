#!/usr/bin/python3
"""`froude hydrostatics` seen from outside: the example, the file formats, wrong input.

    hydrostatics_test.py FROUDE SOURCE
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
WORKBOAT = SOURCE / "examples" / "data" / "workboat.obj"
WATER = ("--density", "1000 kg/m^3")

# A box 4 m × 2 m with a draught of 1 m: a quarter of it, open at the water.
QUARTER = """quarter of a box
1 9.81
1 1
3
0 0 -1  0 1 -1  2 1 -1  2 0 -1
2 0 -1  2 1 -1  2 1 0  2 0 0
2 1 -1  0 1 -1  0 1 0  2 1 0
"""


class Hydrostatics(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_hydrostatics_"))
        (self.folder / "box.gdf").write_text(QUARTER)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments, status=0):
        done = subprocess.run([str(FROUDE), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def told(self, *arguments):
        return json.loads(self.froude("--json", "hydrostatics", *arguments).stdout)

    def refused(self, *arguments, parts):
        message = self.froude("hydrostatics", *arguments, status=2).stderr
        for part in parts:
            self.assertIn(part, message)

    def test_the_workboat_floats_upright_with_its_mass(self):
        weight = ("--mass", "50 t", "--cog", "(-0.75, 0, 0.2) m")
        j = self.told(WORKBOAT, "--density", "1025 kg/m^3", *weight, "--free-trim", "--picture", "gz.svg")
        self.assertAlmostEqual(j["displacement_kg"], 50e3, delta=1e-3)
        self.assertTrue(j["equilibrium"]["stable"])
        self.assertTrue(j["mesh"]["closed"])
        self.assertAlmostEqual(j["pose"]["heel_deg"], 0, delta=1e-6)  # port and starboard are alike
        self.assertGreater(j["metacentre"]["gm_transverse_m"], 0.3)
        gz = {round(p["heel_deg"]): p["gz_m"] for p in j["gz"]}
        self.assertAlmostEqual(gz[5], j["metacentre"]["gm_transverse_m"] * math.sin(math.radians(5)), delta=0.1 * gz[5])
        self.assertIn("<svg", (self.folder / "gz.svg").read_text())
        text = self.froude("hydrostatics", WORKBOAT, "--density", "1025 kg/m^3", *weight).stdout
        for word in ("centre of buoyancy", "GM", "righting arms", "C about", "flat triangles lack"):
            self.assertIn(word, text)

    def test_a_gdf_as_drawn_has_the_numbers_of_a_box(self):
        j = self.told("box.gdf", *WATER)
        self.assertAlmostEqual(j["volume_m3"], 8, delta=1e-12)
        self.assertAlmostEqual(j["waterplane"]["second_moment_m4"][1][1], 8 / 3, delta=1e-12)
        self.assertAlmostEqual(j["C"][2][2], 9810 * 8, delta=1e-6)
        self.assertAlmostEqual(j["C"][3][3], 9810 * (8 / 3 - 8 * 0.5), delta=1e-6)
        self.assertEqual(j["C_holds"], "water")
        self.assertTrue(any("no centre of gravity" in note for note in j["notes"]))

    def test_a_gdf_takes_in_water_when_heeled_unless_it_gets_a_freeboard(self):
        cog = ("--cog", "(0, 0, -0.5) m", "--gz", "0 deg .. 20 deg, 5 values")
        open_hull, decked = self.told("box.gdf", *WATER, *cog), self.told("box.gdf", *WATER, *cog, "--freeboard", "1 m")
        self.assertEqual(len(open_hull["gz"]), 1)
        self.assertTrue(any("water comes in" in n or "takes in water" in n for n in open_hull["notes"]))
        bm = 2 * 2 / 12
        for p in decked["gz"]:  # wall-sided
            phi = math.radians(p["heel_deg"])
            self.assertAlmostEqual(p["gz_m"], math.sin(phi) * (bm + bm * math.tan(phi) ** 2 / 2), delta=1e-10)

    def test_wrong_input_is_refused(self):
        self.refused("none.stl", *WATER, parts=["none.stl"])
        self.refused("box.gdf", "--density", "1000 m", parts=["--density", "a density is needed"])
        self.refused("box.gdf", *WATER, "--mass", "8 t", parts=["--mass without --cog"])
        self.refused("box.gdf", *WATER, "--mass", "9 t", "--cog", "(0, 0, 0) m", parts=["takes in water by its openings"])
        self.refused("box.gdf", *WATER, "--reverse", parts=["inside out"])
        self.refused("box.gdf", *WATER, "--unit", "um", parts=["between 1 mm and 5 km"])
        self.refused("box.gdf", *WATER, "--heave", "2 m", parts=["nothing of the hull is under water"])
        self.refused("box.gdf", *WATER, "--heel", "5 deg", parts=["water comes in"])
        (self.folder / "box.gdf").write_text(QUARTER[:-9])
        self.refused("box.gdf", *WATER, parts=["box.gdf", "panel 3 of 3", "cut short"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
