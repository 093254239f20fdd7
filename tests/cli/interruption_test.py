#!/usr/bin/python3
"""A run that gets SIGINT or SIGTERM keeps what it has computed and says that it is not all.

    interruption_test.py FROUDE SOURCE
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py

from run_scenes import DISC, OPEN_WATER

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", FROUDE_CACHE="off")

# It takes a second of work for some thousands of its own.
PENDULUM = OPEN_WATER + DISC + '[joint.pto]\ndamping = "1 N m s/rad"\n'
# What is left out of the memory of its waves is told by a run of its own.
MODULE = OPEN_WATER + """[[body]]
name = "module"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
free = ["heave", "pitch"]
initial = { heave = "0.3 m" }
[body.hydrodynamics]
file = "pontoon1.nc"
radiation = { memory_tolerance = 2e-2 }
hydrostatics = true
"""
CYLINDERS = """[body.hydrodynamics.cylinders]
at = "(±5.2, ±5.2, 0) m"
diameter = "1.6 m"
draught = "1.13 m"
frequencies = "0.1 rad/s .. 5 rad/s, 2000 values"
"""


def asked(duration, extra="", solve='step = "0.02 s"\naccept_error = true\n'):
    return f'[ask]\nrun = {{ duration = "{duration} s", every = "0.1 s"{extra} }}\naccuracy = 2e-2\n[solve]\n{solve}'


class Interruption(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_interruption_"))
        shutil.copy(SOURCE / "examples/data/pontoon1.nc", self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def begin(self, text, name):
        (self.folder / f"{name}.toml").write_text(text)
        run = subprocess.Popen([str(FROUDE), "run", f"{name}.toml", "-o", f"{name}.h5", "--csv", f"{name}.csv"],
                               cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.kill)  # of one that has ended it does nothing
        return run

    def whole(self, text, name="whole"):
        run = self.begin(text, name)
        said = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 0, said)
        return said[0]

    def assert_interrupted(self, run, err, number=signal.SIGINT):
        self.assertEqual(run.returncode, 128 + number, err)
        self.assertIn(f"interrupted by {signal.Signals(number).name}", err)
        self.assertIn("what was computed is in", err)

    def rows(self, name):
        return (self.folder / f"{name}.csv").read_bytes().splitlines()

    def kept(self, which):
        """True if a run of that name has left a checkpoint of the result cut.h5."""
        try:
            files = os.listdir(self.folder / "cut.h5.checkpoints")
        except FileNotFoundError:
            return False
        return any(name.startswith(which) and name.endswith(".checkpoint") for name in files)

    def interrupt_in(self, text, which):
        """Interrupts the run once the one of that name has left a checkpoint; again where it has ended before, by chance."""
        for _ in range(10):
            run = self.begin(text, "cut")
            while run.poll() is None and not self.kept(which):
                time.sleep(0.002)
            run.send_signal(signal.SIGINT)
            out, err = run.communicate(timeout=120)
            if run.returncode != 0:
                break
        self.assert_interrupted(run, err)
        return out, err

    def result(self, name):
        """Why it stopped, samples by signal, and signals that tell an error."""
        with h5py.File(self.folder / f"{name}.h5") as file:
            notes = dict(file["provenance/notes"].attrs) if "provenance/notes" in file else {}
            data = {key: file[key][:] for key in file if key != "provenance"}
            stopped = notes.get("stopped")
            return (stopped.decode() if isinstance(stopped, bytes) else stopped, data,
                    [key for key in data if "error" in file[key].attrs])

    def test_it_leaves_the_samples_that_the_whole_run_has(self):
        # Nothing of the pendulum depends on how long it is asked for: the first 30 s are the whole run's.
        self.whole(PENDULUM + asked(30))
        self.assertEqual(self.result("whole")[0], None)
        self.assertTrue(self.result("whole")[2], "a run that ends tells its error")
        whole = self.rows("whole")
        for number in (signal.SIGINT, signal.SIGTERM):
            for after in (0.5, 2, 8):  # s, on machines with little time for it
                run = self.begin(PENDULUM + asked(100000), "cut")
                time.sleep(after)
                run.send_signal(number)
                out, err = run.communicate(timeout=120)
                if run.returncode != -number and len(self.rows("cut")) > 4:  # else it had not begun to listen, or to step
                    break
            self.assert_interrupted(run, err, number)
            self.assertIn("at t = ", err)
            stopped, data, errors = self.result("cut")
            self.assertIn(f"interrupted by {signal.Signals(number).name} at t = ", stopped)
            self.assertEqual(errors, [])
            self.assertIn("not estimated: interrupted", out)
            cut = self.rows("cut")
            self.assertEqual(len(cut), len(data["time"]) + 1)
            self.assertTrue(all(len(values) == len(data["time"]) for values in data.values()))
            at = float(stopped.split("t = ")[1].split()[0])
            told = 1e-5 * at  # six digits of it
            self.assertTrue(-told <= at - data["time"][-1] < 0.1 + told, "no sample before its last step is lost")
            self.assertGreater(len(cut), 4)
            common = min(len(cut), len(whole))
            self.assertEqual(cut[:common], whole[:common])

    def test_where_only_the_error_is_missing_the_run_is_whole_and_tells_none(self):
        checkpoints = MODULE + asked(200, ', checkpoint = "10 s"', 'step = "0.001 s"\naccept_error = true\n')
        self.whole(checkpoints)
        out, err = self.interrupt_in(checkpoints, "memory-of-")
        self.assertIn("before the error was estimated", err)
        self.assertIn("goes on from the last checkpoint", err)
        stopped, data, errors = self.result("cut")
        self.assertIn("before the error was estimated", stopped)
        self.assertEqual(errors, [])
        self.assertIn("not estimated: interrupted by SIGINT", out)
        self.assertEqual(self.rows("cut"), self.rows("whole"))
        self.assertIn("went on from its checkpoint", self.whole(checkpoints, "cut"))
        self.assertEqual(self.result("cut")[0], None)
        self.assertEqual(self.result("cut")[2], self.result("whole")[2])
        self.assertFalse(list(self.folder.glob("*.checkpoints")))

    def test_with_checkpoints_the_same_command_goes_on_to_the_same_bits(self):
        text = PENDULUM + asked(40, ', checkpoint = "4 s"', 'step = "0.005 s"\naccept_error = true\n')
        self.whole(text)
        self.interrupt_in(text, "run-of-level0-")
        cut, whole = self.rows("cut"), self.rows("whole")
        self.assertLess(len(cut), len(whole))
        self.assertEqual(cut, whole[:len(cut)])
        self.assertIn("went on from its checkpoint", self.whole(text, "cut"))
        self.assertEqual(self.rows("cut"), whole)

    def test_before_the_first_step_of_the_run_itself_its_start_is_kept(self):
        # The step is chosen, so runs of longer steps come first: they leave checkpoints, and the run itself has none.
        text = PENDULUM + asked(3000, ', checkpoint = "20 s"', "")
        self.interrupt_in(text, "run-of-level1-")
        self.assertFalse(self.kept("run-of-level0-"))
        stopped, data, errors = self.result("cut")
        self.assertIn("at t = ", stopped)
        self.assertEqual((list(data["time"]), errors), ([0.0], []))

    def test_a_second_signal_ends_at_once(self):
        run = self.begin(MODULE.replace('file = "pontoon1.nc"\n', "") + CYLINDERS + asked(60), "cut")
        time.sleep(1)  # it prepares what the run needs, which takes it seconds
        run.send_signal(signal.SIGINT)
        time.sleep(0.2)
        self.assertIsNone(run.poll(), "one asks only")
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=20)
        self.assertEqual(run.returncode, -signal.SIGTERM)
        self.assertFalse((self.folder / "cut.h5").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
