#!/usr/bin/python3
"""Makes film_track.txt and film_track_2.txt: tracks such as other programs write of films, of two hung links whose damping is known.

    make_film_track.py           writes both beside this script
    make_film_track.py --check   fails if a file differs from what would be written

The motion is that of make_pendulums.py. A telephone films it: some 25 frames a second, not quite even; the picture is
tilted; the pivot, the joint and the bob are followed with errors of parts of a pixel, and are lost in some frames. The
program writes a title, decimal commas and semicolons. The second film is that of another release, from elsewhere, less
sharp; the links still hang in the hand when it begins, and it was stopped for a while. Standard library only.
"""
import math
import random
from dataclasses import dataclass
from pathlib import Path

from made_files import write_or_check
from make_pendulums import LENGTHS, SAMPLES, STEP, start, step

JITTER, LOST = 0.006, 0.03  # s; share of the frames in which a marker is not found
SUBSTEPS = 40


@dataclass
class Film:
    file: str
    title: str
    seed: int
    release: tuple        # m, where the bob is held
    held: float           # s, from the first frame to the release
    stopped: tuple        # s, from one time to another
    pixels: float         # per metre
    tilt: float           # deg, of the camera, anticlockwise
    pivot: tuple          # px, where the links hang
    noise: float          # px

    def pixel(self, place):
        tilt = math.radians(self.tilt)
        right = math.cos(tilt) * place[0] + math.sin(tilt) * place[1]
        up = -math.sin(tilt) * place[0] + math.cos(tilt) * place[1]
        return self.pivot[0] + self.pixels * right, self.pivot[1] - self.pixels * up

    def text(self):
        source = random.Random(self.seed)
        rows = [self.title, "t;pivot_x;pivot_y;joint_x;joint_y;bob_x;bob_y"]
        y, now = start(*self.release), self.held
        for j in range(SAMPLES):
            at = STEP * j + (source.uniform(-JITTER, JITTER) if j else 0)
            if at > now:
                for _ in range(SUBSTEPS):
                    y = step(y, (at - now) / SUBSTEPS)
                now = at
            cells = [number(at, 4)]
            for place in places(y):
                x, z = (c + source.gauss(0, self.noise) for c in self.pixel(place))
                lost = source.random() < LOST and j
                cells += ["NaN", "NaN"] if lost else [number(x, 2), number(z, 2)]
            if not self.stopped[0] < at < self.stopped[1]:
                rows.append(";".join(cells))
        return "\n".join(rows) + "\n"


FILMS = [Film("film_track.txt", "two hung links, film 3", 20240617, (0.6, -0.2), 0, (0, 0), 1000, 2, (640, 120), 0.4),
         Film("film_track_2.txt", "two hung links, film 4", 20240618, (0.5, -0.6), 0.6, (5, 6.2), 800, -1.5, (610, 90), 0.8)]


def places(y):
    joint = (LENGTHS[0] * math.cos(y[0]), -LENGTHS[0] * math.sin(y[0]))
    return [(0, 0), joint, (joint[0] + LENGTHS[1] * math.cos(y[1]), joint[1] - LENGTHS[1] * math.sin(y[1]))]


def number(value, digits):
    return f"{value:.{digits}f}".replace(".", ",")


if __name__ == "__main__":
    write_or_check([(Path(__file__).with_name(film.file), film.text()) for film in FILMS])
