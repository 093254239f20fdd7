#!/usr/bin/python3
"""Makes radiation_1.csv to radiation_9.csv: forced heave at nine frequencies of a body whose memory is known, because it is
written here.

    make_radiation.py           writes the files beside this script
    make_radiation.py --check   fails if a file differs from what would be written

K(t) = k e^{-at} (cos bt - (a/b) sin bt) gives with w^2 = a^2 + b^2 and D = (w^2 - s^2)^2 + 4 a^2 s^2 at the frequency s

    B(s) = 2 a k s^2/D,   A(s) = A_inf + k (w^2 - s^2)/D

and load cells carry F = -(M + A) x'' - B x' - C x. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

MASS, STIFFNESS, A_INF = 120.0, 2500.0, 60.0  # kg, N/m, kg
STRENGTH, DECAY, TURN = 400.0, 1.2, 2.8  # N/m, 1/s, rad/s
FREQUENCIES = (1.0, 1.7, 2.3, 2.8, 3.3, 3.9, 4.8, 6.0, 8.0)  # rad/s
AMPLITUDE, PER_PERIOD, PERIODS = 0.05, 40, 10  # m
FORCE_NOISE, POSITION_NOISE = 0.3, 2e-5  # N, m


def added_mass_and_damping(s):
    w2 = DECAY**2 + TURN**2
    d = (w2 - s * s) ** 2 + 4 * DECAY**2 * s * s
    return A_INF + STRENGTH * (w2 - s * s) / d, 2 * DECAY * STRENGTH * s * s / d


def tests():
    source = random.Random(20230418)
    for number, s in enumerate(FREQUENCIES, 1):
        added, damping = added_mass_and_damping(s)
        step = round(2 * math.pi / s / PER_PERIOD, 3)
        rows = []
        for j in range(PER_PERIOD * PERIODS):
            t = j * step
            x = AMPLITUDE * math.sin(s * t)
            v = AMPLITUDE * s * math.cos(s * t)
            force = (MASS + added) * s * s * x - damping * v - STIFFNESS * x
            measured = (x + source.gauss(0, POSITION_NOISE), force + source.gauss(0, FORCE_NOISE))
            rows.append(f"{t:.3f},{measured[0]:.6f},{measured[1]:.3f}")
        head = [
            "# A made measurement: forced heave, written by make_radiation.py.",
            f"# In truth {s} rad/s, added mass {added:.3f} kg, damping {damping:.3f} N s/m.",
            "t [s],z [m],F [N]",
        ]
        yield Path(__file__).with_name(f"radiation_{number}.csv"), "\n".join(head + rows) + "\n"


if __name__ == "__main__":
    write_or_check(tests())
