#!/usr/bin/python3
"""Makes raw records of five tows as a tank gives them, with the means and the noise of Hendriksen (2023), table 6.1:
tow_1.csv to tow_5.csv.

    make_tows.py           writes the files beside this script
    make_tows.py --check   fails if a file differs from what would be written

Each record begins at rest, the carriage starts with 1 m/s^2, tows, stops and goes back slowly. Two load cells carry the
body, each with a zero of its own, and the force is against the motion. Below 4 Hz the force has noise of the deviation
that the table states; the structure vibrates above. A start of the wake dies out over a few seconds. Standard library
only.
"""
import math
import random
from pathlib import Path

from made_files import write_or_check

# Speed, its deviation, force, its deviation: m/s and N.
TABLE = ((0.843, 0.0012, 25.32, 0.24), (0.695, 0.0012, 17.33, 0.15), (0.545, 0.0012, 10.44, 0.12),
         (0.397, 0.0010, 5.53, 0.10), (0.248, 0.0010, 2.14, 0.07))
STEP, REST, TOW, ACCELERATION, MASS = 0.025, 8.0, 50.0, 1.0, 12.0  # s, s, s, m/s^2, kg
MEMORY = 0.25  # s, of the slow noise
VIBRATIONS = ((5.3, 0.3), (8.1, 0.8), (14.2, 0.4))  # Hz, N
ZEROS = (2.1, 1.9)  # N
WAKE, WAKE_S = 0.15, 1.5  # share of the force, s


def carriage(t, speed):
    """Speed and acceleration."""
    ramp = speed / ACCELERATION
    t -= REST
    if t < 0:
        return 0.0, 0.0
    if t < ramp:
        return ACCELERATION * t, ACCELERATION
    if t < ramp + TOW:
        return speed, 0.0
    if t < 2 * ramp + TOW:
        return speed - ACCELERATION * (t - ramp - TOW), -ACCELERATION
    return (0.1, 0.0) if t > 2 * ramp + TOW + 4 else (0.0, 0.0)


def record(number):
    speed, speed_noise, force, force_noise = TABLE[number]
    source = random.Random(20230600 + number)
    phi = math.exp(-STEP / MEMORY)
    slow = source.gauss(0, 1)
    begin = REST + speed / ACCELERATION
    rows = [f"# A made measurement: a tow at {speed} m/s, written by make_tows.py.",
            f"# In truth {force} N with a deviation of {force_noise} N below 4 Hz.",
            "t [s],U [m/s],F1 [N],F2 [N]"]
    for j in range(round((REST + TOW + 12) / STEP)):
        t = j * STEP
        u, a = carriage(t, speed)
        slow = phi * slow + math.sqrt(1 - phi * phi) * source.gauss(0, 1)
        wake = 1 + WAKE * math.exp(-(t - begin) / WAKE_S) if t > begin else 1.0
        total = force * (u / speed)**2 * wake + MASS * a
        if u > 0.5 * speed:
            total += force_noise * slow
        shake = sum(size * math.sin(2 * math.pi * hz * t + hz) for hz, size in VIBRATIONS) if u > 0 else 0.0
        measured = u + (source.gauss(0, speed_noise) if u > 0 else 0.0)
        cells = [ZEROS[i] - 0.5 * (total + shake) + source.gauss(0, 0.02) for i in range(2)]
        rows.append(f"{t:.3f},{measured:.4f},{cells[0]:.3f},{cells[1]:.3f}")
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check((Path(__file__).with_name(f"tow_{i + 1}.csv"), record(i)) for i in range(len(TABLE)))
