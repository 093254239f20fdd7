#!/usr/bin/python3
"""Makes float_left.csv and float_right.csv: five markers on a floating body whose motion is known, as two cameras see them that
stand 1.3 m apart and are not in step, with errors of 0.2 pixels. The clock of the right one is 0.3 s late.

    make_float.py [--check]
"""
import math
import random
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "fit"))
from made_files import write_or_check

# As float_scene.toml has them, m.
MARKERS = {"bow": (0.5, 0, 0.1), "stern": (-0.5, 0, 0.1), "port": (0, 0.25, 0.1), "starboard": (0, -0.25, 0.1),
           "mast": (0.1, 0, 0.5)}
# Both look along y: where they are along x and z, and how far before the plane y = 0, m.
CAMERAS = {"left": (-0.6, 0.0, 4.0), "right": (0.7, 0.05, 4.1)}
FOCAL, ERROR, LATE = 1500, 0.2, 0.3  # px, px, s


def motion(t):
    """Surge, sway, heave, m, roll, pitch and yaw, rad."""
    return (0.1 * math.sin(2 * t), 0.05 * math.sin(1.5 * t), 0.08 * math.cos(2.5 * t), 0.2 * math.sin(3 * t),
            0.15 * math.cos(2 * t), 0.1 * math.sin(t))


def place(marker, t):
    """Roll first, about x, then pitch about y, then yaw about z: the same as yaw first about axes that turn along."""
    surge, sway, heave, roll, pitch, yaw = motion(t)
    x, y, z = MARKERS[marker]
    y, z = y * math.cos(roll) - z * math.sin(roll), y * math.sin(roll) + z * math.cos(roll)
    x, z = x * math.cos(pitch) + z * math.sin(pitch), z * math.cos(pitch) - x * math.sin(pitch)
    x, y = x * math.cos(yaw) - y * math.sin(yaw), x * math.sin(yaw) + y * math.cos(yaw)
    return x + surge, y + sway, z + heave


def pixel(camera, at):
    (right, up, away), (x, y, z) = CAMERAS[camera], at
    return 640 + FOCAL * (x - right) / (away + y), 360 - FOCAL * (z - up) / (away + y)


def track(camera, noise):
    lines = ["t [s]," + ",".join(f"{m}_{c} [px]" for m in MARKERS for c in "xy")]
    for i in range(120):
        t = i / 30 if camera == "left" else i / 30 + 0.0071 + 0.002 * math.sin(i)
        pixels = [c + noise.gauss(0, ERROR) for m in MARKERS for c in pixel(camera, place(m, t))]
        lines.append(",".join([f"{t + (LATE if camera == 'right' else 0):.6f}"] + [f"{p:.3f}" for p in pixels]))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    errors = random.Random(9)
    write_or_check([(FOLDER / f"float_{camera}.csv", track(camera, errors)) for camera in CAMERAS])
