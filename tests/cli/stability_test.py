"""`froude stability`: a map of few cells against what is known of it. Usage: stability_test.py FROUDE SOURCE"""
import csv
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ASKED = 'stability = { periods = "6 s .. 9 s, 7 values", heights = "1 m .. 4 m, 4 values", branch = [{ height = "2 m" }], of = ["pivot.angle", "rack.stroke"] }'


class Stability(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_stability_"))
        self.buoy = (SOURCE / "examples/buoy.toml").read_text(encoding="utf-8")
        self.assertIn(ASKED, self.buoy)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, scene, *arguments):
        (self.folder / "scene.toml").write_text(scene, encoding="utf-8")
        return subprocess.run([str(FROUDE), "stability", "scene.toml", "-o", "map.h5", "--csv", "map.csv",
                               "--picture", "map.svg", *arguments], cwd=self.folder, capture_output=True, text=True, timeout=280)

    def asking(self, table):
        return self.buoy.replace(ASKED, table)

    def test_the_buoy_doubles_its_period_about_half_of_the_natural_one_and_a_run_agrees(self):
        # 7.5 s doubles at 2 m and 9 s does not, as runs of 2400 s have it (froude validate orszaghova-map).
        done = self.froude(self.asking('stability = { periods = "7.5 s .. 9 s, 2 values", heights = "2 m .. 2.5 m, 2 values", '
                                       'of = ["pivot.angle", "rack.stroke"] }'),
                           "--json", "--check", "time", "--check-cells", "2", "--check-duration", "900 s",
                           "--boundaries", "edges.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        edges = [r for r in csv.reader(r for r in (self.folder / "edges.csv").read_text().splitlines() if r[0] != "#")]
        self.assertEqual(edges[0], ["boundary", "period [s]", "height [m]"])
        floquet = [(float(t), float(h)) for name, t, h in edges if name == "Floquet"]
        self.assertEqual(sorted({floquet[0][1], floquet[-1][1]}), [2, 2.5])  # from the lower end of the map to the upper
        self.assertTrue(all(7.5 < t < 9 for t, _ in floquet), floquet)
        mathieu = [(float(t), float(h)) for name, t, h in edges if name == "Mathieu"]
        self.assertEqual([t for t, _ in mathieu], [7.5, 9])
        for (_, height), period in zip(mathieu, told["periods"]):
            self.assertAlmostEqual(height, period["mathieu_height_m"], delta=1e-5)  # six digits are written
        fates = {p["period_s"]: [c["fate"] for c in p["cells"]] for p in told["periods"]}
        self.assertEqual(fates, {7.5: ["period-doubled"] * 2, 9.0: ["stable"] * 2})
        for period in told["periods"]:
            for cell in period["cells"]:
                self.assertEqual(cell["multiplier"] > 1, cell["fate"] != "stable")
            self.assertGreater(period["mathieu_height_m"], 0)
        check = told["check"]
        self.assertEqual([(c["period_s"], c["height_m"]) for c in check["cells"]], [(7.5, 2.0), (9.0, 2.5)])
        self.assertEqual((check["agree"], check["decided"]), (2, 2), check)
        self.assertGreater(check["run_over_cell"], 1)
        rows = [r for r in csv.reader((self.folder / "map.csv").read_text().splitlines()) if not r[0].startswith("#")]
        self.assertEqual(len(rows), 1 + 4)
        picture = (self.folder / "map.svg").read_text()
        self.assertIn("</svg>", picture)
        self.assertIn("period-doubled, not reached", picture)

    def test_a_run_leaves_a_motion_that_doubles(self):
        done = self.froude(self.asking('stability = { periods = "7.4 s .. 7.5 s, 2 values", heights = "2 m .. 2.5 m, 2 values", '
                                       'of = ["pivot.angle"] }'),
                           "--json", "--check", "time", "--check-cells", "1", "--check-duration", "900 s")
        self.assertEqual(done.returncode, 0, done.stderr)
        cell, = json.loads(done.stdout)["check"]["cells"]
        self.assertEqual((cell["fate"], cell["left"], cell["agrees"]), ("period-doubled", True, True))

    def test_a_branch_stands_in_each_result(self):
        done = self.froude(self.asking('stability = { periods = "6.5 s .. 7 s, 2 values", heights = "2 m .. 2 m, 1 values", '
                                       'branch = [{ height = "2 m" }], of = ["pivot.angle"] }'), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        branch, = told["branches"]
        points = branch["points"]
        self.assertEqual((branch["height_m"], branch["folds"], branch["end"]), (2, [], ""))
        self.assertEqual((points[0]["period_s"], points[-1]["period_s"]), (6.5, 7))
        # The ends are cells of the map, which tell the same.
        self.assertEqual((points[0]["fate"], points[-1]["fate"]), ("stable", "period-doubled"))
        for point, period in zip((points[0], points[-1]), told["periods"]):
            self.assertEqual(point["fate"], period["cells"][0]["fate"])
            self.assertAlmostEqual(point["multiplier"], period["cells"][0]["multiplier"], delta=1e-3)  # accuracy of motions
        table = [r for r in csv.DictReader(r for r in (self.folder / "map.csv").read_text().splitlines() if r[0] != "#")]
        self.assertEqual([r["branch"] for r in table], ["0"] * 2 + ["1"] * len(points))
        self.assertIn("not stable", (self.folder / "map.svg").read_text())
        done = subprocess.run([str(FROUDE), "stability", "scene.toml", "-o", "again.h5"], cwd=self.folder, capture_output=True,
                              text=True, timeout=280)
        self.assertIn(f"branch 1 of 2 m: {len(points)} points: stable to 6.", done.stdout)

    def test_waves_that_break_leave_their_cells_empty_and_are_counted(self):
        # Waves of 3 s are 14 m long: none is higher than 2 m.
        done = self.froude(self.asking('stability = { periods = "3 s .. 9 s, 2 values", heights = "1 m .. 3 m, 2 values", '
                                       'branch = [{ height = "3 m" }], of = ["pivot.angle"] }'), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        cells = {p["period_s"]: [(c["fate"], c["reached"]) for c in p["cells"]] for p in told["periods"]}
        self.assertEqual(cells[3.0][1], ("beyond breaking", "beyond breaking"))
        self.assertEqual([c[1] for c in cells[9.0]], ["grown", "grown"])
        self.assertEqual(told["counts"]["fates"]["beyond breaking"], 1)
        self.assertEqual(told["counts"]["jumped"], 0)
        self.assertIn("beyond breaking", told["branches"][0]["end"])
        rows = [r for r in csv.DictReader(r for r in (self.folder / "map.csv").read_text().splitlines() if r[0] != "#")]
        self.assertEqual([r["reached"] for r in rows if r["height [m]"] == "3"][0], "4", rows)

    def test_what_has_no_map_is_refused(self):
        one_period = ASKED.replace("6 s .. 9 s, 7 values", "7 s .. 7 s, 1 values").replace('branch = [{ height = "2 m" }], ', "")
        (self.folder / "scene.toml").write_text(self.asking(one_period), encoding="utf-8")
        done = subprocess.run([str(FROUDE), "stability", "scene.toml", "--boundaries", "edges.csv"], cwd=self.folder,
                              capture_output=True, text=True, timeout=280)
        self.assertEqual(done.returncode, 2)
        self.assertIn("boundaries need two periods and two heights", done.stderr)
        for scene, words, line in (
                (self.buoy.replace(ASKED, ""), "does not ask for a stability map", None),
                (self.asking(ASKED.replace('"pivot.angle", "rack.stroke"', '"pivot.angel"')), 'did you mean "pivot.angle"?', ASKED),
                (self.buoy.replace('kind = "regular"\nheight = "2 m"\nperiod = "7.6 s"',
                                   'kind = "jonswap"\nhs = "2 m"\ntp = "7.6 s"\nseed = 1'), "regular waves", ASKED),
                (self.asking(ASKED.replace("1 m .. 4 m, 4 values", "-1 m .. 4 m, 4 values")), "must be positive", ASKED),
                (self.asking(ASKED.replace("6 s .. 9 s", "9 s .. 6 s")), "does not increase", ASKED),
                (self.asking(ASKED.replace("6 s .. 9 s", "70 s .. 80 s")), "given from 0.1 to 3 rad/s", ASKED),
                (self.asking(ASKED.replace("1 m .. 4 m", "40 m .. 50 m")), "beyond breaking", ASKED),
                (self.asking(one_period), "two periods and two heights", ASKED),
                (self.asking(ASKED.replace("6 s .. 9 s, 7 values", "7 s .. 7 s, 1 values")), "which has one period", ASKED),
                (self.asking(ASKED.replace('height = "2 m" }', 'height = "2 m", period = "7 s" }')), "height", ASKED),
                (self.buoy.replace("[joint.pto]\ndamping", "friction = { dynamic = \"1 kN m\" }\n[joint.pto]\ndamping", 1),
                 "friction is set-valued", ASKED),
        ):
            with self.subTest(words=words):
                done = self.froude(scene)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(words, done.stderr)
                self.assertEqual(done.stderr.count("error:"), 1, done.stderr)
                if line:  # where it stands: its beginning is the same in all of them
                    number = [row.startswith(line[:12]) for row in scene.splitlines()].index(True) + 1
                    self.assertRegex(done.stderr, f"scene.toml:{number}:[0-9]+: error:")
                self.assertFalse((self.folder / "map.h5").exists())

    def test_a_duration_is_a_time(self):
        for duration, words in (("10 m", "a time is needed"), ("0 s", "must be positive")):
            done = self.froude(self.buoy, "--check", "time", "--check-duration", duration)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
