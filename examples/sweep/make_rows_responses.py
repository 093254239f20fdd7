#!/usr/bin/python3
"""Makes rows_responses.csv: the 507 cases of rows.toml as responses of every module, with drag that loses as much energy in waves
of that height as the quadratic one does.

    make_rows_responses.py FROUDE                writes the table beside this script
    make_rows_responses.py FROUDE COUNT SET      prints the rows of so many modules on one set of connectors, "5 S4"

FROUDE is the program. Standard library only.
"""
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
SETS = {"S1": "29332 N/m", "S2": "26258 N/m", "S3": "14898 N/m", "S4": "6390 N/m"}
HEAD = "modules,set,period [s],height [m],module,surge [m/m],heave [m/m],pitch [rad/m]"


def waves():
    """Periods and heights of rows.toml, as texts with their units."""
    axes = {axis["name"]: axis["values"] for axis in tomllib.loads((HERE / "rows.toml").read_text())["axis"]}
    return list(zip(axes["period"], axes["height"]))


def scene(count, stiffness, period, height):
    text = (HERE / "row.toml").read_text()
    changes = [('position = "(-6.5, 0, 0) m"', f'position = "({-6.5 * (count - 1)}, 0, 0) m"'), ("count = 2", f"count = {count}"),
               ('on = "m2"', f'on = "m{count}"'), ("(29332, 0, 0) N/m", f"({stiffness.split()[0]}, 0, 0) N/m"),
               ('periods = "5 s"', f'periods = "{period}"'), ("drag = { steepness = 0.0125 }", f'drag = {{ height = "{height}" }}')]
    if count == 1:  # both moorings are on the one module: a half each
        changes.append(('surge = "4280 N/m"', 'surge = "2140 N/m"'))
    for old, new in changes:
        if old not in text:
            sys.exit(f"row.toml has no longer {old}")
        text = text.replace(old, new)
    return text


def rows(froude, count, name):
    """The lines of the table of one row of modules on one set of connectors."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "row.toml"
        for period, height in waves():
            path.write_text(scene(count, SETS.get(name, SETS["S1"]), period, height))
            done = subprocess.run([froude, "rao", str(path), "-o", str(path.with_suffix(".h5")), "--json"], capture_output=True,
                                  text=True, check=True)
            signals = json.loads(done.stdout)["signals"]
            for i in range(1, count + 1):
                values = [signals[f"m{i}.{mode}"]["amplitude"][0] for mode in ("surge", "heave", "pitch")]
                yield ",".join([str(count), name, period.split()[0], height.split()[0], str(i), *(f"{v:.4g}" for v in values)])


def main():
    froude = sys.argv[1]
    if len(sys.argv) == 4:
        print("\n".join(rows(froude, int(sys.argv[2]), sys.argv[3])))
        return
    lines = ["# Responses of rows of modules (rows.toml), amplitude per amplitude of the waves; made by make_rows_responses.py.", HEAD]
    lines += rows(froude, 1, "none")
    for count in (2, 3, 5):
        for name in SETS:
            lines += rows(froude, count, name)
    (HERE / "rows_responses.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
