#!/usr/bin/python3
"""Makes swings/: four records of the two links of make_pendulums.py, let go at four places.

    make_swings.py           writes the folder swings beside this script
    make_swings.py --check   fails if a file differs from what would be written

The first two are even, at two rates; the third is uneven and begins 0.4 s before the links are let go; where they were
let go was noted in the first, the third and the fourth alone. Standard library only.
"""
import random
from pathlib import Path

from made_files import write_or_check
from make_pendulums import LINEAR, NOISE, QUADRATIC, start, step

INNER = 0.002  # s, of the integration
HELD = 0.4     # s, of the third record before the release


def record(name, place, times, held=0.0):
    source = random.Random(f"20241104 {name}")
    rows = [f"# A made measurement: angles of two hung links, let go {held} s after the first row at {place} m; by"
            " make_swings.py.",
            f"# In truth each bob has linear damping {LINEAR} kg/s and quadratic damping {QUADRATIC} kg/m.",
            "t [s],upper [rad],lower [rad]"]
    y, now = start(*place), 0.0
    for t in times:
        while now < t - held - 1e-9:
            inner = min(INNER, t - held - now)
            y, now = step(y, inner), now + inner
        rows.append(f"{t:.3f},{y[0] + source.gauss(0, NOISE):.4f},{y[1] + source.gauss(0, NOISE):.4f}")
    return Path(__file__).with_name("swings") / name, "\n".join(rows) + "\n"


def uneven(samples):
    source = random.Random("20241104 times")
    out = [0.0]
    while len(out) < samples:
        out.append(round(out[-1] + source.uniform(0.02, 0.06), 3))
    return out


if __name__ == "__main__":
    write_or_check([record("first.csv", (0.35, -0.75), [0.04 * j for j in range(200)]),
                    record("second.csv", (0.2, -0.8), [0.05 * j for j in range(160)]),
                    record("third.csv", (0.5, -0.6), uneven(200), HELD),
                    record("held_back.csv", (0.3, -0.7), [0.04 * j for j in range(200)])])
