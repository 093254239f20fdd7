#!/usr/bin/python3
"""Makes the raw channels of a day at a tank, with coefficients that are known, because they are written here.

    make_tank_day.py           writes the files beside this script
    make_tank_day.py --check   fails if a file differs from what would be written

A cylinder hangs across the carriage on two load cells. It is towed at three speeds and swung once; then a float takes
its place, with a potentiometer for its heave, in waves that a gauge tells in volts. Standard library only.
"""
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "fit"))
from made_files import write_or_check

DIAMETER, LENGTH, DENSITY, MASS = 0.12, 0.5, 997.0, 5.9
TOWED_CD, SWUNG_CD, SWUNG_CA = 1.18, 2.3, 1.1
CELLS = ((0.0933, 0.31), (0.0935, -0.22))  # V/N, V at rest that day
GAUGE, POTENTIOMETER, POTENTIOMETER_STEP = (25.0, 5.0), (12.0, 2.5), 0.01  # V/m and V; V
HEAVE, LATE = 1.4, 0.5  # m/m, rad
DEPTH, AT_GAUGE, AT_BODY, END = 1.25, 20.0, 23.0, 60.0


class Noise:
    """Gaussian, with a memory that it forgets by 1/e."""

    def __init__(self, source, size, step, memory):
        self.source, self.size, self.phi = source, size, math.exp(-step / memory)
        self.value = source.gauss(0, size)

    def next(self):
        self.value = self.phi * self.value + math.sqrt(1 - self.phi**2) * self.source.gauss(0, self.size)
        return self.value


def volts(cell, force):
    slope, zero = CELLS[cell]
    return f"{zero + slope * force / 2:.4f}"


def cell_line(cell):
    source = random.Random(600 + cell)
    rows = ["cycle,force [N],voltage [V]"]
    for cycle, sign in ((1, 1), (2, -1)):
        for step in list(range(0, 9)) + list(range(7, -1, -1)):
            load = sign * 4.905 * step
            rows.append(f"{cycle},{load:.3f},{0.05 + CELLS[cell][0] * load + source.gauss(0, 0.002):.4f}")
    return rows


def gauge_line():
    source = random.Random(610)
    rows = ["t [min],level [mm],reading [V]"]
    for i, level in enumerate(list(range(-80, 81, 20)) + list(range(60, -81, -20))):
        rows.append(f"{i},{level},{GAUGE[1] + GAUGE[0] * level / 1000 + 2e-3 * i + source.gauss(0, 0.004):.4f}")
    return rows


def potentiometer_line():
    source, rows = random.Random(611), ["height [mm],reading [V]"]
    for height in list(range(-80, 81, 16)) + list(range(64, -81, -16)):
        reading = POTENTIOMETER[1] + POTENTIOMETER[0] * height / 1000 + source.gauss(0, 0.004)
        rows.append(f"{height},{POTENTIOMETER_STEP * round(reading / POTENTIOMETER_STEP):.2f}")
    return rows


def zero():
    source = random.Random(620)
    return ["t [s],V1 [V],V2 [V]"] + [
        f"{0.04 * j:.2f},{volts(0, source.gauss(0, 0.3))},{volts(1, source.gauss(0, 0.3))}" for j in range(500)]


def tow(speed, seed):
    """Against the motion: the cells see what the water does."""
    source, step = random.Random(630 + seed), 0.04
    force = 0.5 * DENSITY * DIAMETER * LENGTH * TOWED_CD * speed**2
    slow = Noise(source, 0.01 * force + 0.05, step, 0.25)
    rows = ["t [s],U [m/s],V1 [V],V2 [V]"]
    for j in range(round(65 / step)):
        t = j * step - 6
        u = min(max(0.0, min(t, 50 + 2 * speed - t)), speed)
        a = (1.0 if t < speed else -1.0) if 0 < u < speed else 0.0
        wake = 1 + 0.15 * math.exp(-(t - speed) / 1.5) if t > speed else 1.0
        load = -force * (u / speed)**2 * wake - 12 * a - (slow.next() if u > 0 else 0.0)
        load += 0.8 * math.sin(2 * math.pi * 8 * t) if u > 0 else 0.0
        rows.append(f"{j * step:.2f},{u + (source.gauss(0, 0.001) if u > 0 else 0.0):.4f},"
                    f"{volts(0, load + source.gauss(0, 0.1))},{volts(1, load + source.gauss(0, 0.1))}")
    return rows


def swing():
    source, step, amplitude, period = random.Random(640), 0.04, 0.3, 2.5
    omega, slow = 2 * math.pi / period, Noise(source, 0.8, step, 0.1)
    displaced = DENSITY * math.pi / 4 * DIAMETER**2 * LENGTH
    rows = ["t [s],pos [m],V1 [V],V2 [V]"]
    for j in range(round(50 / step)):
        t = j * step
        x, v = amplitude * math.sin(omega * t), amplitude * omega * math.cos(omega * t)
        load = (SWUNG_CA * displaced + MASS) * omega**2 * x
        load += -0.5 * DENSITY * DIAMETER * LENGTH * SWUNG_CD * abs(v) * v + slow.next()
        load += 1.2 * math.sin(2 * math.pi * 8 * t)
        rows.append(f"{t:.2f},{x + source.gauss(0, 2e-4):.5f},{volts(0, load)},{volts(1, load)}")
    return rows


def waves(period, seed):
    source, step, omega = random.Random(650 + seed), 0.05, 2 * math.pi / period
    k = omega**2 / 9.81
    for _ in range(60):
        k = omega**2 / 9.81 / math.tanh(k * DEPTH)
    speed = omega / k / 2 * (1 + 2 * k * DEPTH / math.sinh(2 * k * DEPTH))

    def wave(t, x, late=0.0):
        total = 0.0
        for way, size in ((x, 0.03), (2 * END - x, 0.003)):
            total += size * max(0.0, min((t - 3 - way / speed) / 2, 1.0)) * math.cos(omega * t - k * way - late)
        return total

    rows = ["t [s],gauge [V],float [V]"]
    for j in range(round(85 / step)):
        t = j * step
        level = wave(t, AT_GAUGE) + source.gauss(0, 5e-4)
        reading = POTENTIOMETER[1] + POTENTIOMETER[0] * HEAVE * wave(t, AT_BODY, LATE) + source.gauss(0, 0.006)
        rows.append(f"{t:.2f},{GAUGE[1] + GAUGE[0] * level:.3f},"
                    f"{POTENTIOMETER_STEP * round(reading / POTENTIOMETER_STEP):.2f}")
    return rows


def gain(frequency):
    """What the float does of irregular waves: m/m and the phase by which it is late, rad."""
    ratio = frequency / 0.9
    return 1 / math.hypot(1 - ratio**2, 0.5 * ratio), math.atan2(0.5 * ratio, 1 - ratio**2)


def sea(seed, height):
    """Amplitude, frequency and phase of the waves of a run: a JONSWAP-like hump about 0.65 Hz."""
    source, out = random.Random(660 + seed), []
    for i in range(160):
        f = 0.3 + 0.006 * (i + source.random())
        density = f**-5 * math.exp(-1.25 * (0.65 / f)**4)
        out.append([math.sqrt(density), f, source.uniform(0, 2 * math.pi)])
    scale = height / 4 / math.sqrt(sum(a * a / 2 for a, _, _ in out))
    return [(a * scale, f, p) for a, f, p in out]


def irregular(seed):
    """Gauge and float beside each other, abreast of the waves."""
    source, step, waves_of_run = random.Random(670 + seed), 0.08, sea(seed, 0.06)
    answer = [(a * gain(f)[0], f, p - gain(f)[1]) for a, f, p in waves_of_run]
    rows = ["t [s],gauge [V],float [V]"]
    for j in range(round(160 / step)):
        level, height = (sum(a * math.cos(2 * math.pi * f * j * step + p) for a, f, p in of)
                         for of in (waves_of_run, answer))
        reading = POTENTIOMETER[1] + POTENTIOMETER[0] * (height + source.gauss(0, 2e-3)) + source.gauss(0, 0.006)
        rows.append(f"{j * step:.2f},{GAUGE[1] + GAUGE[0] * (level + source.gauss(0, 5e-4)):.3f},"
                    f"{POTENTIOMETER_STEP * round(reading / POTENTIOMETER_STEP):.2f}")
    return rows


LATE_FILM = 3.418  # s: the film's clock is ahead of the potentiometer's by this


def filmed():
    """The float let go, by its potentiometer and, at other instants, by a tracked marker in pixels."""
    source = random.Random(680)

    def height(t):
        since = max(0.0, t - 2)
        return 0.06 * math.exp(-0.35 * since) * math.cos(2 * math.pi * 0.9 * since)

    own = [f"{0.02 * j:.2f},{POTENTIOMETER[1] + POTENTIOMETER[0] * height(0.02 * j) + source.gauss(0, 0.01):.3f}"
           for j in range(750)]
    film = [f"{0.04 * j:.2f},{512 - 2400 * height(0.04 * j - LATE_FILM) + source.gauss(0, 1.5):.2f}"
            for j in range(400)]
    return ["t [s],float [V]"] + own, ["t [s],y"] + film


def files():
    out = {"cell_1.csv": cell_line(0), "cell_2.csv": cell_line(1), "gauge.csv": gauge_line(),
           "potentiometer.csv": potentiometer_line(), "zero.csv": zero(), "swing.csv": swing()}
    for i, speed in enumerate((0.4, 0.6, 0.8), 1):
        out[f"tow_{i}.csv"] = tow(speed, i)
    for i in (1, 2, 3):
        out[f"waves_{i}.csv"] = waves(1.6, i)
        out[f"sea_{i}.csv"] = irregular(i)
    out["let_go.csv"], out["let_go_film.csv"] = filmed()
    return out


if __name__ == "__main__":
    first = "# A made measurement, written by make_tank_day.py.\n"
    write_or_check((Path(__file__).with_name(name), first + "\n".join(rows) + "\n") for name, rows in files().items())
