#!/usr/bin/python3
"""Makes steps.csv: a swing that dies out, by a potentiometer of few levels.

    make_steps.py           writes steps.csv beside this script
    make_steps.py --check   fails if the file differs from what would be written

    angle = 4 deg exp(-0.06 t) sin(2 pi t/1.7 + 0.3), to the nearest of levels 0.3 degrees apart. Standard library only.
"""
import math
from pathlib import Path

from made_files import write_or_check

LEVEL, STEP, SAMPLES = 0.3, 0.01, 2000  # deg, s


def angle(t):
    return 4 * math.exp(-0.06 * t) * math.sin(2 * math.pi * t / 1.7 + 0.3)


def text():
    rows = ["# A made measurement: a swing by a coarse potentiometer, written by make_steps.py.", "t [s],angle [deg]"]
    rows += [f"{j * STEP:.2f},{LEVEL * round(angle(j * STEP) / LEVEL) + 0.0:.1f}" for j in range(SAMPLES)]
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("steps.csv"), text())])
