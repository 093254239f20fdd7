#!/usr/bin/python3
"""Makes oscillation.csv: a forced oscillation with coefficients that are known, because they are written here.

    make_oscillation.py           writes oscillation.csv beside this script
    make_oscillation.py --check   fails if the file differs from what would be written

A cylinder (diameter 0.12 m, length 0.5 m) is moved to and fro in still water of 997 kg/m^3. Load cells carry it and
5.9 kg of mass beyond them:  F = -(C_A rho V + m) a - 1/2 rho D L C_D |v| v.  The force has noise with a memory of
0.2 s, as filtered measurements do; the position has white noise. Python's standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

C_D, C_A = 1.2, 1.0
DIAMETER, LENGTH, DENSITY, MASS = 0.12, 0.5, 997.0, 5.9
AMPLITUDE, PERIOD = 0.36, 4.35
STEP, SAMPLES = 0.02, 2400
FORCE_NOISE, FORCE_MEMORY = 1.5, 0.2  # N, s
POSITION_NOISE = 3e-4  # m


def rows():
    source = random.Random(20230901)
    omega = 2 * math.pi / PERIOD
    displaced = DENSITY * math.pi / 4 * DIAMETER**2 * LENGTH
    phi = math.exp(-STEP / FORCE_MEMORY)
    noise = source.gauss(0, FORCE_NOISE)
    for j in range(SAMPLES):
        t = j * STEP
        x = AMPLITUDE * math.sin(omega * t)
        v = AMPLITUDE * omega * math.cos(omega * t)
        a = -(omega**2) * x
        force = -(C_A * displaced + MASS) * a - 0.5 * DENSITY * DIAMETER * LENGTH * C_D * abs(v) * v
        yield f"{t:.2f},{x + source.gauss(0, POSITION_NOISE):.5f},{force + noise:.3f}"
        noise = phi * noise + math.sqrt(1 - phi**2) * source.gauss(0, FORCE_NOISE)


def text():
    head = [
        "# A made measurement: forced oscillation in still water, written by make_oscillation.py.",
        f"# In truth C_D = {C_D}, C_A = {C_A}; force noise {FORCE_NOISE} N with a memory of {FORCE_MEMORY} s, "
        f"position noise {POSITION_NOISE} m.",
        "t [s],pos [m],F [N]",
    ]
    return "\n".join(head + list(rows())) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("oscillation.csv"), text())])
