#!/usr/bin/python3
"""Makes friction_1.csv to friction_4.csv: a torque that grows until a brake slips, with levels that are known, because they
are written here.

    make_friction.py           writes the files beside this script
    make_friction.py --check   fails if a file differs from what would be written

As Van Zanten (2020, 3.3.3) tests his hinge: the load on the arm is raised by hand, the torque falls when the brake slips and
stays, and at the end the load is taken off. Each test has levels of its own about the same means. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

STATIC, DYNAMIC, BETWEEN = 3.70, 3.00, 0.03  # N m; deviation from test to test
STEP, SLIDES, ENDS = 0.01, 3.0, 1.0  # s
NOISE, MEMORY = 0.04, 0.05  # N m, s
RATES = (0.9, 0.7, 1.1, 0.8)  # N m/s


def tests():
    source = random.Random(20201203)
    phi = math.exp(-STEP / MEMORY)
    for number, rate in enumerate(RATES, 1):
        static = STATIC + source.gauss(0, BETWEEN)
        dynamic = DYNAMIC + source.gauss(0, BETWEEN)
        rest = 0.5 + source.random()
        slips = rest + static / rate
        rows, noise = [], source.gauss(0, NOISE)
        for j in range(round((slips + SLIDES + ENDS) / STEP)):
            t = j * STEP
            torque = max(0.0, rate * (t - rest)) if t < slips else dynamic if t < slips + SLIDES else 0.0
            rows.append(f"{t:.2f},{torque + noise:.4f}")
            noise = phi * noise + math.sqrt(1 - phi**2) * source.gauss(0, NOISE)
        head = [
            "# A made measurement: the torque on a brake until it slips, written by make_friction.py.",
            f"# In truth {static:.3f} N m at rest and {dynamic:.3f} N m sliding; {STATIC} and {DYNAMIC} in the mean of all tests.",
            "t [s],M [N m]",
        ]
        yield Path(__file__).with_name(f"friction_{number}.csv"), "\n".join(head + rows) + "\n"


if __name__ == "__main__":
    write_or_check(tests())
