#!/usr/bin/python3
"""Makes the measurements of a laboratory of pendulums, with numbers that are known, because they are written here.

    make_pendulum_lab.py           writes the files beside this script
    make_pendulum_lab.py --check   fails if a file differs from what would be written

As Van Zanten (2020) has them, who prints the results and not the records: a free swing of the upper part of his long pendulum
(3.3.2), the nut that sets the torque of the brake (3.3.3), the weights that calibrate the torque meter (3.4), and two
potentiometers on one hinge, each with steps of its own (4.1, C.1). Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

GRAVITY = 9.81
# Mass kg, centre of gravity below the hinge m, inertia about it kg m^2, damping N m s/rad: his table 3.3.
PARTS = {"long": (24.92, 0.755, 3.07, 0.376), "medium": (24.92, 0.592, 1.84, 0.339), "short": (22.40, 0.348, 0.84, 0.169),
         "lower": (5.26, 0.107, 0.14, 0.036)}
NUT_SLOPE, NUT_OFFSET = 2.1252, 26.7652  # mm/(N m), mm: his equation 3.5
ARM, HYSTERESIS = 0.09, 0.176  # m, N m


def about_the_hinge(part):
    """Inertia about the hinge and stiffness of a small swing, kg m^2 and N m/rad: his equations 3.2 and 3.3."""
    mass, centre, inertia, _ = PARTS[part]
    return inertia + mass * centre ** 2, mass * GRAVITY * centre


def swing(part, first, samples, step, substeps=25):
    """Angles in rad of I x'' + c x' + k sin x = 0, his equation 3.4, let go at `first`."""
    inertia, stiffness = about_the_hinge(part)
    damping = PARTS[part][3]

    def rate(x, v):
        return v, -(damping * v + stiffness * math.sin(x)) / inertia

    x, v, h, out = first, 0.0, step / substeps, []
    for _ in range(samples):
        out.append(x)
        for _ in range(substeps):
            a1, b1 = rate(x, v)
            a2, b2 = rate(x + h / 2 * a1, v + h / 2 * b1)
            a3, b3 = rate(x + h / 2 * a2, v + h / 2 * b2)
            a4, b4 = rate(x + h * a3, v + h * b3)
            x, v = x + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), v + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
    return out


def free_swing(part, seed=20201218, step=0.05, samples=1200):
    """A minute from 12 degrees, with noise of 0.1 degrees that has a memory of 0.1 s."""
    source, phi, noise = random.Random(seed), math.exp(-step / 0.1), 0.0
    rows = ["# A made measurement: a free swing, written by make_pendulum_lab.py.",
            f"# In truth the damping is {PARTS[part][3]} N m s/rad.", "t [s],angle [deg]"]
    for j, x in enumerate(swing(part, math.radians(12), samples, step)):
        noise = phi * noise + math.sqrt(1 - phi ** 2) * source.gauss(0, 0.1)
        rows.append(f"{j * step:.2f},{math.degrees(x) + noise:.3f}")
    return "\n".join(rows) + "\n"


def nut(seed=20201219):
    """The mean sliding torque at each place of the nut; it is known to 0.1 N m."""
    source = random.Random(seed)
    rows = ["# A made measurement: torques of a brake, written by make_pendulum_lab.py.",
            f"# In truth the nut is at {NUT_SLOPE} mm/(N m) times the torque and {NUT_OFFSET} mm.", "torque [N m],place [mm]"]
    for torque in range(1, 12):
        rows.append(f"{torque},{NUT_SLOPE * (torque + source.gauss(0, 0.1)) + NUT_OFFSET:.2f}")
    return "\n".join(rows) + "\n"


def weights(seed=20201220):
    """Weights of 2 kg on an arm, put on and taken off: 0.5 V/(N m), and the torque that friction keeps back."""
    source = random.Random(seed)
    rows = ["# A made measurement: a torque meter under weights, written by make_pendulum_lab.py.",
            f"# In truth 0.5 V/(N m), and {HYSTERESIS} N m between the way up and the way down.", "torque [N m],reading [V]"]
    for count, side in [(n, -1) for n in range(7)] + [(n, 1) for n in range(5, -1, -1)]:
        torque = 2 * count * GRAVITY * ARM
        kept = 0 if count in (0, 6) else side * HYSTERESIS / 2
        rows.append(f"{torque:.4f},{0.5 * (torque + kept) + source.gauss(0, 0.002):.4f}")
    return "\n".join(rows) + "\n"


def two_potentiometers():
    """One angle as two potentiometers tell it, with steps of 0.10 and 0.38 degrees."""
    rows = ["# A made measurement: two potentiometers on one hinge, written by make_pendulum_lab.py.",
            "# In truth both tell one angle, in steps of 0.10 and 0.38 degrees.", "t [s],first [deg],second [deg]"]
    for j, x in enumerate(swing("long", math.radians(3), 1000, 0.01)):
        angle = math.degrees(x)
        rows.append(f"{j * 0.01:.2f},{0.10 * round(angle / 0.10):.2f},{0.38 * round(angle / 0.38):.2f}")
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    here = Path(__file__).parent
    write_or_check([(here / "free_swing.csv", free_swing("long")), (here / "nut.csv", nut()), (here / "weights.csv", weights()),
                    (here / "potentiometers.csv", two_potentiometers())])
