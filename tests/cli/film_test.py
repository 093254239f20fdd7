#!/usr/bin/python3
"""Films as a user meets them: the examples from end to end, and what wrong input is told.

    film_test.py FROUDE SOURCE

Where froude-film is not built beside froude, films themselves are not tested.
"""
import json
import math
import re
import shutil
import subprocess
import sys
import unittest

from film_folder import FROUDE, SOURCE, WithFolder, rows_of

HAS_FILMS = (FROUDE.parent / "froude-film").exists()
FIRST = "(322, 120), (411, 260), (519, 187)"


class ForeignTrack(WithFolder):
    def test_the_fit_of_another_programs_track_finds_the_damping_it_was_made_with(self):
        told = json.loads(self.done("fit", "fit/film_track.toml", "--json"))
        for name, truth in (("line_damping_linear", 0.006), ("line_damping_quadratic", 0.004)):
            with self.subTest(parameter=name):
                low, high = told["parameter"][name]["interval"]
                self.assertLess(low, truth)
                self.assertGreater(high, truth)
                self.assertLess(high - low, truth)

    def test_what_no_smoother_can_do_is_refused(self):
        common = ("kinematics", "fit/film_track.toml", "-o", "x.csv", "--bandwidth")
        self.assertIn("no motion up to 400 Hz", self.refused(*common, "400 Hz"))
        self.assertIn('or "0.13 Hz"', self.refused(*common, "4"))
        self.assertIn("apart in the track", self.refused(*common, "4 Hz", "--length", "joint bob 0.9 m 1 mm"))
        self.assertIn("is no smaller than the length itself", self.refused(*common, "4 Hz", "--length", "joint bob 0.4 m 1 m"))

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


class Dialects(WithFolder):
    """One track as several programs would write it, each telling the same motion."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        lines = (cls.folder / "fit" / "film_track.txt").read_text().splitlines()
        cls.names = lines[1].split(";")
        cls.rows = [line.replace(",", ".").split(";") for line in lines[2:]]
        cls.scene = (cls.folder / "fit" / "film_track.toml").read_text()
        cls.told = cls.motion("as it is", None)

    @classmethod
    def motion(cls, name, text, *changes):
        """Places of the bob from the track in that text, by a scene with these changes."""
        scene = cls.scene
        if text is not None:
            (cls.folder / "fit" / "dialect.txt").write_text(text, newline="")
            scene = scene.replace("film_track.txt", "dialect.txt")
        for old, new in changes:
            assert old in scene, old
            scene = scene.replace(old, new, 1)
        (cls.folder / "fit" / "dialect.toml").write_text(scene)
        ran = cls.froude("kinematics", "fit/dialect.toml", "--bandwidth", "4 Hz", "-o", "dialect.csv")
        assert ran.returncode == 0, f"{name}: {ran.stderr}"
        return [(float(r["bob_x [m]"]), float(r["bob_z [m]"])) for r in rows_of(cls.folder / "dialect.csv")]

    def as_text(self, between, head=(), gap="NaN", names=None, rows=None, end="\n"):
        return end.join([*head, *([between.join(names)] if names is not None else []),
                         *(between.join(gap if cell == "NaN" else cell for cell in row) for row in rows or self.rows)]) + end

    def test_each_is_read_as_it_is(self):
        millimetres = [[row[0], *(c if c == "NaN" else f"{float(c):.2f}" for c in row[1:])] for row in self.rows]
        upwards = [[c if c == "NaN" or k == 0 or k % 2 else f"{1000 - float(c):.2f}" for k, c in enumerate(row)]
                   for row in self.rows]
        later = next(k for k, row in enumerate(self.rows) if float(row[0]) > 0.81)
        longer = [*self.rows[:later], ["0.81"] + ["NaN"] * 6, *self.rows[later:]]
        no_units = 'units = { time = "s", position = "px" }'
        with_units = [self.names[0] + " [s]", *(name + " [px]" for name in self.names[1:])]
        cases = {
            "commas": (self.as_text(",", names=self.names), ()),
            "tabs, no cell in a gap": (self.as_text("\t", names=self.names, gap=""), ()),
            "blanks and dashes": (self.as_text("  ", names=self.names, gap="-"), ()),
            "titles, comments, Windows' ends of lines": (
                self.as_text(";", head=["\ufeffTracker 6.1", "# mass A", "% a remark", ""], names=self.names, end="\r\n"), ()),
            "units in the file": (self.as_text(",", names=with_units), ((no_units, ""),)),
            "no names": (self.as_text(";"), (("[data]\n", f"[data]\ncolumns = {json.dumps(self.names)}\n"),)),
            "other names": (self.as_text(",", names=["frame time", "A.x", "A.y", "B.x", "B.y", "x_C", "y_C"]),
                            (('time = "t"', 'time = "frame time"'),
                             ("[camera]", "[camera]\nmarker = [" + ", ".join(
                                 f'{{ name = "{m}", x = "{x}", y = "{y}" }}' for m, x, y in
                                 (("pivot", "A.x", "A.y"), ("joint", "B.x", "B.y"), ("bob", "x_C", "y_C"))) + "]"))),
            "y upwards": (self.as_text(",", names=self.names, rows=upwards), (('pivot = "pivot"', 'y = "up"\npivot = "pivot"'),)),
            "lengths": (self.as_text(",", names=self.names, rows=millimetres),
                        (('position = "px"', 'position = "mm"'), ('deviation = "0.4 px"', 'deviation = "0.4 mm"'),
                         ('distance = { between = ["pivot", "joint"], is = "0.5 m" }', ""))),
            "a row in which nothing is seen": (self.as_text(";", names=self.names, rows=longer), ()),
        }
        for name, (text, changes) in cases.items():
            with self.subTest(dialect=name):
                found = self.motion(name, text, *changes)
                if name.startswith("a row"):
                    del found[later]
                self.assertEqual(len(found), len(self.told))
                # A scale from a distance on film is 0.1 mm of 0.5 m off the true one; all else is the same number.
                most = 0.001 if name == "lengths" else 0.0005 if name.startswith("a row") else 1e-9
                self.assertLess(max(math.dist(a, b) for a, b in zip(found, self.told)), most)

    def test_what_cannot_be_a_track_says_what_to_do(self):
        backwards = self.rows[:50] + self.rows[40:]
        for name, text, said in (
                ("times that go back", self.as_text(";", names=self.names, rows=backwards), "times must increase"),
                ("no time", self.as_text(";", names=self.names, rows=self.rows[:9] + [["NaN", *self.rows[9][1:]]]), "needs its time"),
                ("a row cut off", self.as_text(";", names=self.names) + "12,1;3\n", "7 columns are named"),
                ("words", self.as_text(";", names=self.names) + "12.1;lost;;;;;\n", "is no number"),
                ("names alone", ";".join(self.names) + "\n", "no row of numbers"),
                ("nothing", "", "the track is empty"),
                ("no marker", self.as_text(";", names=["t", "a", "b", "c", "d", "e", "f"]), "[[camera.marker]]"),
                ("no names", self.as_text(";"), "[data] columns")):
            with self.subTest(file=name):
                (self.folder / "fit" / "wrong.txt").write_text(text)
                (self.folder / "fit" / "wrong.toml").write_text(self.scene.replace("film_track.txt", "wrong.txt"))
                error = self.refused("kinematics", "fit/wrong.toml", "--bandwidth", "4 Hz", "-o", "x.csv")
                self.assertIn(said, error)
                self.assertIn("wrong.txt", error)

    def test_a_plain_track_of_one_marker_asks_one_question(self):
        (self.folder / "fit" / "plain.txt").write_text("t,x,y\n" + "".join(
            f"{0.04 * k:.2f},{300 + 50 * math.cos(0.2 * k):.2f},{100 + 5 * math.sin(0.2 * k):.2f}\n" for k in range(100)))
        plain = self.scene.replace("film_track.txt", "plain.txt").replace('units = { time = "s", position = "px" }', "")
        plain = re.sub(r"signal = \[.*?\n\]", 'signal = [{ marker = "marker", along = "x", of = "chain.node2.x" }]', plain,
                       flags=re.S)
        plain = re.sub(r"distance = .*", 'scale = "1 mm"', plain).replace('pivot = "pivot"', 'pivot = "(300, 100)"')
        (self.folder / "fit" / "plain.toml").write_text(plain)
        error = self.refused("kinematics", "fit/plain.toml", "--bandwidth", "4 Hz", "-o", "x.csv")
        self.assertIn("in which units are the columns t, x, y?", error)
        answer = re.search(r"units = \{.*?\}", error).group()
        (self.folder / "fit" / "plain.toml").write_text(plain.replace("[data]\n", f"[data]\n{answer}\n", 1))
        self.done("kinematics", "fit/plain.toml", "--bandwidth", "4 Hz", "-o", "plain.csv")
        self.assertEqual(len(rows_of(self.folder / "plain.csv")), 100)


class SeveralFilms(WithFolder):
    """The example of two films, of which the second was stopped for a while."""

    def test_one_damping_is_fitted_to_all(self):
        one = json.loads(self.done("fit", "fit/film_track.toml", "--json"))
        all_of_them = json.loads(self.done("fit", "fit/film_tracks.toml", "--json", "--picture", "films.svg"))
        for name, truth in (("line_damping_linear", 0.006), ("line_damping_quadratic", 0.004)):
            with self.subTest(parameter=name):
                low, high = all_of_them["parameter"][name]["interval"]
                self.assertLess(low, truth)
                self.assertGreater(high, truth)
                alone = one["parameter"][name]["interval"]
                self.assertLess(high - low, alone[1] - alone[0])
        self.assertEqual([r["file"] for r in all_of_them["record"]], ["film_track.txt", "film_track_2.txt", "film_track_2.txt"])
        self.assertEqual(all_of_them["record"][2]["name"], "after the pause")
        # Half the pixels a metre with twice the noise: what is left in the second film is 2.5 times what is in the first.
        left = [r["signal"][0]["rms"] for r in all_of_them["record"]]
        for rms in left[1:]:
            self.assertAlmostEqual(rms / left[0], 2.5, delta=0.4)

    def test_one_of_them_is_looked_at_by_its_name(self):
        common = ("kinematics", "fit/film_tracks.toml", "--bandwidth", "4 Hz", "-o", self.folder / "one.csv")
        error = self.refused(*common)
        self.assertIn("3 films", error)
        self.assertIn("film_track, film_track_2, after the pause", error)
        self.assertIn('no film "film_track_3"', self.refused(*common, "--film", "film_track_3"))
        self.done(*common, "--film", "after the pause")
        rows = rows_of(self.folder / "one.csv")
        self.assertAlmostEqual(math.hypot(float(rows[9]["joint_x [m]"]), float(rows[9]["joint_z [m]"])), 0.5, delta=0.005)
        self.assertLess(len(rows), 160)

    def test_a_film_with_a_pause_is_no_record_of_windows_without_frames(self):
        text = (self.folder / "fit" / "film_tracks.toml").read_text().replace('end = "5 s"', 'end = "20 s"')
        (self.folder / "fit" / "paused.toml").write_text(text.replace('window = "2 s"', 'window = "0.6 s"'))
        error = self.refused("fit", "fit/paused.toml")
        self.assertIn("film_track_2.txt", error)
        self.assertIn("two [[data.record]]s", error)

    def test_what_goes_with_no_track_is_refused(self):
        text = (self.folder / "fit" / "film_tracks.toml").read_text()
        for old, new, said in (("[camera]\n", "[camera]\nframe_rate = \"25 Hz\"\n", "and [camera] a frame rate"),
                               ('end = "5 s"', 'end = "0.5 s"', "must be later than the start"),
                               ('name = "after the pause"', "", 'two records are called "film_track_2"')):
            (self.folder / "fit" / "wrong.toml").write_text(text.replace(old, new, 1))
            with self.subTest(put=new):
                self.assertIn(said, self.refused("fit", "fit/wrong.toml"))


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

    def test_a_lossy_film_is_told(self):
        self.done("film", "film/film.toml", "-o", "told.mp4")
        told = json.loads(self.done("track", "told.mp4", "--markers", "pivot, joint, bob", "--first", FIRST, "--radius",
                                    "4 px .. 10 px", "-o", "told.csv", "--json"))
        self.assertTrue(any("compressed with loss" in caution for caution in told["cautions"]), told["cautions"])
        self.assertFalse(any("compressed with loss" in caution for caution in json.loads(self.tracked.stdout)["cautions"]))

    @unittest.skipUnless(shutil.which("ffmpeg"), "needs ffmpeg, which writes films with B-frames")
    def test_a_film_with_b_frames_has_the_times_of_its_frames(self):
        subprocess.run(["ffmpeg", "-loglevel", "error", "-i", "film.avi", "-c:v", "libx264", "-pix_fmt", "yuv420p", "b.mp4"],
                       cwd=self.folder, check=True)
        self.done("track", "b.mp4", "--markers", "pivot, joint, bob", "--first", FIRST, "--radius", "4 px .. 10 px", "-o",
                  "b.csv")
        rms, count = self.error_of("b.csv", "truth.csv", ("pivot", "joint", "bob"))
        self.assertGreater(count, 0.95 * 6 * len(rows_of(self.folder / "truth.csv")))
        # Loss displaces marks by 0.06 px; a frame that is one late is 40 px off.
        self.assertLess(rms, 0.5)

    def error_of(self, track, truth, names):
        """rms of places against the truth, px, and how many there are."""
        exact = {round(float(row["t [s]"]), 3): row for row in rows_of(self.folder / truth)}
        errors = [float(row[f"{name}_{c} [px]"]) - float(exact[round(float(row["t [s]"]), 3)][f"{name}_{c} [px]"])
                  for row in rows_of(self.folder / track) for name in names for c in "xy" if row[f"{name}_x [px]"]]
        return math.sqrt(sum(e * e for e in errors) / len(errors)), len(errors)

    def test_tags_of_the_example_are_tracked(self):
        self.done("film", "film/tags.toml", "-o", "tags.avi", "--truth", "tags_truth.csv")
        ran = self.froude("track", "tags.avi", "--tags", "apriltag 36h11", "--markers", "pivot = 3, elbow = 7, tip = 11", "-o",
                          "tags.csv", "--annotated", "tags_annotated.avi", "--picture", "tags.png")
        if "no module aruco" in ran.stderr or "reads no tags" in ran.stderr:
            self.skipTest("OpenCV has no tags here")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        off, places = self.error_of("tags.csv", "tags_truth.csv", ("pivot", "elbow", "tip"))
        self.assertLess(off, 0.1)
        self.assertGreater(places, 0.9 * 2 * 3 * len(rows_of(self.folder / "tags_truth.csv")))

    def test_the_template_of_the_example_is_found(self):
        made = subprocess.run([sys.executable, str(SOURCE / "examples" / "film" / "make_marker.py"), self.folder / "made.png"],
                              timeout=60)
        self.assertEqual(made.returncode, 0)
        self.assertEqual((self.folder / "made.png").read_bytes(), (self.folder / "film" / "marker.png").read_bytes())
        self.done("track", "film.avi", "--template", "film/marker.png", "--markers", "pivot, joint, bob", "--first", FIRST, "-o",
                  "template.csv")
        off, places = self.error_of("template.csv", "truth.csv", ("pivot", "joint", "bob"))
        self.assertLess(off, 0.1)
        self.assertGreater(places, 0.9 * 2 * 3 * len(rows_of(self.folder / "truth.csv")))

    def test_poses_of_filmed_arms_are_those_of_the_run(self):
        self.done("film", "film/arms_film.toml", "-o", "arms.avi")
        self.done("track", "arms.avi", "--markers", "pivot, elbow, tip", "--order", "top to bottom", "--radius", "3 px .. 10 px",
                  "-o", "film/arms.csv")
        told = json.loads(self.done("kinematics", "film/arms_fit.toml", "--bandwidth", "9 Hz", "-o", "arms_motion.csv", "--json"))
        self.done("run", "film/arms_scene.toml", "-o", "arms.h5", "--csv", "arms_run.csv")
        exact = {round(float(row["time [s]"]), 3): row for row in rows_of(self.folder / "arms_run.csv")}
        motion = rows_of(self.folder / "arms_motion.csv")[3:-3]
        self.assertGreater(len(motion), 130)
        for body in told["body"]:
            self.assertLess(body["stray"], 2)
            pitch = f"{body['name']}.pitch"
            offs = [(float(row[f"{pitch} [rad]"]) - float(exact[round(float(row["t [s]"]), 3)][f"{pitch} [rad]"]),
                     float(row[f"{pitch}_deviation [rad]"])) for row in motion]
            self.assertLess(max(abs(off) for off, _ in offs), 0.01)
            # As of the places without a film: whips of the lower arm are cut a little by the bandwidth.
            self.assertGreater(sum(abs(off) < 1.96 * sd for off, sd in offs) / len(offs), 0.8, pitch)

    def test_a_film_of_neither_discs_nor_tags_is_refused(self):
        text = (self.folder / "film" / "tags.toml").read_text()
        for old, new, said in (("tag_side", "# tag_side", "only one of tags and tag_side"),
                               (", tag = 3", "", "\"pivot\" has no tag"),
                               ("tag = 3", "tag = 900", "are 0 to 586"),
                               ("tags =", "# tags =", "disc_radius"),
                               ('tags = "apriltag 36h11"', 'tags = "apriltag"', "no family"),
                               ("tag_side", 'disc_radius = "1 mm"\ntag_side', "is of discs")):
            (self.folder / "film" / "wrong.toml").write_text(text.replace(old, new, 1))
            with self.subTest(put=new):
                self.assertIn(said, self.refused("film", "film/wrong.toml", "-o", "x.avi"))

    def test_what_cannot_be_read_says_what_to_do(self):
        (self.folder / "text.mp4").write_text("no film")
        track = ["--markers", "2", "-o", "x.csv", "--to", "0.4 s"]
        self.assertIn("ffmpeg -i text.mp4", self.refused("track", "text.mp4", *track))
        self.assertIn("no such film", self.refused("track", "nothing.mp4", *track))
        self.assertIn("two are needed", self.refused("track", "film/marker.png", *track))
        (self.folder / "cut.avi").write_bytes((self.folder / "film.avi").read_bytes()[:2_000_000])
        cut = json.loads(self.done("track", "cut.avi", "--markers", "pivot, joint, bob", "--first", FIRST, "--radius",
                                   "4 px .. 10 px", "-o", "cut.csv", "--json"))
        self.assertTrue(any("300 frames, and" in caution for caution in cut["cautions"]), cut["cautions"])
        self.assertTrue(any("rolling shutter" in caution for caution in cut["cautions"]), cut["cautions"])
        self.assertIn("no such picture", self.refused("track", "film.avi", "--template", "nothing.png", *track))
        self.assertIn("--frame-rate", self.refused("track", "film.avi", "--frame-rate", "25", *track))
        self.assertIn("first place of \"m1\"", self.refused("track", "film.avi", "--first", "(10, 10), (411, 260)", *track))
        self.assertIn("--first", self.refused("track", "film.avi", *track))
        self.assertIn("4 are named", self.refused("track", "film.avi", "--markers", "4", "-o", "x.csv", "--to", "0.4 s"))
        self.assertIn("no frame shows a disc", self.refused("track", "film.avi", "--radius", "40 px .. 60 px", *track))
        self.assertIn("--radius", self.refused("track", "film.avi", "--radius", "4 px", *track))
        self.assertIn("no colour", self.refused("track", "film.avi", "--colour", "red", *track))
        self.assertIn("frames lie in the time", self.refused("track", "film.avi", "--from", "90 s", *track))
        self.assertIn("would be replaced", self.refused("track", "film.avi", "--markers", "2", "-o", "film.avi"))

    def test_a_film_in_which_no_marker_moves_says_so(self):
        self.assertIn("nothing moves in this film",
                      self.refused("track", "film.avi", "--markers", "1", "--first", "(322, 120)", "-o", "x.csv", "--to", "1 s"))

    def test_a_lens_of_another_size_is_refused(self):
        lens = (self.folder / "film" / "lens.toml").read_text().replace("width = 640", "width = 1280")
        (self.folder / "film" / "wide.toml").write_text(lens)
        fit = (self.folder / "film" / "fit.toml").read_text().replace("lens.toml", "wide.toml")
        (self.folder / "film" / "wide_fit.toml").write_text(fit)
        self.assertIn("640 x 480 px, the lens was calibrated with 1280 x 480 px", self.refused("fit", "film/wide_fit.toml"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
