#!/usr/bin/python3
"""Makes a campaign of forced oscillations with a drag that falls with KC, because it is written here: batch/runs.csv and
batch/run_1.csv …

    make_batch.py           writes the files below this script
    make_batch.py --check   fails if a file differs from what would be written

    C_D = 2.5 - 0.8 ln(KC/15), and from run to run +-0.08; C_A = 1. The formula of the force is that of
    make_oscillation.py. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

DIAMETER, LENGTH, DENSITY, MASS, C_A = 0.12, 0.5, 997.0, 5.9, 1.0
RUNS = ((0.18, 2.7), (0.24, 4.1), (0.30, 3.6), (0.36, 4.4), (0.42, 3.1), (0.48, 4.8), (0.54, 4.0))  # m, s
STEP, SAMPLES = 0.025, 1200
NOISE, MEMORY = 1.0, 0.2  # N, s


def run_text(number, amplitude, period, cd):
    source = random.Random(5000 + number)
    omega, phi = 2 * math.pi / period, math.exp(-STEP / MEMORY)
    displaced = DENSITY * math.pi / 4 * DIAMETER**2 * LENGTH
    rows = [f"# Run {number} of a made campaign, written by make_batch.py. In truth C_D = {cd:.3f}, C_A = {C_A}.",
            "t [s],pos [m],F [N]"]
    noise = source.gauss(0, NOISE)
    for j in range(SAMPLES):
        t = j * STEP
        x, v = amplitude * math.sin(omega * t), amplitude * omega * math.cos(omega * t)
        force = (C_A * displaced + MASS) * omega**2 * x - 0.5 * DENSITY * DIAMETER * LENGTH * cd * abs(v) * v
        rows.append(f"{t:.3f},{x + source.gauss(0, 3e-4):.5f},{force + noise:.3f}")
        noise = phi * noise + math.sqrt(1 - phi**2) * source.gauss(0, NOISE)
    return "\n".join(rows) + "\n"


def files():
    source = random.Random(20230905)
    out = {}
    table = ["file,amplitude [m],period [s],day"]
    for number, (amplitude, period) in enumerate(RUNS, 1):
        kc = 2 * math.pi * amplitude / DIAMETER
        cd = 2.5 - 0.8 * math.log(kc / 15) + source.gauss(0, 0.08)
        out[f"run_{number}.csv"] = run_text(number, amplitude, period, cd)
        table.append(f"run_{number}.csv,{amplitude},{period},{'Monday' if number < 4 else 'Tuesday'}")
    out["runs.csv"] = "\n".join(table) + "\n"
    return out


if __name__ == "__main__":
    write_or_check((Path(__file__).with_name("batch") / name, text) for name, text in files().items())
