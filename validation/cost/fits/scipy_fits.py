#!/usr/bin/python3
"""The problems of cost_fits with SciPy: python3 scipy_fits.py"""
import time

import numpy as np
from scipy.integrate import odeint, solve_ivp
from scipy.optimize import curve_fit, least_squares, minimize_scalar

SAMPLES, FITS = 20000, 100


def best_of(work, repeats=3):
    best = 1e9
    for _ in range(repeats):
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
    return best


def noise(n, phi, sigma, rng):
    e = np.empty(n)
    e[0] = sigma * rng.standard_normal()
    for j in range(1, n):
        e[j] = phi * e[j - 1] + sigma * np.sqrt(1 - phi**2) * rng.standard_normal()
    return e


def record(samples, step, rng, cd=1.2):
    """Columns of drag and inertia, and the force, of water that swings about a held cylinder."""
    t = step * np.arange(samples)
    omega = 2 * np.pi / 4
    u, a = 0.4 * omega * np.cos(omega * t), -0.4 * omega**2 * np.sin(omega * t)
    columns = np.column_stack([0.5 * 997 * 0.06 * np.abs(u) * u, 997 * np.pi / 4 * 0.12**2 * 0.5 * a])
    return columns, columns @ [cd, 1.8] + noise(samples, 0.9, 3, rng)


def fitted(columns, force):
    """C_D and C_M by a search that is given the Jacobian, with the covariance."""
    return curve_fit(lambda _, cd, cm: columns[:, 0] * cd + columns[:, 1] * cm, columns[:, 0], force, p0=[1, 1],
                     jac=lambda *_: columns)


def campaign(rng):
    runs = [record(90000, 0.001, rng) for _ in range(33)]
    print(f"33 runs of 90000 samples           {best_of(lambda: [fitted(*r) for r in runs]):.4f}")


def global_fit(rng):
    kc = 5.0 + np.arange(100)
    runs = [record(2000, 0.04, rng, 1.2 - 0.3 * (np.log(k) - 4) + 0.05 * rng.standard_normal()) for k in kc]
    x = np.column_stack([np.ones(100), np.log(kc) - np.log(kc).mean()])
    found = {}

    def fit():
        estimates = [fitted(*r) for r in runs]
        y, own = np.array([e[0][0] for e in estimates]), np.array([e[1][0, 0] for e in estimates])

        def restricted(tau):  # minus twice the restricted log-likelihood
            w = 1 / (own + tau**2)
            xtwx = x.T @ (w[:, None] * x)
            c = np.linalg.solve(xtwx, x.T @ (w * y))
            found["law"] = c
            return np.sum(w * (y - x @ c) ** 2) - np.sum(np.log(w)) + np.log(np.linalg.det(xtwx))

        found["tau"] = minimize_scalar(restricted, bounds=(0, 1), method="bounded").x

    print(f"global fit over 100 runs           {best_of(fit):.4f} (slope {found['law'][1]:.3f}, between runs {found['tau']:.3f})")


def forces(rng):
    columns, force = record(SAMPLES, 0.004, rng)
    t = columns[:, 0]

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


def dropper(rng):
    """Two hinged links, as (F38) of docs/theory/fit.md has them, in four windows with a start each."""
    t = 0.002 * np.arange(250)

    def rate(y, _, p):
        alpha, beta, g1, g2, k1, k2 = p
        s, c = np.sin(y[0] - y[1]), np.cos(y[0] - y[1])
        f1 = -alpha * s * y[3] ** 2 + g1 * np.sin(y[0]) - k1 * y[2] - k2 * (y[2] - y[3])
        f2 = alpha * s * y[2] ** 2 + g2 * np.sin(y[1]) - k2 * (y[3] - y[2])
        d = beta - (alpha * c) ** 2
        return y[2], y[3], (beta * f1 - alpha * c * f2) / d, (f2 - alpha * c * f1) / d

    def motion(p, start):
        return odeint(rate, start, t, args=(p,), rtol=1e-7, atol=1e-9)[:, :2]

    truth = [0.5, 0.7, 60, 33, 0.05, 0.02]
    starts = [[2.6 - 0.4 * w, 3.5 - 0.3 * w, 1.0 * w, -1.0] for w in range(4)]
    data = [motion(truth, s) + 0.001 * rng.standard_normal((250, 2)) for s in starts]
    found = {}

    def residuals(z):
        return np.concatenate([(motion(z[:6], z[6 + 4 * w: 10 + 4 * w]) - data[w]).ravel() / 0.001 for w in range(4)])

    def fit():
        first = [0.45, 0.6, 58, 30, 0.06, 0.01] + [v + 0.01 for s in starts for v in s]
        found["x"] = least_squares(residuals, first, x_scale=np.maximum(np.abs(first), 0.01)).x

    print(f"dropper by shooting, odeint        {best_of(fit, 1):.4f} (coupling {found['x'][0]:.4f})")


if __name__ == "__main__":
    generator = np.random.default_rng(1)
    forces(generator)
    campaign(generator)
    global_fit(generator)
    motions(generator)
    dropper(generator)
