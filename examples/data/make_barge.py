#!/usr/bin/python3
"""Makes the mesh of a barge whose ends and bottom are flat planes, for `examples/hull.toml`.

    make_barge.py           writes barge.obj beside this script
    make_barge.py --check   fails if that differs from what would be written

Panels follow the still water, none crosses the keel, and both sides are cut alike, so that half of them are solved.
Standard library only.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "fit"))
from made_files import write_or_check

LENGTH, BREADTH, DRAUGHT, FREEBOARD = 24.0, 9.0, 1.6, 1.4  # m
STERN, BOW = 3.0, 5.0  # m of its length over which the bottom rises to the still water
BILGE = 1.2  # m under water, outboard of the keel
ABOUT = 1.15  # m: size of a panel


def spaced(low, high):
    """From low to high by about the size of a panel."""
    count = max(1, round((high - low) / ABOUT))
    return [low + (high - low) * i / count for i in range(count + 1)]


def stations():
    aft, fore = -LENGTH / 2 + STERN, LENGTH / 2 - BOW
    return spaced(-LENGTH / 2, aft)[:-1] + spaced(aft, fore) + spaced(fore, LENGTH / 2)[1:]


def section(x):
    """From keel to still water on the port side; its points coincide where the ends come up."""
    sunk = min(1.0, (LENGTH / 2 + x) / STERN, (LENGTH / 2 - x) / BOW)
    bottom = [(x, y, -sunk * (DRAUGHT + (BILGE - DRAUGHT) * 2 * y / BREADTH)) for y in spaced(0, BREADTH / 2)]
    return bottom + [(x, BREADTH / 2, -sunk * BILGE * part) for part in (0.5, 0.0)]


def port_faces():
    """Quadrilaterals, anticlockwise seen from the water."""
    cuts = [section(x) for x in stations()]
    for a, b in zip(cuts, cuts[1:]):
        yield from ((a[j], a[j + 1], b[j + 1], b[j]) for j in range(len(a) - 1))
        low, high = a[-1], b[-1]
        top = [(x, BREADTH / 2, FREEBOARD) for x in (low[0], high[0])]
        yield low, top[0], top[1], high
        yield top[0], (low[0], 0.0, FREEBOARD), (high[0], 0.0, FREEBOARD), top[1]
    for cut, outside in ((cuts[0], -1), (cuts[-1], 1)):
        edge = [p for i, p in enumerate(cut) if i == 0 or p[1] > cut[i - 1][1]]
        top = [(edge[0][0], y, FREEBOARD) for y in (BREADTH / 2, 0.0)]
        face = (top[1], *edge, top[0])  # cut from its first corner, which sees all others
        yield (face[0], *face[1:][::outside])


def mirrored(face):
    return [(x, -y, z) for x, y, z in (face[0], *face[:0:-1])]  # from the same corner, the other way round


def obj():
    numbers, faces = {}, []
    for port in port_faces():
        for face in (list(port), mirrored(port)):
            corners = []
            for x, y, z in face:
                number = numbers.setdefault((round(x, 4), round(y, 4) + 0.0, round(z, 4) + 0.0), len(numbers) + 1)
                if number not in corners:
                    corners.append(number)
            if len(corners) > 2:
                faces.append("f " + " ".join(map(str, corners)))
    head = [f"# A barge of {LENGTH:g} m x {BREADTH:g} m, drawn at a draught of {DRAUGHT:g} m by make_barge.py; x forward, y port, z up."]
    return "\n".join(head + [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in numbers] + faces) + "\n"


if __name__ == "__main__":
    write_or_check([(Path(__file__).parent / "barge.obj", obj())])
