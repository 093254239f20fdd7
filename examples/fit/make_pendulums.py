#!/usr/bin/python3
"""Makes pendulums.csv: angles of two hung links whose damping is known, because it is written here.

    make_pendulums.py           writes pendulums.csv beside this script
    make_pendulums.py --check   fails if the file differs from what would be written

Bobs of 0.1 kg at the ends of links of 0.5 m and 0.4 m without mass; each bob feels -b_l v - b_q |v| v. Angles are from
the horizontal, positive down. The lower bob is held at (0.6, 0, -0.2) m and let go. Lagrange's equations in the two
angles, by Runge-Kutta steps. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

LENGTHS, BOB, GRAVITY = (0.5, 0.4), 0.1, 9.81  # m, kg, m/s^2
LINEAR, QUADRATIC = 0.006, 0.004  # kg/s, kg/m
STEP, SAMPLES, SUBSTEPS, NOISE = 0.04, 300, 20, 0.01  # s; rad


def start(x=0.6, z=-0.2):
    a, b = LENGTHS
    distance = math.hypot(x, z)
    below = math.atan2(-z, x) + math.acos((a * a + distance**2 - b * b) / (2 * a * distance))
    return [below, math.atan2(-(z + a * math.sin(below)), x - a * math.cos(below)), 0.0, 0.0]


def rate(y):
    p, q, u, w = y
    a, b = LENGTHS
    # Velocities of both bobs, and how they change with the two rates.
    first = (-a * math.sin(p), -a * math.cos(p))
    second = (-b * math.sin(q), -b * math.cos(q))
    v1 = (first[0] * u, first[1] * u)
    v2 = (v1[0] + second[0] * w, v1[1] + second[1] * w)
    f1 = [-(LINEAR + QUADRATIC * math.hypot(*v1)) * v for v in v1]
    f2 = [-(LINEAR + QUADRATIC * math.hypot(*v2)) * v for v in v2]
    load_p = sum((f1[i] + f2[i]) * first[i] for i in (0, 1)) + 2 * BOB * GRAVITY * a * math.cos(p)
    load_q = sum(f2[i] * second[i] for i in (0, 1)) + BOB * GRAVITY * b * math.cos(q)
    c, s = BOB * a * b * math.cos(p - q), BOB * a * b * math.sin(p - q)
    right_p, right_q = load_p - s * w * w, load_q + s * u * u
    mass_p, mass_q = 2 * BOB * a * a, BOB * b * b
    determinant = mass_p * mass_q - c * c
    return [u, w, (right_p * mass_q - c * right_q) / determinant, (mass_p * right_q - c * right_p) / determinant]


def step(y, h):
    k1 = rate(y)
    k2 = rate([a + h / 2 * b for a, b in zip(y, k1)])
    k3 = rate([a + h / 2 * b for a, b in zip(y, k2)])
    k4 = rate([a + h * b for a, b in zip(y, k3)])
    return [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]


def text():
    source = random.Random(20240616)
    rows = ["# A made measurement: angles of two hung links from the horizontal, written by make_pendulums.py.",
            f"# In truth each bob has linear damping {LINEAR} kg/s and quadratic damping {QUADRATIC} kg/m.",
            "t [s],upper [rad],lower [rad]"]
    y = start()
    for j in range(SAMPLES):
        rows.append(f"{j * STEP:.2f},{y[0] + source.gauss(0, NOISE):.4f},{y[1] + source.gauss(0, NOISE):.4f}")
        for _ in range(SUBSTEPS):
            y = step(y, STEP / SUBSTEPS)
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("pendulums.csv"), text())])
