#!/usr/bin/python3
"""Makes film_track.txt: a track such as other programs write of a film, of two hung links whose damping is known.

    make_film_track.py           writes film_track.txt beside this script
    make_film_track.py --check   fails if the file differs from what would be written

The motion is that of make_pendulums.py. A telephone films it: some 25 frames a second, not quite even; 1000 pixels a
metre, the picture tilted by two degrees; the pivot, the joint and the bob are followed with errors of 0.4 pixels, and
are lost in some frames. The program writes a title, decimal commas and semicolons. Standard library only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check
from make_pendulums import LENGTHS, SAMPLES, STEP, start, step

PIXELS, TILT, PIVOT = 1000, math.radians(2), (640, 120)  # per metre; of the camera, anticlockwise; where the links hang
NOISE, JITTER, LOST = 0.4, 0.006, 0.03  # px; s; share of the frames in which a marker is not found
SUBSTEPS = 40


def places(y):
    joint = (LENGTHS[0] * math.cos(y[0]), -LENGTHS[0] * math.sin(y[0]))
    return [(0, 0), joint, (joint[0] + LENGTHS[1] * math.cos(y[1]), joint[1] - LENGTHS[1] * math.sin(y[1]))]


def pixel(place):
    right = math.cos(TILT) * place[0] + math.sin(TILT) * place[1]
    up = -math.sin(TILT) * place[0] + math.cos(TILT) * place[1]
    return PIVOT[0] + PIXELS * right, PIVOT[1] - PIXELS * up


def number(value, digits):
    return f"{value:.{digits}f}".replace(".", ",")


def text():
    source = random.Random(20240617)
    rows = ["two hung links, film 3", "t;pivot_x;pivot_y;joint_x;joint_y;bob_x;bob_y"]
    y, now = start(), 0.0
    for j in range(SAMPLES):
        at = STEP * j + (source.uniform(-JITTER, JITTER) if j else 0)
        for _ in range(SUBSTEPS):
            y = step(y, (at - now) / SUBSTEPS)
        now = at
        cells = [number(at, 4)]
        for place in places(y):
            x, z = (c + source.gauss(0, NOISE) for c in pixel(place))
            lost = source.random() < LOST and j
            cells += ["NaN", "NaN"] if lost else [number(x, 2), number(z, 2)]
        rows.append(";".join(cells))
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name("film_track.txt"), text())])
