#!/usr/bin/python3
"""Makes gauge_record.csv: the surface at a gauge 12 m before the origin, in deep water, of four waves that are known.

    make_gauge_record.py           writes gauge_record.csv beside this script
    make_gauge_record.py --check   fails if the file differs from what would be written

k = omega^2/g. Standard library only.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "fit"))
from made_files import write_or_check

GRAVITY, GAUGE, LENGTH, STEP = 9.81, -12.0, 60.0, 0.1  # m/s^2, m, s, s
WAVES = ((7, 0.3, 0.4), (10, 0.5, -2.1), (13, 0.2, 1.7), (21, 0.06, 3.0))  # multiples of 2 pi/60 s, m, rad at the origin


def surface(t):
    out = 0.0
    for n, a, phase in WAVES:
        omega = 2 * math.pi * n / LENGTH
        out += a * math.cos(omega * t - omega**2 / GRAVITY * GAUGE + phase)
    return out


def text():
    rows = ["# A made measurement: the surface 12 m before the origin, by make_gauge_record.py.", "time [s],elevation [m]"]
    rows += [f"{STEP * i:.1f},{surface(STEP * i):.5f}" for i in range(round(LENGTH / STEP))]
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("gauge_record.csv"), text())])
