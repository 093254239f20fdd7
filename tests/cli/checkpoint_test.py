#!/usr/bin/python3
"""A run that is killed and begun again ends with the bits of the undisturbed one; other checkpoints are refused.

    checkpoint_test.py FROUDE SOURCE
"""
import csv
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from run_scenes import DISC, OPEN_WATER

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", FROUDE_CACHE="off")

BEGIN = """schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "jonswap"
hs = "0.5 m"
tp = "5 s"
heading = "0 deg"
seed = 3
ramp = "10 s"
"""
MODULE = """[[body]]
name = "module"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
{initial}
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = {{ {memory} }}
hydrostatics = true
"""
MOORING = """[[mooring]]
on = "module"
kind = "linear"
stiffness = { surge = "4280 N/m", sway = "10348 N/m", yaw = "15839 N m/rad" }
"""
RACK = """[[joint]]
name = "rack"
kind = "slider"
between = ["ground", "module"]
at = "(0, 0, 0) m"
axis = "z"
[joint.pto]
damping = "5 kN s/m"
"""


def asked(duration, every, extra="", solve=""):
    return (f'[ask]\nrun = {{ duration = "{duration} s", every = "{every} s", checkpoint = "7 s"{extra} }}\n'
            f'accuracy = 2e-2\n[solve]\naccept_error = true\n{solve}')


def module(memory="", initial=""):
    return BEGIN + MODULE.format(memory=memory, initial=initial)


LINE = """[[line]]
name = "d"
from = "(0, 0, 0) m"
to = "(1.2, 0, 0) m"
length = "2 m"
segments = 5
mass_per_length = "1 kg/m"
[line.release]
node = 2
at = "(0.4, 0.2, -0.5) m"
"""
SWITCH = """[[connector]]
name = "spring"
between = ["disc", "ground"]
ends = ["(0, 0, 2) m", "(0, 9, 2) m"]
kind = "axial"
stiffness = "900 N/m"
rest_length = "as placed"
[connector.switch]
watch = "disc.sway"
every = "1 s"
window = "4 s"
hysteresis = "0.2 Hz"
settings = [{ from = "0 s", stiffness = "300 N/m" }, { from = "6 s", stiffness = "90 N/m" }]
"""


# What holds state in each: the memory of radiated waves as it is chosen (poles), as convolutions, friction and a latch
# that stick, nodes of a line, what a switch has seen, and the methods of the steps.
SCENES = {
    "poles": module("memory_tolerance = 1e-2") + MOORING + asked(100, 0.2),
    "direct": module('method = "direct", memory = "20 s", accept_error = 0.2') + MOORING + asked(100, 0.2),
    "partitioned": module('method = "partitioned", memory = "20 s", accept_error = 0.2') + MOORING + asked(100, 0.2),
    "friction": module("memory_tolerance = 1e-2") + RACK
                + '[joint.friction]\ndynamic = "300 N"\nstatic = "400 N"\n' + asked(60, 0.1),
    "latch": module("memory_tolerance = 1e-2", 'initial = { heave = "1 cm" }') + RACK
             + 'latch = { hold = "2 s" }\n' + asked(60, 0.1),
    "energy_momentum": OPEN_WATER + DISC + asked(30, 0.1, solve='integrator = { name = "energy_momentum" }\n'),
    "line": OPEN_WATER + LINE + asked(30, 0.1),
    "switch": OPEN_WATER + DISC + SWITCH + asked(30, 0.1),
    "explicit_pair": OPEN_WATER + DISC + asked(30, 0.1, solve='integrator = { name = "explicit_pair" }\n'),
}


class Checkpoints(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_checkpoints_"))
        shutil.copy(SOURCE / "examples/data/pontoon1.nc", self.folder)
        self.random = random.Random(26)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def scene(self, text, name="s.toml"):
        (self.folder / name).write_text(text)
        return name

    def command(self, scene, stem):
        return [str(FROUDE), "run", scene, "-o", f"{stem}.h5", "--csv", f"{stem}.csv"]

    def run_froude(self, scene, stem):
        return subprocess.run(self.command(scene, stem), cwd=self.folder, env=ENVIRONMENT, capture_output=True,
                              text=True, timeout=300)

    def kept(self, stem):
        return sorted((self.folder / f"{stem}.h5.checkpoints").glob("*.checkpoint"))

    def kill_once(self, scene, stem, after):
        """Kills the run `after` seconds from when it first keeps or changes a checkpoint. Returns False if it ended."""
        before = {p: p.stat().st_mtime_ns for p in self.kept(stem)}
        run = subprocess.Popen(self.command(scene, stem), cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
        def changed():
            try:
                return {p: p.stat().st_mtime_ns for p in self.kept(stem)} != before
            except FileNotFoundError:
                return True
        while run.poll() is None and not changed():
            time.sleep(0.002)
        time.sleep(after)
        run.send_signal(signal.SIGKILL)
        said = run.communicate()[1]
        self.assertIn(run.returncode, (0, -signal.SIGKILL), said)
        return run.returncode != 0

    def test_a_killed_run_ends_with_the_bits_of_the_undisturbed_one(self):
        for name, text in SCENES.items():
            with self.subTest(name):
                scene = self.scene(text, f"{name}.toml")
                done = self.run_froude(scene, "whole")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertFalse((self.folder / "whole.h5.checkpoints").exists())
                killed = 0
                for after in (0, *(self.random.uniform(0, 0.05) for _ in range(3))):
                    if not self.kill_once(scene, name, after):
                        break
                    killed += 1
                went_on = bool(self.kept(name))
                done = self.run_froude(scene, name)
                self.assertEqual(done.returncode, 0, done.stderr)
                if went_on:
                    self.assertIn("went on from its checkpoint", done.stdout + done.stderr)
                self.assertGreaterEqual(killed, 1)
                self.assertEqual((self.folder / f"{name}.csv").read_bytes(), (self.folder / "whole.csv").read_bytes())

    def test_a_checkpoint_changes_nothing_but_the_last_digits(self):
        # Newton ends at 1e-9 of accelerations here, and first guesses that begin anew move what it leaves: runs differ by
        # less than 1e-6 of each signal, as any two do that end Newton elsewhere (docs/guide/motion.md). A state that was
        # lost would show in the first digits. Friction and latches change at instants that move with the last digits, so they are not here.
        for name in ("poles", "direct", "partitioned", "energy_momentum", "explicit_pair"):
            with self.subTest(name):
                text = SCENES[name]
                self.assertEqual(self.run_froude(self.scene(text, "with.toml"), "with").returncode, 0)
                without = text.replace(', checkpoint = "7 s"', "")
                self.assertEqual(self.run_froude(self.scene(without, "without.toml"), "without").returncode, 0)
                one, other = (list(csv.reader((self.folder / f"{s}.csv").read_text().splitlines()))
                              for s in ("with", "without"))
                self.assertEqual(one[0], other[0])
                for column, title in enumerate(one[0]):
                    if title.split()[0] not in ("module.surge", "module.heave", "module.pitch", "pivot.angle"):
                        continue  # sway, roll and yaw are rounding alone
                    a, b = ([float(row[column]) for row in rows[1:]] for rows in (one, other))
                    size = max(map(abs, b)) or 1
                    self.assertLess(max(abs(x - y) for x, y in zip(a, b)), 1e-6 * size, title)

    def kept_run(self):
        # Killed at its first checkpoint of very many: the test asks no speed of the machine.
        scene = self.scene(SCENES["poles"].replace('duration = "100 s"', 'duration = "1700 s"'))
        self.assertTrue(self.kill_once(scene, "r", 0))
        self.assertTrue(self.kept("r"))
        return scene

    def test_what_is_damaged_or_of_something_else_is_refused(self):
        scene = self.kept_run()
        file, *others = self.kept("r")
        for other in others:
            other.unlink()
        whole = file.read_bytes()

        def refused(*words):
            done = self.run_froude(scene, "r")
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            for word in (file.name, "remove the folder", *words):
                self.assertIn(word, done.stderr)

        for at in (0, 60, len(whole) // 2, len(whole) - 1):
            file.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
            refused()
        for size in (0, 10, 100, len(whole) // 2, len(whole) - 1):
            file.write_bytes(whole[:size])
            refused("damaged")
        file.write_bytes(whole)
        text = (self.folder / scene).read_text()
        (self.folder / scene).write_text(text.replace("9088 kg", "9089 kg"))
        refused("another run", "scene")
        (self.folder / scene).write_text(text)
        data = self.folder / "pontoon1.nc"
        coefficients = data.read_bytes()
        shutil.copy(SOURCE / "examples/data/box2.nc", data)
        refused("another run", "pontoon1.nc")
        data.write_bytes(coefficients)
        file.write_bytes(whole.replace(b"version of froude: ", b"version of froude: 0", 1))
        refused("another run", "version of froude")
        file.write_bytes(whole)
        self.assertEqual(self.run_froude(scene, "r").returncode, 0)
        self.assertFalse(file.parent.exists())

    def test_what_has_a_state_that_cannot_be_kept_is_refused_at_the_start(self):
        sundials = 'integrator = { name = "sundials_bdf" }\n'
        for text, word in ((OPEN_WATER + DISC + asked(7, 0.1, solve=sundials), "sundials_bdf"),
                           (module() + MOORING + asked(7, 0.1, ', start = "steady"'), "steady")):
            with self.subTest(word):
                done = self.run_froude(self.scene(text), "r")
                if "without SUNDIALS" in done.stderr:
                    continue
                self.assertEqual(done.returncode, 2, done.stderr)
                for part in ("s.toml:", "checkpoint", word):
                    self.assertIn(part, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
