#!/usr/bin/python3
"""Films as a user meets them: the examples from end to end, and what wrong input is told.

    film_test.py FROUDE SOURCE

Where froude-film is not built beside froude, films themselves are not tested.
"""
import csv
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
HAS_FILMS = (FROUDE.parent / "froude-film").exists()
FIRST = "(322, 120), (411, 260), (519, 187)"


def rows_of(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


class WithFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="froude_film_"))
        for name in ("fit", "film"):
            shutil.copytree(SOURCE / "examples" / name, cls.folder / name)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def froude(cls, *arguments):
        return subprocess.run([str(FROUDE), *map(str, arguments)], cwd=cls.folder, capture_output=True, text=True,
                              timeout=300)

    def done(self, *arguments):
        ran = self.froude(*arguments)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return ran.stdout

    def refused(self, *arguments):
        ran = self.froude(*arguments)
        self.assertEqual(ran.returncode, 2, ran.stdout + ran.stderr)
        return ran.stderr


class ForeignTrack(WithFolder):
    def test_the_fit_of_another_programs_track_finds_the_damping_it_was_made_with(self):
        told = json.loads(self.done("fit", "fit/film_track.toml", "--json"))
        for name, truth in (("line_damping_linear", 0.006), ("line_damping_quadratic", 0.004)):
            with self.subTest(parameter=name):
                low, high = told["parameter"][name]["interval"]
                self.assertLess(low, truth)
                self.assertGreater(high, truth)
                self.assertLess(high - low, truth)

    def test_kinematics_are_those_of_the_angles(self):
        out = self.folder / "motion.csv"
        self.done("kinematics", "fit/film_track.toml", "--bandwidth", "4 Hz", "--length", "joint bob 0.4 m 1 mm", "-o", out,
                  "--picture", self.folder / "motion.svg")
        rows = rows_of(out)
        self.assertEqual(len(rows), 300)
        middle = rows[150]
        x, z = (float(middle[f"joint_{c} [m]"]) for c in "xz")
        self.assertAlmostEqual(float(middle["chain.link1.polar [rad]"]), math.atan2(-z, x), delta=0.005)
        self.assertAlmostEqual(math.hypot(x, z), 0.5, delta=0.005)
        # The rate, summed by trapezia over two seconds, against the change of the angle: off by h^2/12 times that of the
        # acceleration, 0.005 rad, and as much noise.
        times = [float(row["t [s]"]) for row in rows]
        angles = [float(row["chain.link1.polar [rad]"]) for row in rows]
        rates = [float(row["chain.link1.polar_velocity [rad/s]"]) for row in rows]
        summed = sum((rates[i] + rates[i + 1]) / 2 * (times[i + 1] - times[i]) for i in range(100, 150))
        self.assertAlmostEqual(summed, angles[150] - angles[100], delta=0.02)
        self.assertGreater(max(rates[100:150]) - min(rates[100:150]), 1)


class Instants(WithFolder):
    """Clocks, the release and the start of a scene, from the example of another program's track."""

    def kinematics(self, *more):
        return self.done("kinematics", "fit/film_track.toml", "--bandwidth", "4 Hz", "-o", self.folder / "m.csv", *more)

    def test_a_record_of_another_clock_is_found_by_its_correlation(self):
        self.kinematics()
        rows = rows_of(self.folder / "m.csv")
        lines = ["t [s],angle [deg]"] + [f"{float(r['t [s]']) + 3.21:.6f},{57.29578 * float(r['chain.link1.polar [rad]']):.6f}"
                                         for r in rows]
        (self.folder / "record.csv").write_text("\n".join(lines) + "\n")
        told = json.loads(self.kinematics("--record", "record.csv", "--match", "chain.link1.polar = angle", "--json"))
        self.assertAlmostEqual(told["offset_s"], 3.21, delta=0.002)  # a smoothed record, whose noise is 0.001 rad
        self.assertLess(told["offset_deviation_s"], 0.001)
        self.assertIn("names no signal", self.refused("kinematics", "fit/film_track.toml", "--bandwidth", "4 Hz", "-o", "x.csv",
                                                      "--record", "record.csv", "--match", "angle"))

    def test_a_line_starts_where_the_film_shows_it(self):
        self.kinematics("--start", "start.toml", "--start-at", "2 s", "--nodes", "joint, bob")
        start = (self.folder / "start.toml").read_text()
        scene = re.sub(r"\[line.release\].*?\n\n", start + "\n", (self.folder / "fit" / "pendulums_scene.toml").read_text(),
                       flags=re.S)
        (self.folder / "fit" / "from_film.toml").write_text(scene)
        self.done("run", "fit/from_film.toml", "-o", "from_film.h5", "--csv", "from_film.csv")
        run, film = rows_of(self.folder / "from_film.csv"), rows_of(self.folder / "m.csv")
        first = next(i for i, row in enumerate(film) if float(row["t [s]"]) > 2 - 1e-6)
        for k in (0, 5, 10):  # 0.4 s, in which 2 mm and 0.02 m/s grow to a hundredth of a radian or two
            with self.subTest(sample=k):
                at = next(row for row in run if abs(float(row[next(iter(row))]) - (float(film[first + k]["t [s]"]) - 2)) < 0.021)
                name = next(column for column in at if "link1" in column)
                self.assertAlmostEqual(float(at[name]), float(film[first + k]["chain.link1.polar [rad]"]), delta=0.06)
        self.assertIn("has no marker", self.refused("kinematics", "fit/film_track.toml", "--bandwidth", "4 Hz", "-o", "x.csv",
                                                    "--start", "s.toml", "--start-at", "2 s", "--nodes", "joint, bobb"))

    def test_a_film_that_begins_in_motion_tells_no_release(self):
        self.assertIn("are needed to tell its release",
                      self.refused("kinematics", "fit/film_track.toml", "--bandwidth", "4 Hz", "-o", "x.csv", "--release", "bob"))


class WithoutFilms(WithFolder):
    def test_one_line_says_what_is_missing_and_how_to_get_it(self):
        alone = shutil.copy(FROUDE, self.folder / "froude")  # beside which there is no froude-film
        ran = subprocess.run([alone, "track", "film.avi", "--markers", "2", "-o", "track.csv"], cwd=self.folder,
                             capture_output=True, text=True, timeout=60)
        self.assertEqual(ran.returncode, 2, ran.stdout + ran.stderr)
        self.assertEqual(len(ran.stderr.splitlines()), 1)
        self.assertIn("needs OpenCV", ran.stderr)
        self.assertIn("scripts/setup camera", ran.stderr)


@unittest.skipUnless(HAS_FILMS, "there is no OpenCV here")
class Films(WithFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.filmed = cls.froude("film", "film/film.toml", "-o", "film.avi", "--truth", "truth.csv")
        cls.tracked = cls.froude("track", "film.avi", "--markers", "pivot, joint, bob", "--first", FIRST, "--radius",
                                 "4 px .. 10 px", "-o", "film/track.csv", "--annotated", "annotated.avi", "--picture",
                                 "ways.png", "--json")

    def test_the_track_is_within_half_a_pixel_of_the_truth(self):
        self.assertEqual(self.filmed.returncode, 0, self.filmed.stderr)
        self.assertEqual(self.tracked.returncode, 0, self.tracked.stderr)
        truth = {round(float(row["t [s]"]), 3): row for row in rows_of(self.folder / "truth.csv")}
        squares = seen = inside = 0
        for row in rows_of(self.folder / "film" / "track.csv"):
            exact = truth[round(float(row["t [s]"]), 3)]
            for name in ("pivot", "joint", "bob"):
                if row[f"{name}_x [px]"]:
                    error = float(row[f"{name}_x [px]"]) - float(exact[f"{name}_x [px]"])
                    squares += error**2
                    seen += 1
                    inside += abs(error) < 1.96 * math.sqrt(float(row[f"{name}_xx [px^2]"]))
        self.assertGreater(seen, 0.95 * 3 * len(truth))
        self.assertLess(math.sqrt(squares / seen), 0.1)  # 0.5 is asked of noisy films
        self.assertAlmostEqual(inside / seen, 0.95, delta=0.05)

    def test_lost_frames_are_gaps(self):
        told = json.loads(self.tracked.stdout)
        self.assertTrue(any("repeat the one before" in caution for caution in told["cautions"]), told["cautions"])
        self.assertEqual(told["frames"], len(rows_of(self.folder / "truth.csv")))

    def test_what_is_drawn_is_there(self):
        self.assertTrue((self.folder / "annotated.avi").stat().st_size > 1000)
        self.assertTrue((self.folder / "ways.png").read_bytes().startswith(b"\x89PNG"))

    def test_the_fit_finds_the_damping_of_the_scene(self):
        told = json.loads(self.done("fit", "film/fit.toml", "--json"))
        for name in ("line_damping_linear", "line_damping_quadratic"):
            with self.subTest(parameter=name):
                low, high = told["parameter"][name]["interval"]
                # Twice the half-width of 95 % is left by one film in ten thousand.
                self.assertLess(abs((low + high) / 2 - 0.01), high - low)
                self.assertLess(high - low, 0.001)

    def test_a_lossy_film_is_tracked_within_half_a_pixel(self):
        self.done("film", "film/film.toml", "-o", "film.mp4", "--truth", "truth_mp4.csv")
        self.done("track", "film.mp4", "--markers", "pivot, joint, bob", "--first", FIRST, "--radius", "4 px .. 10 px", "-o",
                  "mp4.csv")
        truth = {round(float(row["t [s]"]), 2): row for row in rows_of(self.folder / "truth_mp4.csv")}
        errors = [float(row["bob_x [px]"]) - float(truth[round(float(row["t [s]"]), 2)]["bob_x [px]"])
                  for row in rows_of(self.folder / "mp4.csv") if row["bob_x [px]"] and round(float(row["t [s]"]), 2) in truth]
        self.assertGreater(len(errors), 250)
        self.assertLess(math.sqrt(sum(e * e for e in errors) / len(errors)), 0.5)

    def test_what_cannot_be_read_says_what_to_do(self):
        (self.folder / "text.mp4").write_text("no film")
        track = ["--markers", "2", "-o", "x.csv"]
        self.assertIn("ffmpeg -i text.mp4", self.refused("track", "text.mp4", *track))
        self.assertIn("no such film", self.refused("track", "nothing.mp4", *track))
        self.assertIn("--first", self.refused("track", "film.avi", *track))
        self.assertIn("4 are named", self.refused("track", "film.avi", "--markers", "4", "-o", "x.csv"))
        self.assertIn("no frame shows a disc", self.refused("track", "film.avi", "--radius", "40 px .. 60 px", *track))
        self.assertIn("--radius", self.refused("track", "film.avi", "--radius", "4 px", *track))
        self.assertIn("no colour", self.refused("track", "film.avi", "--colour", "red", *track))
        self.assertIn("frames lie in the time", self.refused("track", "film.avi", "--from", "90 s", *track))
        self.assertIn("would be replaced", self.refused("track", "film.avi", "--markers", "2", "-o", "film.avi"))

    def test_a_film_in_which_no_marker_moves_says_so(self):
        self.assertIn("nothing moves in this film",
                      self.refused("track", "film.avi", "--markers", "1", "--first", "(322, 120)", "-o", "x.csv"))

    def test_a_lens_of_another_size_is_refused(self):
        lens = (self.folder / "film" / "lens.toml").read_text().replace("width = 640", "width = 1280")
        (self.folder / "film" / "wide.toml").write_text(lens)
        fit = (self.folder / "film" / "fit.toml").read_text().replace("lens.toml", "wide.toml")
        (self.folder / "film" / "wide_fit.toml").write_text(fit)
        self.assertIn("640 x 480 px, the lens was calibrated with 1280 x 480 px", self.refused("fit", "film/wide_fit.toml"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
