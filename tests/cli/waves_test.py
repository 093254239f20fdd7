#!/usr/bin/python3
"""`froude waves` seen from outside: every example makes its series and tells what it is; wrong input is refused.

    waves_test.py FROUDE SOURCE
"""
import csv
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
EXAMPLES = SOURCE / "examples" / "waves"

SEA = """\
schema = 1
[water]
density = "1025 kg/m^3"
depth = "30 m"
[waves]
kind = "jonswap"
hs = "3 m"
tp = "9 s"
heading = "0 deg"
components = { highest = "0.4 Hz" }
[[probe]]
name = "gauge"
at = "(0, 0, 0) m"
[ask]
waves = { duration = "600 s", every = "0.5 s" }
"""


class Waves(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_waves_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments, status=0):
        done = subprocess.run([str(FROUDE), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def scene(self, text):
        path = self.folder / "scene.toml"
        path.write_text(text)
        return path

    def refused(self, text, *parts):
        message = self.froude("waves", "make", self.scene(text), status=2).stderr
        for part in parts:
            self.assertIn(part, message)
        self.assertEqual(list(self.folder.glob("*.h5")), [], "a file was left behind")

    def test_every_example_makes_its_series_and_picture(self):
        examples = sorted(EXAMPLES.glob("*.toml"))
        self.assertGreaterEqual(len(examples), 8)
        for example in examples:
            with self.subTest(example=example.name):
                self.froude("waves", "make", example, "-o", "out.h5", "--csv", "out.csv", "--picture", "out.svg")
                with open(self.folder / "out.csv", newline="") as file:
                    rows = list(csv.reader(line for line in file if not line.startswith("#")))
                self.assertGreater(len(rows), 100)
                self.assertTrue(all(math.isfinite(float(cell)) for row in rows[1:] for cell in row))
                self.assertIn("<svg", (self.folder / "out.svg").read_text())

    def test_every_example_but_the_tank_tells_what_it_is(self):
        for example in sorted(EXAMPLES.glob("*.toml")):
            with self.subTest(example=example.name):
                if example.stem == "tank":
                    self.assertIn("froude waves make", self.froude("waves", "info", example, status=2).stderr)
                    continue
                told = json.loads(self.froude("--json", "waves", "info", example).stdout)
                self.assertGreater(told["facts"]["steepness"]["value"], 0)
                self.assertTrue(any("breaking" in remark for remark in told["remarks"]))

    def test_the_list_of_the_looped_dropper_is_a_focused_group_of_2570_mm(self):
        told = self.froude("waves", "info", SOURCE / "examples" / "data" / "huijgen_appendixG_wave_components.csv",
                           "--phase-of", "k x - omega t", "--depth", "30 m").stdout
        self.assertIn("231 regular waves", told)
        self.assertRegex(told, r"hs +2\.57 m")
        self.assertIn("focused: the waves meet", told)
        self.assertNotIn("not focused", told)

    def facts(self, text):
        told = json.loads(self.froude("--json", "waves", "info", self.scene(text)).stdout)
        return {key: fact["value"] for key, fact in told["facts"].items()}, told["remarks"]

    def test_the_chance_of_a_crest_that_was_put_in_is_that_of_the_sea_without_it(self):
        crest = SEA.replace("components =", 'crest = { height = "4.5 m", position = "(40, 0, 0) m", time = "20 s" }\ncomponents =')
        facts, remarks = self.facts(crest)
        self.assertAlmostEqual(facts["highest_crest"], 4.5, delta=0.02)
        self.assertTrue(any("1.5 Hs" in remark for remark in remarks), remarks)
        # Rayleigh: exp(-8 (1.5)^2) for one crest, some 27 crests in 200 s at Tz of 7.2 s.
        self.assertAlmostEqual(facts["chance_of_crest"] / (200 / 7.2 * math.exp(-8 * 1.5 ** 2)), 1, delta=0.2)

    REGULAR = """\
schema = 1
[water]
density = "1025 kg/m^3"
gravity = "9.81 m/s^2"
depth = "infinite"
[waves]
kind = "regular"
height = "{height}"
period = "4 s"
heading = "0 deg"
{theory}
{current}
[[probe]]
name = "gauge"
at = "(0, 0, 0) m"
[ask]
waves = {{ duration = "60 s", every = "0.25 s" }}
"""

    def test_waves_against_a_current_are_shorter_and_break_earlier(self):
        against = '[current]\nvelocity = "(-1.5, 0, 0) m/s"'
        facts, _ = self.facts(self.REGULAR.format(height="0.5 m", theory="", current=against))
        # omega = sqrt(g k) - 1.5 k at omega = 2 pi/4
        root = (math.sqrt(9.81) - math.sqrt(9.81 - 6 * math.pi / 2)) / 3
        self.assertAlmostEqual(facts["wavelength"], 2 * math.pi / root ** 2, places=3)
        self.refused(self.REGULAR.format(height="2 m", theory="", current=against), "beyond breaking")
        still, _ = self.facts(self.REGULAR.format(height="2 m", theory="", current=""))
        self.assertAlmostEqual(still["wavelength"], 9.81 * 16 / (2 * math.pi), places=3)

    def test_nonlinear_waves_have_the_length_of_their_theory(self):
        facts, _ = self.facts(self.REGULAR.format(height="2 m", theory='theory = "stokes5"', current=""))
        linear = 9.81 * 16 / (2 * math.pi)
        self.assertAlmostEqual(facts["linear_wavelength"], linear, places=3)
        # Deep water, third order: k is lower by (kH/2)^2.
        self.assertAlmostEqual(facts["wavelength"] / linear - 1, (math.pi * 2 / linear) ** 2, delta=0.01)

    def test_a_made_record_has_the_height_that_was_asked_for(self):
        self.froude("waves", "make", self.scene(SEA.replace("600 s", "1799.5 s")), "-o", "sea.h5", "--csv", "sea.csv")
        for record in ("sea.h5", "sea.csv"):
            arguments = ["--column", "gauge.elevation"] if record.endswith("csv") else []
            told = json.loads(self.froude("--json", "waves", "info", record, "--depth", "30 m", *arguments).stdout)
            # One whole repetition holds the energy exactly; 0.2 % of it lies above 0.4 Hz.
            self.assertAlmostEqual(told["facts"]["hs"]["value"], 3, delta=0.01)

    def test_the_energy_flux_of_deep_water_is_that_of_the_energy_period(self):
        facts, _ = self.facts(SEA.replace('"30 m"', '"infinite"'))
        # c_g = g/(2 omega), so rho g m0 c_g summed is rho g^2 Hs^2 Te/(64 pi); a slice is 1.4 % wide.
        expected = 1025 * 9.81**2 * facts["hs"] ** 2 * facts["te"] / (64 * math.pi)
        self.assertAlmostEqual(facts["energy_flux"] / expected, 1, delta=1e-3)

    def test_a_longer_record_begins_like_a_shorter_one(self):
        self.froude("waves", "make", self.scene(SEA), "--csv", "long.csv", "-o", "long.h5")
        self.froude("waves", "make", self.scene(SEA.replace("600 s", "60 s")), "--csv", "short.csv", "-o", "short.h5")
        short, whole = ((self.folder / name).read_text().splitlines() for name in ("short.csv", "long.csv"))
        self.assertEqual(whole[: len(short)], short)

    def test_a_step_that_misses_the_shortest_wave_is_refused(self):
        self.refused(SEA.replace('every = "0.5 s"', 'every = "2 s"'), "less than two samples a period", "smaller time step")

    def test_a_result_is_not_written_under_the_name_of_a_table(self):
        message = self.froude("waves", "make", self.scene(SEA), "-o", "out.csv", status=2).stderr
        self.assertIn("end it in .h5 or .nc", message)
        self.assertEqual(list(self.folder.glob("out*")), [])

    def test_what_no_sea_has_is_refused(self):
        self.refused(SEA.replace('hs = "3 m"', 'hs = "-3 m"'), "scene.toml:7:6", "must be positive")
        self.refused(SEA.replace('hs = "3 m"', 'hs = "30 m"'), "beyond breaking", "the highest wave")
        self.refused(SEA.replace('tp = "9 s"', 'tp = "9 s"\ngamma = 0.5'), "must be at least 1")
        self.refused(SEA.replace('depth = "30 m"', 'depth = "0 m"'), "must be positive")
        self.refused(SEA.replace("(0, 0, 0) m", "(0, 0, -31) m"), "below the bed", "scene.toml:11")
        self.refused(SEA.replace('highest = "0.4 Hz"', 'highest = "0.4 Hz", lowest = "0.5 Hz"'), "0 <= omega_min < omega_max")

    def test_tables_that_are_wrong_are_refused(self):
        (self.folder / "s.csv").write_text("frequency [Hz],density [m^2/Hz]\n0.2,0\n0.1,10\n0.3,0\n")
        table = SEA.replace('kind = "jonswap"\nhs = "3 m"\ntp = "9 s"\n', 'kind = "tabulated"\nfile = "s.csv"\n')
        self.refused(table, "s.csv", "increas")
        (self.folder / "s.csv").write_text("frequency [Hz],density [m^2/Hz]\n")
        self.refused(table, "two points")
        (self.folder / "d.csv").write_text("direction [deg],density [1/rad]\n-90,0\n0,1\n90,0\n")
        spread = SEA.replace("components", 'spreading = { kind = "tabulated", file = "d.csv" }\ncomponents')
        self.refused(spread, "1.57", "integra")

    def test_a_sea_in_files_of_no_kind_is_refused(self):
        (self.folder / "x.csv").write_text("a,b\n1,2\n")
        self.assertIn("neither a list of waves, nor a spectrum, nor a record",
                      self.froude("waves", "info", "x.csv", status=2).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
