#!/usr/bin/python3
"""Makes runs in regular waves of a tank, of a body whose response is known, because it is written here:
waves_runs/run_1.csv to run_8.csv.

    make_waves_runs.py           writes the files
    make_waves_runs.py --check   fails if a file differs from what would be written

The wavemaker starts at 3 s and moves fully after 2 s. Energy goes to the gauge and the body at the group velocity and
comes back from a beach that returns a tenth of the height. The body heaves like a damped spring and mass and is held by
a cell that feels a force of second order beside that of the waves. Three of the runs repeat one period. Standard library
only.
"""
import cmath
import math
import random
from pathlib import Path

from made_files import write_or_check

PERIODS = (1.2, 1.4, 1.6, 1.6, 1.6, 1.9, 2.2, 2.6)  # s
AMPLITUDE, DEPTH, GRAVITY = 0.03, 1.25, 9.81  # m
GAUGE, BODY, END, BACK = 20.0, 23.0, 60.0, 0.1  # m
START, RAMP, STEP, LENGTH = 3.0, 2.0, 0.05, 110.0  # s
NATURAL, DAMPING = 1.5, 0.15  # s, of critical
FORCE, SECOND = 900.0, 0.08  # N/m, of the first
NOISE = (0.0008, 0.0008, 0.8)  # m, m, N


def wavenumber(omega):
    k = omega * omega / GRAVITY
    for _ in range(60):
        k = omega * omega / GRAVITY / math.tanh(k * DEPTH)
    return k


def rao(omega):
    """Heave over the wave at the body: the force of a long wave on a spring and mass."""
    r = omega * NATURAL / (2 * math.pi)
    return 1 / complex(1 - r * r, 2 * DAMPING * r)


def force(omega):
    return FORCE * cmath.exp(complex(0, 0.3 * omega))


def record(number):
    period = PERIODS[number]
    omega = 2 * math.pi / period
    k = wavenumber(omega)
    speed = omega / k / 2 * (1 + 2 * k * DEPTH / math.sinh(2 * k * DEPTH))
    source = random.Random(20230900 + number)
    heave, load = rao(omega), force(omega)

    def share(t, way):
        return max(0.0, min((t - START - way / speed) / RAMP, 1.0))

    def wave(t, x):
        back = 2 * END - x
        return AMPLITUDE * (share(t, x) * cmath.exp(1j * (omega * t - k * x))
                            + BACK * share(t, back) * cmath.exp(1j * (omega * t - k * back)))

    rows = [f"# A made measurement: regular waves of {period} s, written by make_waves_runs.py.",
            f"# In truth heave {abs(heave):.4f} m/m, force {abs(load):.1f} N/m.",
            "t [s],wave [m],heave [m],F [N]"]
    for j in range(round(LENGTH / STEP)):
        t = j * STEP
        body = wave(t, BODY)
        values = (wave(t, GAUGE).real, (heave * body).real,
                  (load * body).real + SECOND * FORCE * (body * body).real / AMPLITUDE)
        measured = [v + source.gauss(0, s) for v, s in zip(values, NOISE)]
        rows.append(f"{t:.2f},{measured[0]:.5f},{measured[1]:.5f},{measured[2]:.2f}")
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    write_or_check((Path(__file__).parent / "waves_runs" / f"run_{i + 1}.csv", record(i)) for i in range(len(PERIODS)))
