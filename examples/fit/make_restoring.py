#!/usr/bin/python3
"""Makes restoring_1.csv and restoring_2.csv: loads that were held on a moored float and where they brought it, with a
stiffness that is known, because it is written here.

    make_restoring.py           writes the files beside this script
    make_restoring.py --check   fails if a file differs from what would be written

Two pulls, each with its own zero of the load cell; the second goes to the other side. Standard library only.
"""
import random
from pathlib import Path

from made_files import write_or_check

STIFFNESS, CUBIC = 820.0, 450.0  # N/m, N/m^3
NOISE = 3.0  # N
PULLS = ((12.0, [0.05 * j for j in range(17)]), (-7.0, [-0.06 * j for j in range(15)]))  # N, m


def tests():
    source = random.Random(20240517)
    for number, (zero, places) in enumerate(PULLS, 1):
        head = [
            "# A made measurement: a float pulled aside, written by make_restoring.py.",
            f"# In truth {STIFFNESS} N/m and {CUBIC} N/m^3, the load cell's zero at {zero} N.",
            "x [m],F [N]",
        ]
        rows = [f"{x:.3f},{zero + STIFFNESS * x + CUBIC * x**3 + source.gauss(0, NOISE):.2f}" for x in places]
        yield Path(__file__).with_name(f"restoring_{number}.csv"), "\n".join(head + rows) + "\n"


if __name__ == "__main__":
    write_or_check(tests())
