#!/usr/bin/python3
"""Makes in_waves.csv: a cylinder moved to and fro while a wave passes, with coefficients that are known, because they are
written here.

    make_in_waves.py           writes in_waves.csv beside this script
    make_in_waves.py --check   fails if the file differs from what would be written

The cylinder is that of make_oscillation.py. Water and body move with frequencies of their own; u is measured where the body
is, x is the body's position. Load cells carry the body and 5.9 kg beyond them:

    F = rho V u' - m a + C_A rho V (u' - a) + 1/2 rho D L C_D |u - v| (u - v) + lift

Lift is a force of 1.1 Hz that the formula does not know. Python's standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

C_D, C_A = 1.4, 0.8
DIAMETER, LENGTH, DENSITY, MASS = 0.12, 0.5, 997.0, 5.9
BODY = (0.25, 4.1)  # m, s
WATER = (0.30, 2.9)  # m/s, s
LIFT, LIFT_HZ, LIFT_PHASE = 3.0, 1.1, 0.4  # N
STEP, SAMPLES = 0.025, 2400
FORCE_NOISE, FORCE_MEMORY = 1.0, 0.2  # N, s
POSITION_NOISE, VELOCITY_NOISE = 3e-4, 2e-3  # m, m/s


def rows():
    source = random.Random(20240118)
    body, water = 2 * math.pi / BODY[1], 2 * math.pi / WATER[1]
    displaced = DENSITY * math.pi / 4 * DIAMETER**2 * LENGTH
    phi = math.exp(-STEP / FORCE_MEMORY)
    noise = source.gauss(0, FORCE_NOISE)
    for j in range(SAMPLES):
        t = j * STEP
        x = BODY[0] * math.sin(body * t)
        v = BODY[0] * body * math.cos(body * t)
        a = -(body**2) * x
        u = WATER[0] * math.cos(water * t + 0.7)
        rate = -WATER[0] * water * math.sin(water * t + 0.7)
        force = displaced * rate - MASS * a + C_A * displaced * (rate - a)
        force += 0.5 * DENSITY * DIAMETER * LENGTH * C_D * abs(u - v) * (u - v)
        force += LIFT * math.cos(2 * math.pi * LIFT_HZ * t + LIFT_PHASE)
        measured = (x + source.gauss(0, POSITION_NOISE), u + source.gauss(0, VELOCITY_NOISE), force + noise)
        yield f"{t:.3f},{measured[0]:.5f},{measured[1]:.4f},{measured[2]:.3f}"
        noise = phi * noise + math.sqrt(1 - phi**2) * source.gauss(0, FORCE_NOISE)


def text():
    head = [
        "# A made measurement: a cylinder moved in a passing wave, written by make_in_waves.py.",
        f"# In truth C_D = {C_D}, C_A = {C_A}, and a lift of {LIFT} N at {LIFT_HZ} Hz.",
        "t [s],pos [m],u [m/s],F [N]",
    ]
    return "\n".join(head + list(rows())) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("in_waves.csv"), text())])
