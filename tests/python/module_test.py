"""Runs, responses and controllers. Runs and responses are those of the program; controllers rule."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

import froude
from conftest import EXAMPLES as examples, program

# A weight on a spring in no water: the shortest scene with a connector.
spring = """
schema = 1
[water]
density = "1000 kg/m^3"
depth = "20 m"
[[body]]
name = "m"
mass = "2 kg"
radii_of_gyration = "(1, 1, 1) m"
free = ["surge"]
initial = { surge = "0.1 m" }
[[connector]]
name = "spring"
between = ["m", "ground"]
ends = ["(0, 0, 0) m", "(-1, 0, 0) m"]
kind = "axial"
stiffness = "8 N/m"
rest_length = "as placed"
[ask]
run = { duration = "10 s", every = "0.05 s" }
"""

# The same weight on a slider, whose power take-off is a spring and a damper.
rack = spring[:spring.index("[[connector]]")].replace('free = ["surge"]', 'centre_of_gravity = "(0, 0, 0) m"') + """[[joint]]
name = "rack"
kind = "slider"
between = ["ground", "m"]
at = "(0, 0, 0) m"
axis = "x"
[joint.pto]
stiffness = "8 N/m"
damping = "0.8 N s/m"
[ask]
run = { duration = "6 s", every = "0.05 s" }
"""


def scene_of(text, numbers={}):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scene.toml"
        file.write_text(text)
        return froude.read(file, numbers)


def result_of(command, example):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "out.h5"
        program(command, examples / example, "-o", file)
        with h5py.File(file) as h5:
            return {name: h5[name][()] for name in h5 if isinstance(h5[name], h5py.Dataset)}


class Module(unittest.TestCase):
    def test_a_run_is_that_of_the_program(self):
        run, file = froude.run(froude.read(examples / "forced.toml")), result_of("run", "forced.toml")
        self.assertEqual(run.stopped, "")
        np.testing.assert_array_equal(run.time, file["time"])
        for name in run.signals:
            np.testing.assert_array_equal(run[name], file[name])
        self.assertLess(abs(run.energy["residual"]), 1e-3 * run.energy["turnover"])

    def test_a_response_is_that_of_the_program(self):
        rao, file = froude.rao(froude.read(examples / "moored.toml")), result_of("rao", "moored.toml")
        self.assertIn("module.heave", rao)
        np.testing.assert_allclose(rao.omega, file["omega"], rtol=1e-15)
        for name in rao.signals:
            np.testing.assert_array_equal(rao[name], file[name] @ [1, 1j])

    def test_a_response_to_several_headings_has_a_row_for_each(self):
        rao, file = froude.rao(froude.read(examples / "headings.toml")), result_of("rao", "headings.toml")
        np.testing.assert_array_equal(rao.heading, file["heading"])
        np.testing.assert_allclose(np.degrees(rao.heading), np.linspace(0, 180, 13), rtol=0, atol=1e-12)
        for name in rao.signals:
            self.assertEqual(rao[name].shape, (13, len(rao.omega)))
            np.testing.assert_array_equal(rao[name], file[name] @ [1, 1j])
        with self.assertRaises(ValueError):
            rao["float.heave"][0, 0] = 1
        one = froude.rao(froude.read(examples / "moored.toml"))
        np.testing.assert_allclose(one.heading, [np.radians(20)], rtol=1e-15)
        self.assertEqual(one["module.heave"].shape, one.omega.shape)

    def test_signals_have_units_and_cannot_be_written(self):
        run = froude.run(scene_of(spring))
        self.assertEqual(run.unit("m.surge"), "m")
        self.assertIn("surge of m", run.meaning("m.surge"))
        with self.assertRaises(ValueError):
            run["m.surge"][0] = 1
        values = run["m.surge"]
        del run  # the array keeps what it looks at
        self.assertAlmostEqual(values[0], 0.1)

    def test_numbers_are_written_over_those_of_the_file(self):
        run = froude.run(scene_of(spring, {"connector.spring.stiffness": 32.0}))
        t = run.time  # omega = 4 rad/s; the midpoint rule's phase is off by (omega h)^2/12 a radian
        np.testing.assert_allclose(run["m.surge"], 0.1 * np.cos(4 * t), atol=0.1 * 4 * 10 * (4 * run.step) ** 2 / 12 * 2)

    def test_a_controller_that_changes_nothing_changes_nothing(self):
        scene = scene_of(spring)
        plain = froude.run(scene)["m.surge"]
        for decide in (lambda sample: None, lambda sample: 8.0):
            ruled = froude.run(scene, controllers={"spring": decide})
            np.testing.assert_array_equal(ruled["m.surge"], plain)

    def test_a_controller_sees_the_motion_and_sets_the_stiffness(self):
        seen = []

        def decide(sample):
            seen.append((sample.time, sample["m.surge"], sample.velocity("m")[0]))
            return 0.0 if sample.time >= 5 else None

        run = froude.run(scene_of(spring), controllers={"s*": decide})
        self.assertEqual(len(seen), run.steps)
        time, place, velocity = np.array(seen).T
        np.testing.assert_allclose(np.interp(run.time[1:], time, place), run["m.surge"][1:], atol=1e-12)
        free = time > 5 + run.step
        np.testing.assert_allclose(velocity[free], velocity[free][0], rtol=1e-9)  # nothing holds it any more
        self.assertEqual(run["spring.stiffness"][-1], 0)

    def test_a_controller_reads_any_signal_until_it_has_decided(self):
        forces, kept = [], []

        def decide(sample):
            forces.append(sample["spring.force"])
            kept.append(sample)

        run = froude.run(scene_of(spring), controllers={"spring": decide})
        every = run.steps // (len(run.time) - 1)
        np.testing.assert_array_equal(forces[every - 1::every], run["spring.force"][1:])
        with self.assertRaisesRegex(froude.InputError, "after its controller had decided"):
            kept[0].time
        with self.assertRaisesRegex(froude.InputError, "did you mean \"spring.force\""):
            froude.run(scene_of(spring), controllers={"spring": lambda sample: sample["spring.forc"]})

    def test_a_controller_that_takes_energy_out_calms_a_swing(self):
        def decide(sample):
            return 8.0 if sample["m.surge"] * sample.velocity("m")[0] > 0 else 4.0

        run = froude.run(scene_of(spring), controllers={"spring": decide})
        self.assertLess(np.abs(run["m.surge"][run.time > 8]).max(), 0.03)  # halved twice a cycle in energy

    def test_errors_are_those_of_the_program(self):
        with self.assertRaisesRegex(froude.InputError, r"scene.toml:18:1: error: unknown key \"stifness\"(.|\n)*did you mean \"stiffness\"") as caught:
            scene_of(spring.replace("rest_length", "stifness"))
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaisesRegex(froude.InputError, "no axial connector"):
            froude.run(scene_of(spring), controllers={"rope": lambda sample: 1.0})
        with self.assertRaisesRegex(TypeError, "the controller of \"spring\" returned 'soft'; return a stiffness"):
            froude.run(scene_of(spring), controllers={"spring": lambda sample: "soft"})
        with self.assertRaisesRegex(froude.InputError, "does not ask for RAOs"):
            froude.rao(scene_of(spring))
        with self.assertRaises(KeyError):
            froude.run(scene_of(spring))["m.heavy"]

    def test_what_a_controller_raises_comes_out(self):
        def decide(sample):
            raise ZeroDivisionError("of the controller")

        with self.assertRaisesRegex(ZeroDivisionError, "of the controller"):
            froude.run(scene_of(spring), controllers={"spring": decide})

    def test_a_run_that_a_controller_ends_is_kept(self):
        def decide(sample):
            if sample.time > 4.99:
                raise ValueError("no idea")

        with self.assertRaisesRegex(ValueError, "no idea") as caught:
            froude.run(scene_of(spring), controllers={"spring": decide})
        run = caught.exception.run
        self.assertRegex(run.stopped, r'the controller of "spring" raised ValueError: no idea, at t = 5 s')
        plain = froude.run(scene_of(spring))
        np.testing.assert_array_equal(run["m.surge"], plain["m.surge"][:len(run.time)])
        self.assertAlmostEqual(run.time[-1], 4.95)
        ended = froude.run(scene_of(spring), controllers={"spring": lambda sample: float("nan")})
        self.assertIn("stiffness of nan N/m", ended.stopped)

    def test_a_controller_of_a_joint_is_the_power_take_off_that_it_computes(self):
        scene = scene_of(rack)
        own = froude.run(scene)

        def decide(sample):
            self.assertEqual((sample.joint, sample["rack.stroke"]), ("rack", sample.coordinate))
            self.assertEqual(sample.velocity("m")[0], sample.rate)
            return 8 * sample.coordinate + 0.8 * sample.rate, 8, 0.8

        run = froude.run(scene, controllers={"ra*": decide})
        self.assertEqual(run.stopped, "")
        # Both solve the same equations, by Newton to 1e-10 of the loads or better.
        np.testing.assert_allclose(run["rack.stroke"], own["rack.stroke"], rtol=0, atol=1e-10)
        np.testing.assert_allclose(run["rack.pto_force"], own["rack.pto_force"], rtol=0, atol=1e-9)
        self.assertLess(abs(run.energy["residual"]), 1e-3 * run.energy["turnover"])
        # It began at rest, and what the controller gives is all that moves; powers are summed by trapezia.
        self.assertAlmostEqual(run.energy["pto.controlled.supplied"], run.energy["kinetic"],
                               delta=1e-3 * run.energy["turnover"])

    def test_a_controller_of_a_joint_may_have_a_memory(self):
        integral = []

        def decide(sample):  # of the force that it set before
            integral.append(sample.coordinate)
            return 4 * sample.coordinate + 0.01 * sum(integral)

        run = froude.run(scene_of(rack), controllers={"rack": decide})
        self.assertEqual(len(integral), run.steps + 1)
        every = run.steps // (len(run.time) - 1)
        np.testing.assert_array_equal(integral[::every], run["rack.stroke"])
        # What acts at a sample is what was set there.
        expected = [4 * x + 0.01 * sum(integral[:i * every + 1]) for i, x in enumerate(run["rack.stroke"])]
        np.testing.assert_allclose(run["rack.pto_force"], expected, rtol=1e-12, atol=1e-12)

    def test_errors_of_controllers_of_joints(self):
        def run(controllers):
            return froude.run(scene_of(rack), controllers=controllers)

        with self.assertRaisesRegex(froude.InputError, 'no axial connector, slider or hinge is called "gear"'):
            run({"gear": lambda sample: 0.0})
        with self.assertRaisesRegex(TypeError, r"returned \(1, 2\); return a force, or force, stiffness and damping"):
            run({"rack": lambda sample: (1, 2)})
        with self.assertRaisesRegex(froude.InputError, "did you mean \"rack.stroke\"") as caught:
            run({"rack": lambda sample: sample["rack.strok"]})
        self.assertEqual(len(caught.exception.run.time), 1)
        kept = []
        run({"rack": kept.append})
        with self.assertRaisesRegex(froude.InputError, "after its controller had decided"):
            kept[0].rate
        both = rack.replace("[ask]", """[[connector]]
name = "racket"
between = ["m", "ground"]
ends = ["(0, 0, 0) m", "(-1, 0, 0) m"]
kind = "axial"
stiffness = "8 N/m"
rest_length = "as placed"
[ask]""")
        with self.assertRaisesRegex(froude.InputError, 'stands for connectors and for joints'):
            froude.run(scene_of(both), controllers={"rack*": lambda sample: 0.0})
        self.assertIn("force of inf", run({"rack": lambda sample: float("inf")}).stopped)

    def test_a_tuned_float_takes_what_theory_has(self):
        said = subprocess.run([sys.executable, str(examples / "reactive.py")], check=True, capture_output=True, text=True)
        brake, most, limited = said.stdout.splitlines()
        for line in (brake, most):
            run, theory = (float(word) for word in re.findall(r"([0-9.]+) W", line))
            self.assertAlmostEqual(run / theory, 1, delta=0.03)  # memory to 1e-2, and 0.1 W of what is printed
        best = float(re.search(r"([0-9.]+) W", most)[1])
        self.assertLess(float(re.search(r"([0-9.]+) W", limited)[1]), best)

    def test_the_example_runs(self):
        said = subprocess.run([sys.executable, str(examples / "control.py")], check=True, capture_output=True, text=True)
        for line in said.stdout.splitlines():
            stiff, soft, ruled = (float(word) for word in re.findall(r"([0-9.]+) m ", line + " "))
            self.assertLess(ruled, 0.65 * max(stiff, soft))  # a resonance is broken: seen 0.49 and 0.08
