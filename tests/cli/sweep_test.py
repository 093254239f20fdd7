#!/usr/bin/python3
"""Sweeps as a user meets them: numbers, interruptions, faults of the disk.  sweep_test.py FROUDE SOURCE

The reference of a number is the run of its case by itself, whose scene `froude sweep --case` prints.
"""
import csv
import fcntl
import json
import math
import os
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from run_scenes import SCENE_OF_SWEEPS as SCENE, STUDY_OF_SWEEPS as STUDY

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


class Sweeps(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_sweep_"))
        self.write("block.toml", SCENE)
        self.write("study.toml", STUDY)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def command(self, *arguments):
        return [str(FROUDE), "sweep", *map(str, arguments)]

    def sweep(self, *arguments, status=0, **options):
        done = subprocess.run(self.command(*arguments), cwd=self.folder, capture_output=True, text=True, timeout=120,
                              **options)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def table(self, name):
        return (self.folder / name / "table.csv").read_bytes()

    def rows(self, name):
        with open(self.folder / name / "table.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_numbers_are_those_of_a_run_by_itself(self):
        self.sweep("study.toml", "-o", "out")
        rows = self.rows("out")
        self.assertEqual(len(rows), 40)
        for case in (1, 23):
            self.write("case.toml", self.sweep("study.toml", "--case", case).stdout)
            run = subprocess.run([str(FROUDE), "run", "case.toml", "--json"], cwd=self.folder, capture_output=True, text=True)
            surge = json.loads(run.stdout)["signals"]["block.surge"]
            row = rows[case - 1]
            self.assertEqual(float(row["block.surge.deviation [m]"]), surge["standard_deviation"])
            self.assertEqual(float(row["block.surge.maximum [m]"]), surge["highest"])
        database = sqlite3.connect(self.folder / "out" / "sweep.sqlite")
        known = database.execute('SELECT "block.surge.maximum" FROM cases WHERE mass = 100').fetchone()
        self.assertEqual(known[0], float(rows[0]["block.surge.maximum [m]"]))

    def test_a_plan_answers_one_case_and_keeps_nothing(self):
        said = json.loads(self.sweep("study.toml", "--plan", "--json").stdout)
        self.assertEqual(said["cases"], 40)
        self.assertGreater(said["expected_s"], 0)
        self.assertFalse((self.folder / "study.sweep").exists())

    def test_killed_at_any_moment_it_goes_on_to_the_same_bits(self):
        self.sweep("study.toml", "-o", "whole", "--threads", 1)
        for moment in (0.02, 0.1, 0.25, 0.4):
            name = f"killed{moment}"
            process = subprocess.Popen(self.command("study.toml", "-o", name), cwd=self.folder, stdout=subprocess.DEVNULL)
            time.sleep(moment)
            process.kill()
            process.wait()
            self.sweep("study.toml", "-o", name, "--threads", 2)
            self.assertEqual(self.table(name), self.table("whole"), moment)

    def test_interrupted_it_leaves_a_partial_result_that_says_so(self):
        # A quarter of a second a case: five for all of them on two cores, and little to wait for the first.
        self.write("block.toml", SCENE.replace('"60 s"', '"300 s"'))
        process = subprocess.Popen(self.command("study.toml", "-o", "out", "--json"), cwd=self.folder,
                                   stdout=subprocess.PIPE, text=True)
        database = self.folder / "out" / "sweep.sqlite"
        for _ in range(600):  # until a first case is in
            time.sleep(0.1)
            if database.exists() and self.done(database) > 0:
                break
        process.send_signal(signal.SIGINT)
        said = json.loads(process.communicate(timeout=60)[0])
        self.assertEqual(process.returncode, 130)
        self.assertTrue(said["partial"] and said["interrupted"])
        self.assertEqual(len(self.rows("out")), said["done"])
        self.assertLess(said["done"], 40)
        state = sqlite3.connect(database).execute("SELECT value FROM study WHERE key = 'state'").fetchone()
        self.assertEqual(state[0], "partial")

    @staticmethod
    def done(database):
        try:
            return sqlite3.connect(database).execute("SELECT count(*) FROM cases").fetchone()[0]
        except sqlite3.OperationalError:  # the table is just being made
            return 0

    def test_what_is_done_is_not_done_again(self):
        self.sweep("study.toml", "-o", "out")
        before = self.table("out")
        again = json.loads(self.sweep("study.toml", "-o", "out", "--json").stdout)
        self.assertEqual((again["answered"], again["done"]), (0, 40))
        self.assertEqual(self.table("out"), before)

    def test_series_that_are_torn_or_missing_are_made_again(self):
        self.write("study.toml", STUDY.replace('scene =', 'series = true\nscene =').replace("40 values", "4 values"))
        self.sweep("study.toml", "-o", "out")
        first, second = (self.folder / "out" / "series" / f"case-00000{n}.run.h5" for n in (1, 2))
        first.write_bytes(first.read_bytes()[:-1000])
        second.unlink()
        again = json.loads(self.sweep("study.toml", "-o", "out", "--json").stdout)
        self.assertEqual(again["answered"], 2)
        for file in (first, second):
            shown = subprocess.run([str(FROUDE), "psd", str(file)], capture_output=True, text=True)
            self.assertEqual(shown.returncode, 0, shown.stderr)
        self.sweep("--merge", "out", "-o", "copy")
        self.assertEqual((self.folder / "copy" / "series" / first.name).read_bytes(), first.read_bytes())

    def test_a_second_sweep_in_the_same_folder_is_refused(self):
        (self.folder / "out").mkdir()
        with open(self.folder / "out" / "lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn("another sweep is at work", self.sweep("study.toml", "-o", "out", status=2).stderr)
        self.sweep("study.toml", "-o", "out")

    def test_another_study_or_scene_is_refused_by_name(self):
        self.sweep("study.toml", "-o", "out")
        before = self.table("out")
        self.write("other.toml", STUDY.replace("40 values", "41 values"))
        said = self.sweep("other.toml", "-o", "out", status=2).stderr
        self.assertTrue("study.toml" in said and "other.toml" in said, said)
        self.write("block.toml", SCENE.replace("400 N/m", "500 N/m"))
        self.assertIn("scene", self.sweep("study.toml", "-o", "out", status=2).stderr)
        self.assertEqual(self.table("out"), before)

    def test_cases_that_fail_are_told_with_their_reasons(self):
        self.write("study.toml", STUDY.replace("100 kg .. 400 kg, 40", "-100 kg .. 100 kg, 3"))
        said = json.loads(self.sweep("study.toml", "-o", "out", "--json", status=3).stdout)
        self.assertEqual((said["done"], said["failed"]), (1, 2))
        self.assertEqual([row["state"] for row in self.rows("out")], ["failed", "failed", "done"])
        self.assertIn("must be positive", self.rows("out")[0]["reason"])

    def limited(self, limits, durations):
        self.write("study.toml", f'schema = 1\nscene = "block.toml"\n{limits}\n[[axis]]\nname = "duration"\n'
                   f'key = "ask.run.duration"\nvalues = {json.dumps([d + " s" for d in durations])}\n'
                   '[[output]]\nkind = "run"\nof = "block.surge"\nstatistic = "maximum"\n')

    def test_a_case_that_takes_too_long_or_too_much_memory_is_ended(self):
        # 1e8 samples of 8 bytes; 1e6 s take minutes.
        for limits, long, why in (('time_limit = "0.3 s"', "1000000", "longer than 0.3 s, the time_limit"),
                                  ('memory_limit = "50 MB"', "10000000", "more than 50 MB of memory, the memory_limit")):
            self.limited(limits, ["5", long, "6", long, "7"])
            for threads in (1, 2):
                said = json.loads(self.sweep("study.toml", "-o", f"out{long}{threads}", "--json", "--threads", threads,
                                             status=3).stdout)
                self.assertEqual((said["done"], said["failed"]), (3, 2))
                self.assertIn(why, said["failures"][0]["reason"])
            self.assertEqual(self.table(f"out{long}1"), self.table(f"out{long}2"))
        for wrong in ('"50 MiB"', '"-1 GB"', '"GB"'):
            self.limited(f"memory_limit = {wrong}", ["5"])
            self.assertIn(f"study.toml:3:16: error: memory_limit = {wrong}", self.sweep("study.toml", status=2).stderr)

    def test_a_process_of_cases_that_dies_takes_no_case_with_it(self):
        self.write("block.toml", SCENE.replace('"60 s"', '"300 s"'))
        self.write("study.toml", STUDY.replace("40 values", "6 values"))
        self.sweep("study.toml", "-o", "whole")
        self.write("study.toml", STUDY.replace("40 values", "6 values").replace("scene", 'time_limit = "1 h"\nscene'))
        process = subprocess.Popen(self.command("study.toml", "-o", "out"), cwd=self.folder, stdout=subprocess.DEVNULL)
        database = self.folder / "out" / "sweep.sqlite"
        while not database.exists() or self.done(database) == 0:
            time.sleep(0.02)
        # The one that has answered a case is at its second: that case is tried in a new one.
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="ascii").split()
        os.kill(int(children[0]), signal.SIGKILL)
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertEqual(self.table("out"), self.table("whole"))

    def test_a_full_disk_ends_it_and_what_was_done_is_kept(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (30000, 30000))
        self.write("block.toml", SCENE.replace('"60 s"', '"5 s"'))
        self.write("study.toml", STUDY.replace("40 values", "400 values"))
        said = self.sweep("study.toml", "-o", "out", status=2, preexec_fn=limit).stderr
        self.assertIn("free some space", said)
        self.sweep("study.toml", "-o", "out")
        self.sweep("study.toml", "-o", "whole")
        self.assertEqual(self.table("out"), self.table("whole"))

    def test_a_folder_that_cannot_be_written_is_refused_before_the_work(self):
        self.write("file", "")
        self.assertIn("cannot make the folder", self.sweep("study.toml", "-o", "file/out", status=2).stderr)
        self.assertIn("cannot", self.sweep("study.toml", "-o", "/proc/self", status=2).stderr)

    def test_a_rank_that_dies_ends_the_sweep_and_nothing_is_lost(self):
        if not (FROUDE.parent / "froude-ranks").exists() or shutil.which("mpirun") is None:
            self.skipTest("froude-ranks is not built, or there is no mpirun")
        self.write("block.toml", SCENE.replace('"60 s"', '"1 s"'))
        self.write("study.toml", STUDY.replace("40 values", "4000 values"))
        self.sweep("study.toml", "-o", "whole")
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        ranks = ["mpirun", "--oversubscribe", "-n", "3", *self.command("study.toml", "-o", "out", "--json")]
        process = subprocess.Popen(ranks, cwd=self.folder, env=environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        for _ in range(600):  # until a rank has kept something
            time.sleep(0.02)
            databases = list(self.folder.glob("out/rank-*/sweep.sqlite"))
            if any(self.done(database) > 0 for database in databases):
                break
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="ascii").split()
        os.kill(int(children[2]), signal.SIGKILL)
        process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertTrue(list(self.folder.glob("out/rank-*")))
        again = json.loads(subprocess.run(ranks, cwd=self.folder, env=environment, capture_output=True, timeout=60,
                                          check=True).stdout)
        self.assertEqual((again["ranks"], again["done"]), (3, 4000))
        self.assertTrue(again["unfinished_ranks"] > 0 and again["answered"] < 4000, again)
        self.assertEqual(self.table("out"), self.table("whole"))
        self.assertFalse(list(self.folder.glob("out/rank-*")))

    def test_processes_started_together_share_a_sweep_or_are_told_why_not(self):
        alone = self.folder / "bin"  # where froude-ranks does not stand beside it
        alone.mkdir()
        shutil.copy(FROUDE, alone)
        def froude(*arguments, launcher="OMPI_COMM_WORLD_SIZE"):
            return subprocess.run([alone / "froude", "sweep", "study.toml", *arguments], cwd=self.folder,
                                  capture_output=True, text=True, env={**os.environ, launcher: "3"}, timeout=60)
        for launcher in ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"):
            said = froude("-o", "out", launcher=launcher)
            self.assertEqual(said.returncode, 2)
            self.assertIn("scripts/setup mpi", said.stderr)
        self.assertEqual(froude("-o", "out", "--part", "2/20").returncode, 0)
        self.assertEqual(len(self.rows("out")), 2)

    def test_a_map_of_a_part_waits_for_the_others(self):
        study = STUDY.replace("40 values", "2 values") + """\
[[axis]]
name = "start"
key = "body.block.initial.surge"
values = ["10 cm", "20 cm"]
[[picture]]
file = "map.svg"
of = "block.surge.range"
x = "mass"
y = "start"
"""
        self.write("study.toml", study)
        for part in (1, 2):
            said = self.sweep("study.toml", "--part", f"{part}/2", "-o", f"part{part}").stdout
            self.assertIn("map.svg is not drawn yet", said)
            self.assertFalse((self.folder / f"part{part}" / "map.svg").exists())
        self.assertNotIn("not drawn", self.sweep("--merge", "part1", "part2", "-o", "whole").stdout)
        self.assertTrue((self.folder / "whole" / "map.svg").exists())
        self.write("study.toml", study.replace('"10 cm", ', ""))
        said = self.sweep("study.toml", "-o", "none", status=2).stderr
        self.assertIn('a map, which needs two values and more on axis "start"', said)
        self.assertFalse((self.folder / "none").exists())

    def test_a_damaged_database_is_refused_and_stays(self):
        self.sweep("study.toml", "-o", "out")
        database = self.folder / "out" / "sweep.sqlite"
        database.write_bytes(b"x" * 4096)
        self.assertIn("not a database", self.sweep("study.toml", "-o", "out", status=2).stderr)
        self.assertEqual(database.read_bytes(), b"x" * 4096)

    def test_a_number_that_has_changed_on_the_disk_is_found_and_made_again(self):
        self.sweep("study.toml", "-o", "out")
        before = self.table("out")
        database = sqlite3.connect(self.folder / "out" / "sweep.sqlite")
        database.execute('UPDATE cases SET "block.surge.range" = 7 WHERE "case" = 5')
        database.commit()
        database.close()
        again = json.loads(self.sweep("study.toml", "-o", "out", "--json").stdout)
        self.assertEqual((again["answered"], self.table("out")), (1, before))

    def test_no_file_that_is_read_is_written(self):
        picture = '[[picture]]\nfile = "p.svg"\nof = "block.surge.range"\nx = "mass"\n'
        for planted in ("table.csv", "p.csv", "p.svg"):
            self.write(planted, "time [s],x [m]\n0,0\n1,0\n")
            self.write("block.toml", SCENE.replace("schema = 1", f'schema = 1\ntitle = "{planted}"'))
            self.write("study.toml", STUDY + picture)
            said = self.sweep("study.toml", "-o", ".", status=2).stderr
            self.assertIn("would be replaced", said)
        for name in ("../p.svg", "/tmp/p.svg", "a/p.svg", "table.svg"):
            self.write("study.toml", STUDY + picture.replace("p.svg", name))
            self.assertIn("no name of a picture", self.sweep("study.toml", "-o", ".", status=2).stderr)

    def test_a_table_is_drawn_upon_a_picture(self):
        self.write("points.csv", "source,mass [kg],motion [cm]\nmeasured,150,20\nmeasured,200,10\nbook,300,5\n")
        picture = ('[[picture]]\nfile = "p.svg"\nof = "block.surge.range"\nx = "mass"\n'
                   'upon = [{ file = "points.csv", x = "mass", y = "motion", by = "source" }]\n')
        self.write("study.toml", STUDY + picture)
        self.sweep("study.toml", "-o", "out")
        drawn = (self.folder / "out" / "p.svg").read_text()
        self.assertTrue(">measured<" in drawn and ">book<" in drawn, "the legend names both")
        before = len((self.folder / "out" / "p.csv").read_text().splitlines())
        self.assertEqual(before, 1 + 40)  # numbers beside the picture are those of the study alone
        for old, new, said in (('"points.csv"', '"none.csv"', "study.toml:"), ('y = "motion"', 'y = "moton"', 'did you mean "motion"?'),
                               ('y = "motion"', 'y = "source"', "points.csv:"), ('by = "source"', 'by = "sourc"', "points.csv:1")):
            self.write("study.toml", STUDY + picture.replace(old, new))
            told = self.sweep("study.toml", "-o", "other", status=2).stderr
            self.assertIn(said, told)
            self.assertFalse((self.folder / "other").exists(), "refused before the first case")
        self.write("study.toml", STUDY + picture.replace('y = "motion"', 'y = "mass"'))
        self.assertIn("points.csv:1", self.sweep("study.toml", "-o", "out", status=2).stderr)  # a mass is no length

    def test_pictures_have_panels_and_draw_runs_over_time(self):
        two = STUDY.replace('range = "100 kg .. 400 kg, 40 values"', 'values = ["100 kg", "400 kg"]').replace(
            "schema = 1", "schema = 1\nseries = true") + (
            '[[axis]]\nname = "start"\nkey = "body.block.initial.surge"\nvalues = ["20 cm", "40 cm"]\n')
        numbers = ('[[picture]]\nfile = "n.svg"\nof = ["block.surge.range", "block.surge.maximum"]\nx = "start"\n'
                   'panel = "mass"\n')
        over_time = '[[picture]]\nfile = "t.svg"\nof = "block.surge"\nx = "time"\nby = "mass"\n'
        self.write("study.toml", two + numbers + over_time)
        self.sweep("study.toml", "-o", "out")
        drawn = (self.folder / "out/n.svg").read_text()
        for label in ("block.surge.range at 100 kg", "block.surge.range at 400 kg", "block.surge.maximum at 400 kg"):
            self.assertIn(label, drawn)
        with open(self.folder / "out/n.csv", newline="", encoding="utf-8") as file:
            header, *lines = csv.reader(file)
        self.assertEqual(len(header), 1 + 4)
        # The largest value of a swing that is let go is where it is let go, whatever its mass.
        for name, values in zip(header[1:], zip(*(line[1:] for line in lines))):
            if "maximum" in name:
                self.assertTrue(all(abs(float(v) - s) < 1e-3 for v, s in zip(values, (0.2, 0.4))), (name, values))
        drawn = (self.folder / "out/t.svg").read_text()
        self.assertTrue(">mass 100 kg<" in drawn and ">mass 400 kg, case 4<" in drawn, "a curve for each case")
        for changed, said in ((over_time.replace('"block.surge"', '"block.surg"'), 'did you mean "block.surge"?'),
                              (over_time + 'y = "mass"\n', "hold only one of y, by"),
                              (numbers + 'upon = [{ file = "table.csv", x = "a", y = "b" }]\n', "this picture has several")):
            self.write("study.toml", two + changed)
            self.assertIn(said, self.sweep("study.toml", "-o", "out", status=2).stderr)

    def test_wrong_commands_have_one_error_with_a_remedy(self):
        for arguments, said in ((["study.toml", "--part", "5/4"], "no part"), (["study.toml", "--threads", 0], "threads"),
                                (["study.toml", "--case", 41], "there is no case 41"), ([], "which study"),
                                (["--merge", "none", "-o", "x"], "there is no sweep"), (["--merge", "none"], "-o")):
            done = self.sweep(*arguments, status=2)
            self.assertIn(said, done.stderr)

    def test_an_output_that_the_scene_does_not_have_is_refused_at_its_place(self):
        self.write("study.toml", STUDY.replace('"block.surge"', '"block.surg"'))
        said = self.sweep("study.toml", "-o", "out", status=2).stderr
        self.assertTrue("study.toml:9" in said and 'did you mean "block.surge"?' in said, said)

    def test_the_example_has_its_pictures(self):
        shutil.copytree(SOURCE / "examples", self.folder / "examples")
        said = json.loads(self.sweep("examples/sweep/study.toml", "-o", "out", "--json").stdout)
        self.assertEqual((said["cases"], said["failed"], said["skipped"]), (28, 0, 4))
        written = [str(Path("out") / name) for name in ("sweep.sqlite", "table.csv", "power.svg", "stroke.svg")]
        self.assertEqual(said["written"], written)
        for name in (*written, "out/power.csv", "out/stroke.csv"):
            self.assertTrue((self.folder / name).exists(), name)

    def test_the_studies_of_modules_have_their_pictures(self):
        shutil.copytree(SOURCE / "examples", self.folder / "examples")
        for study, pictures in (("choice", ("surge", "heave_pitch", "force")), ("control", ("control",)),
                                ("raos", ("surge", "heave", "pitch"))):
            said = json.loads(self.sweep(f"examples/sweep/{study}.toml", "-o", study, "--json").stdout)
            self.assertEqual((said["failed"], said["skipped"]), (0, 0), study)
            for name in pictures:
                self.assertTrue((self.folder / study / f"{name}.svg").exists(), name)
        # One period of the study is that of a response over periods: two codes for what is to be one number.
        self.write("one.toml", self.sweep("examples/sweep/choice.toml", "--case", 12).stdout)
        shutil.copy(self.folder / "one.toml", self.folder / "examples/sweep/one.toml")
        row = self.rows("choice")[11]
        done = subprocess.run([str(FROUDE), "rao", "examples/sweep/one.toml", "-o", "one.h5", "--json"],
                              cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        amplitude = json.loads(done.stdout)["signals"]["gap.force_x"]["amplitude"]
        self.assertEqual(len(amplitude), 1)
        self.assertAlmostEqual(float(row["gap.force_x.amplitude [N/m]"]) / amplitude[0], 1, delta=1e-12)
        # The controller acts after a window and two looks: without it the run is the same until then.
        deviation = {r["control [s]"]: float(r["m2.surge.deviation [m]"]) for r in self.rows("control")}
        self.assertLess(deviation["25"], deviation["180"])

    def test_the_studies_of_damping_have_their_pictures_and_a_best_damping(self):
        shutil.copytree(SOURCE / "examples", self.folder / "examples")
        for study, cases in (("regimes", 3), ("takeoff", 28)):
            said = json.loads(self.sweep(f"examples/sweep/{study}.toml", "-o", study, "--json").stdout)
            self.assertEqual((said["cases"], said["failed"]), (cases, 0), study)
            self.assertTrue((self.folder / study / f"{study}.svg").exists())
        # With a quarter of the critical damping the first swing back is e^(-pi zeta/sqrt(1 - zeta^2)) of the first; with
        # all of it and more there is none.
        lowest = [float(r["m.surge.minimum [m]"]) for r in self.rows("regimes")]
        zeta = 0.25
        self.assertAlmostEqual(lowest[0], -0.1 * math.exp(-math.pi * zeta / math.sqrt(1 - zeta ** 2)), delta=1e-4)
        self.assertGreater(min(lowest[1:]), -1e-9)
        # Power has its largest value inside the range, at all periods.
        power = {}
        for r in self.rows("takeoff"):
            power.setdefault(r["period [s]"], []).append(float(r["rack.pto_power.mean [W]"]))
        self.assertEqual(len(power), 4)
        for period, along in power.items():
            self.assertNotIn(along.index(max(along)), (0, len(along) - 1), period)

    def test_the_study_of_rows_has_its_507_cases(self):
        # One module, then 2, 3 and 5 on four sets of connectors, each in 39 waves; their scenes are read, not run.
        study = SOURCE / "examples" / "sweep" / "rows.toml"
        self.assertIn("count = 1,", self.sweep(study, "--case", 39).stdout)
        last = self.sweep(study, "--case", 507).stdout
        for written in ("count = 5,", '"(-26, 0, 0) m"', 'on = "m5"', '"(6390, 0, 0) N/m"', '"8 s"', '"3.3308 m"'):
            self.assertIn(written, last)
        self.assertIn("there is no case 508, of 507", self.sweep(study, "--case", 508, status=2).stderr)

    def test_numbers_of_a_fit_are_those_that_it_tells(self):
        fit = SOURCE / "examples" / "fit"
        for name in ("oscillation.toml", "oscillation.csv"):
            shutil.copy(fit / name, self.folder)
        told = json.loads(subprocess.run([str(FROUDE), "fit", "oscillation.toml", "--json"], cwd=self.folder,
                                         capture_output=True, text=True).stdout)
        self.write("study.toml", 'schema = 1\nscene = "oscillation.toml"\n[[axis]]\nname = "file"\nkey = "data.files"\n'
                   'values = ["oscillation.csv"]\n[[output]]\nkind = "fit"\nof = "cd"\nstatistic = ["value", "low"]\n')
        self.sweep("study.toml", "-o", "out")
        text = json.dumps(told)
        self.assertIn(self.rows("out")[0]["cd.value"], text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
