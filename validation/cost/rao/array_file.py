"""Coefficients of rows of modules that feel each other's waves, in Froude's own format: as large as those of a panel
code, made by a law in place of a solution.

Each module has the added mass A1 and damping B1 of the middle one of examples/data/modules5.h5, straight between its
frequencies. Between modules i and j,
R apart, B = B1 sin(kR)/(kR), which is positive semidefinite with any number of modules, since sin(kR)/(kR) is the mean
of plane waves over all directions; A = B1 cos(kR)/(kR)/omega, its other half. Excitation turns its phase with the
module's place. Only time and memory are looked at, not the responses.
"""
from pathlib import Path

import h5py
import numpy as np

SPACING = 13.0  # m, as the scene has it


def wavenumbers(omega, depth, gravity):
    """k of omega² = g k tanh kh, by Newton."""
    k = omega**2 / gravity
    for _ in range(50):
        t = np.tanh(k * depth)
        k -= (gravity * k * t - omega**2) / (gravity * (t + k * depth * (1 - t**2)))
    return k


def psd(matrix):
    values, vectors = np.linalg.eigh((matrix + matrix.T) / 2)
    return (vectors * np.maximum(values, 0)) @ vectors.T


def write_array(path, count, omega, source):
    """Row of `count` modules at the frequencies `omega`, rad/s; memory as much as one frequency."""
    with h5py.File(source) as one, h5py.File(path, "w") as out:
        n, middle = 6 * count, slice(12, 18)
        x = SPACING * np.arange(count)
        distance = np.abs(x[:, None] - x[None, :])
        np.fill_diagonal(distance, 1)
        for key, value in one.attrs.items():
            out.attrs[key] = value
        for name in ("density", "gravity", "water_depth", "source"):
            out[name] = one[name][()]
        g, depth = one["gravity"][()], one["water_depth"][()]
        for name, values in (("omega", omega), ("heading", one["heading"][()]), ("load_mode", np.arange(n) + 1.0),
                             ("motion_mode", np.arange(n) + 1.0), ("body", np.arange(count) + 1.0), ("axis", np.arange(3) + 1.0)):
            out[name] = values
        out["body_name"] = [f"m{i + 1}" for i in range(count)]
        out["displaced_volume"] = np.full(count, one["displaced_volume"][2])
        for name in ("reference_point", "centre_of_gravity", "centre_of_buoyancy"):
            point = np.repeat(one[name][2:3], count, axis=0)
            point[:, 0] += x - 2 * SPACING
            out[name] = point
        out["restoring"] = np.kron(np.eye(count), one["restoring"][middle, middle])
        out["added_mass_infinite"] = np.kron(np.eye(count), one["added_mass_infinite"][middle, middle])
        A = out.create_dataset("added_mass", (len(omega), n, n), dtype="f8")
        B = out.create_dataset("radiation_damping", (len(omega), n, n), dtype="f8")
        X = {part: out.create_dataset(f"excitation_{part}", (3, n, len(omega)), dtype="f8") for part in ("re", "im")}
        table = one["omega"][()]
        for i, (w, k) in enumerate(zip(omega, wavenumbers(omega, depth, g))):
            at = min(int(np.searchsorted(table, w, side="right")) - 1, len(table) - 2)
            s = (w - table[at]) / (table[at + 1] - table[at])
            A1, B1 = ((1 - s) * one[name][at, middle, middle] + s * one[name][at + 1, middle, middle]
                      for name in ("added_mass", "radiation_damping"))
            B1 = psd(B1)
            near, far = np.sin(k * distance) / (k * distance), np.cos(k * distance) / (k * distance)
            np.fill_diagonal(near, 1)
            np.fill_diagonal(far, 0)
            A[i] = np.kron(np.eye(count), (A1 + A1.T) / 2) + np.kron(far, B1 / w)
            B[i] = np.kron(near, B1)
            for h, beta in enumerate(one["heading"][()]):
                pair = one["excitation_re"][h, middle, at:at + 2] + 1j * one["excitation_im"][h, middle, at:at + 2]
                load = pair @ [1 - s, s]
                load = np.kron(np.exp(-1j * k * (x - 2 * SPACING) * np.cos(beta)), load)
                X["re"][h, :, i], X["im"][h, :, i] = load.real, load.imag


if __name__ == "__main__":
    import sys
    root = Path(__file__).resolve().parents[3]
    write_array(sys.argv[1], int(sys.argv[2]), np.linspace(1, 3, int(sys.argv[3])), root / "examples/data/modules5.h5")
