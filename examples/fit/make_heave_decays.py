#!/usr/bin/python3
"""Makes heave_decays/run_1.csv to run_3.csv: a buoy let go from rest in calm water, in water whose memory is known, because it
is written here.

    make_heave_decays.py           writes the files beside this script
    make_heave_decays.py --check   fails if a file differs from what would be written

The body and the water are those of make_radiation.py: (M + A) x'' + integral of k(t - s) x'(s) ds + C (x - x0) = 0 with
k = 400 exp(-1.2 t) (cos 2.8 t - 1.2/2.8 sin 2.8 t), which is the force 400 y' of a hidden oscillator y'' + 2.4 y' + (1.2^2 + 2.8^2) y = x'.
Noise of the sensor with a memory of 0.1 s. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

MASS, LIMIT, STIFFNESS = 120.0, 60.0, 2500.0  # kg, kg, N/m
STRENGTH, DECAY, TURN = 400.0, 1.2, 2.8  # N/m, 1/s, rad/s
STEP, SAMPLES, SUBSTEPS = 0.05, 300, 10
NOISE, MEMORY = 0.0004, 0.1  # m, s
RUNS = ((0.12, 0.004), (0.09, -0.002), (-0.11, 0.001))  # let go at, rest position; m


def rate(y, rest):
    x, v, hidden, its_rate = y
    return (v, -(STIFFNESS * (x - rest) + STRENGTH * its_rate) / (MASS + LIMIT), its_rate,
            v - 2 * DECAY * its_rate - (DECAY**2 + TURN**2) * hidden)


def step(y, h, rest):
    def moved(k, share):
        return [a + share * h * b for a, b in zip(y, k)]

    k1 = rate(y, rest)
    k2 = rate(moved(k1, 0.5), rest)
    k3 = rate(moved(k2, 0.5), rest)
    k4 = rate(moved(k3, 1), rest)
    return [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]


def files():
    source = random.Random(20240611)
    phi = math.exp(-STEP / MEMORY)
    folder = Path(__file__).with_name("heave_decays")
    table = ["file,let_go_at [m],rest [m]"]
    for number, (height, rest) in enumerate(RUNS, 1):
        rows = ["# A made measurement: a buoy let go from rest in calm water, written by make_heave_decays.py.",
                "t [s],z [m]"]
        y, e = [height + rest, 0.0, 0.0, 0.0], source.gauss(0, NOISE)
        for j in range(SAMPLES):
            rows.append(f"{j * STEP:.2f},{y[0] + e:.5f}")
            e = phi * e + math.sqrt(1 - phi**2) * source.gauss(0, NOISE)
            for _ in range(SUBSTEPS):
                y = step(y, STEP / SUBSTEPS, rest)
        table.append(f"run_{number}.csv,{height},{rest}")
        yield folder / f"run_{number}.csv", "\n".join(rows) + "\n"
    yield folder / "runs.csv", "\n".join(table) + "\n"


if __name__ == "__main__":
    write_or_check(files())
