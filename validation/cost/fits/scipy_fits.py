#!/usr/bin/python3
"""The problems of cost_fits with SciPy: python3 scipy_fits.py"""
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import curve_fit, least_squares

SAMPLES, FITS = 20000, 100


def best_of(work, repeats=3):
    best = 1e9
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - start)
    return best


def noise(n, phi, sigma, rng):
    e = np.empty(n)
    e[0] = sigma * rng.standard_normal()
    for j in range(1, n):
        e[j] = phi * e[j - 1] + sigma * np.sqrt(1 - phi**2) * rng.standard_normal()
    return e


def forces(rng):
    t = 0.004 * np.arange(SAMPLES)
    omega = 2 * np.pi / 4
    u, a = 0.4 * omega * np.cos(omega * t), -0.4 * omega**2 * np.sin(omega * t)
    volume = np.pi / 4 * 0.12**2 * 0.5
    columns = np.column_stack([0.5 * 997 * 0.06 * np.abs(u) * u, 997 * volume * a])
    force = columns @ [1.2, 1.8] + noise(SAMPLES, 0.9, 3, rng)

    def model(_, cd, cm):
        return columns[:, 0] * cd + columns[:, 1] * cm

    def linear():
        for _ in range(FITS):
            np.linalg.lstsq(columns, force, rcond=None)

    def curve():
        for _ in range(FITS):
            curve_fit(model, t, force, p0=[1, 1])

    def robust():
        for _ in range(FITS):
            least_squares(lambda x: (columns @ x - force) / 3, [1, 1], jac=lambda x: columns / 3, loss="huber")

    print(f"{FITS} fits of {SAMPLES} samples, s")
    print(f"numpy lstsq                        {best_of(linear):.4f}")
    print(f"curve_fit                          {best_of(curve):.4f}")
    print(f"least_squares, Huber, Jacobian     {best_of(robust):.4f}")


def motions(rng):
    t = 0.1 * np.arange(900)

    def motion(p):
        omega, b1, b2, x0, x, v = p
        s = solve_ivp(lambda _, y: (y[1], -b1 * y[1] - b2 * abs(y[1]) * y[1] - omega**2 * (y[0] - x0)), (0, t[-1]), [x, v],
                      t_eval=t, rtol=1e-6, atol=1e-9)
        return s.y[0]

    data = motion([0.98, 0.02, 0.6, 0, 0.15, 0]) + noise(900, 0.7, 0.001, rng)
    found = {}

    def fit():
        found["x"] = least_squares(lambda p: motion(p) - data, [1.0, 0.03, 0.5, 0.0, 0.14, 0.0], x_scale=[1, 0.01, 0.1, 0.1, 0.1, 0.1]).x

    print(f"one decay of 900 samples, solve_ivp {best_of(fit, 1):.4f} (quadratic damping {found['x'][2]:.4f})")


if __name__ == "__main__":
    generator = np.random.default_rng(1)
    forces(generator)
    motions(generator)
