#!/usr/bin/python3
"""Makes a raw record of a forced oscillation as a tank gives it, with coefficients that are known, because they are
written here: tank_run.csv, tank_zero.csv, load_cell_1.csv and load_cell_2.csv.

    make_tank_run.py           writes the files beside this script
    make_tank_run.py --check   fails if a file differs from what would be written

The cylinder and the formula are those of make_oscillation.py. Twenty oscillations: three grow, fourteen are full, three
fall. Two load cells carry the body, in volts, the second one mounted the other way round; both have drifted since they
were calibrated, the structure vibrates at 8 Hz, and the force is recorded 0.12 s late. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

C_D, C_A = 2.4, 1.1
DIAMETER, LENGTH, DENSITY, MASS = 0.12, 0.5, 997.0, 5.9
AMPLITUDE, PERIOD = 0.30, 2.5
STEP, REST = 0.02, 2.5
SHARE, SLOPE, DRIFT = (0.52, -0.48), (0.0933, 0.0935), (0.31, -0.22)
DELAY = 0.12
FORCE_NOISE, FORCE_MEMORY = 0.8, 0.1  # N, s, in each cell
POSITION_STEP = 0.0005  # m


def ramp(cycle):
    """Share of the full amplitude: grows over three cycles, stands for fourteen, falls over three."""
    up, down = cycle / 3, (20 - cycle) / 3
    x = max(0.0, min(up, down, 1.0))
    return x * x * (3 - 2 * x)  # smooth


def position(t):
    cycle = (t - REST) / PERIOD
    return AMPLITUDE * ramp(cycle) * math.sin(2 * math.pi * cycle)


def force(t):
    """What the cells carry; derivatives of the position by differences far finer than the record."""
    h = 1e-4
    v = (position(t + h) - position(t - h)) / (2 * h)
    a = (position(t + h) - 2 * position(t) + position(t - h)) / (h * h)
    displaced = DENSITY * math.pi / 4 * DIAMETER**2 * LENGTH
    return -(C_A * displaced + MASS) * a - 0.5 * DENSITY * DIAMETER * LENGTH * C_D * abs(v) * v


def noise(source):
    """Noise with a memory, for ever."""
    phi = math.exp(-STEP / FORCE_MEMORY)
    e = source.gauss(0, FORCE_NOISE)
    while True:
        yield e
        e = phi * e + math.sqrt(1 - phi**2) * source.gauss(0, FORCE_NOISE)


def record(samples, moving, seed):
    source = random.Random(seed)
    noises = [noise(source), noise(source)]
    for j in range(samples):
        t = j * STEP
        x = position(t) if moving else 0.0
        load = force(t - DELAY) if moving else 0.0
        shake = 1.5 * math.sin(2 * math.pi * 8 * t + 0.4) if moving else 0.0
        volts = [
            DRIFT[i] + SLOPE[i] * (SHARE[i] * (load + shake) + next(noises[i])) for i in range(2)
        ]
        yield f"{t:.2f},{POSITION_STEP * round(x / POSITION_STEP):.4f},{volts[0]:.4f},{volts[1]:.4f}"


def run_text(what, samples, moving, seed):
    head = [
        f"# A made measurement, {what}, written by make_tank_run.py.",
        f"# In truth C_D = {C_D}, C_A = {C_A}, the force is {DELAY} s late, and the second cell is turned round.",
        "t [s],pos [m],V1 [V],V2 [V]",
    ]
    return "\n".join(head + list(record(samples, moving, seed))) + "\n"


def line_text(cell):
    source = random.Random(70 + cell)
    rows = [f"# Loads up and down, tension and compression: {SLOPE[cell]} V/N and 2 mV of scatter.",
            "cycle,force [N],voltage [V]"]
    for cycle, sign in ((1, 1), (2, -1)):
        for step in list(range(0, 9)) + list(range(7, -1, -1)):
            load = sign * 9.81 * step
            rows.append(f"{cycle},{load:.2f},{0.05 + SLOPE[cell] * load + source.gauss(0, 0.002):.4f}")
    return "\n".join(rows) + "\n"


def files():
    samples = round((2 * REST + 20 * PERIOD) / STEP) + 1
    return {
        "tank_run.csv": run_text("forced oscillation in still water", samples, True, 20230902),
        "tank_zero.csv": run_text("at rest", 1000, False, 20230903),
        "load_cell_1.csv": line_text(0),
        "load_cell_2.csv": line_text(1),
    }


if __name__ == "__main__":
    write_or_check((Path(__file__).with_name(name), text) for name, text in files().items())
