#!/usr/bin/python3
"""Makes decay.csv: a roll decay with damping that is known, because it is written here.

    make_decay.py           writes decay.csv beside this script
    make_decay.py --check   fails if the file differs from what would be written

    x'' + b1 x' + b2 |x'| x' + w0^2 (x - x0) = 0, let go at 9 degrees; noise with a memory of 0.3 s. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

PERIOD, LINEAR, QUADRATIC, OFFSET = 6.4, 0.02, 0.6, 0.01  # s, 1/s, 1/rad, rad
STEP, SAMPLES, SUBSTEPS = 0.1, 900, 10
NOISE, MEMORY = 0.0015, 0.3  # rad, s


def rate(x, v):
    omega = 2 * math.pi / PERIOD
    return v, -LINEAR * v - QUADRATIC * abs(v) * v - omega**2 * (x - OFFSET)


def step(x, v, h):
    a1, b1 = rate(x, v)
    a2, b2 = rate(x + h / 2 * a1, v + h / 2 * b1)
    a3, b3 = rate(x + h / 2 * a2, v + h / 2 * b2)
    a4, b4 = rate(x + h * a3, v + h * b3)
    return x + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), v + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)


def text():
    source = random.Random(20230904)
    phi = math.exp(-STEP / MEMORY)
    rows = ["# A made measurement: a roll decay, written by make_decay.py.",
            f"# In truth the period is {PERIOD} s, linear damping {LINEAR} 1/s, quadratic damping {QUADRATIC} 1/rad.",
            "t [s],roll [rad]"]
    x, v, e = math.radians(9) + OFFSET, 0.0, source.gauss(0, NOISE)
    for j in range(SAMPLES):
        rows.append(f"{j * STEP:.1f},{x + e:.5f}")
        e = phi * e + math.sqrt(1 - phi**2) * source.gauss(0, NOISE)
        for _ in range(SUBSTEPS):
            x, v = step(x, v, STEP / SUBSTEPS)
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("decay.csv"), text())])
