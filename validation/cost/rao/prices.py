#!/usr/bin/env python3
"""What responses of many bodies cost: the whole process `froude rao`, and numpy's batched solution beside it.

prices.py FROUDE FOLDER [MODULES…]: writes FOLDER/rao.md. Rows that feel each other's waves are taken as long as their
coefficients fit into the memory of the machine, see MEMORY.
"""
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from array_file import write_array

ROOT = Path(__file__).resolve().parents[3]
MEMORY = 4.5  # largest memory over that of the tables A and B of all frequencies: 3.2 at 100 modules, and the file itself
ROW = """schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[[body]]
name = "m"
position = "(0, 0, 0) m"
copies = {{ count = {count}, step = "(13, 0, 0) m" }}
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.hydrodynamics]
file = "{data}"
accept = ["Haskind relation"]
interaction = "{interaction}"
excitation = true
radiation = {{}}
hydrostatics = true
[[mooring]]
on = "m*"
kind = "linear"
stiffness = {{ surge = "428 N/m", sway = "1034 N/m", yaw = "15839 N m/rad" }}
{connectors}[ask]
rao = {{ omega = "{low} rad/s .. 3 rad/s, {frequencies} values", headings = "0 deg .. 90 deg, {headings} values" }}
"""
CONNECTORS = """[[connector]]
between = "neighbours of m"
ends = ["(6, ±5, 0.5) m", "(-6, ±5, 0.5) m"]
kind = "axial"
stiffness = "14666 N/m"
damping = "1 kN s/m"
rest_length = "as placed"
"""


def scene(count, interaction, frequencies=60, headings=12, data="examples/data/pontoon1.nc"):
    return ROW.format(count=count, data=data, interaction=interaction,
                      connectors=CONNECTORS if count > 1 else "", frequencies=frequencies, headings=headings,
                      low=1.0 if frequencies > 1 else 3.0)


def timed(froude, text, threads=None):
    """Wall and processor time, s, and the largest memory, MB, of one process."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "row.toml"
        path.write_text(text.replace('file = "examples/', f'file = "{ROOT}/examples/'))
        command = [froude, "rao", str(path), "-o", str(Path(folder) / "row.h5")]
        command += ["--threads", str(threads)] if threads else []
        environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", FROUDE_CACHE="off")
        begin = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=environment)
        error = process.stderr.read().decode()
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise SystemExit(f"froude rao failed:\n{error}")
        return time.perf_counter() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def coupled(froude, count, frequencies=60):
    """The same of a row whose modules all feel each other's waves."""
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "row_data.h5"
        write_array(data, count, np.linspace(1, 3, frequencies), ROOT / "examples/data/modules5.h5")
        # They begin at the lowest frequency that is asked for.
        text = scene(count, "full", frequencies, data=str(data))
        return timed(froude, text.replace('accept = ["', 'accept = ["low-frequency tail", "'))


def fits(count, frequencies=60):
    """True if A and B of all frequencies, with what is made of them, fit into the memory that is free."""
    tables = 2 * 8 * (6 * count) ** 2 * frequencies
    return MEMORY * tables < 1024 * int(next(l for l in open("/proc/meminfo") if l.startswith("MemAvailable")).split()[1])


def numpy_seconds(unknowns=30, frequencies=200, headings=36):
    """Least processor time of three of numpy's batched solutions, right-hand sides at hand."""
    random = np.random.default_rng(1)
    z = random.normal(size=(frequencies, unknowns, unknowns)) + 1j * random.normal(size=(frequencies, unknowns, unknowns))
    x = random.normal(size=(frequencies, unknowns, headings)) + 0j
    taken = []
    for _ in range(3):
        begin = time.process_time()
        np.linalg.solve(z, x)
        taken.append(time.process_time() - begin)
    return min(taken)


def thirty_motions(froude):
    """Least processor time of three, of 200 frequencies in 36 headings over that of one cell: reading falls out."""
    data = "examples/data/pontoon5.nc"
    many = min(timed(froude, scene(5, "full", 200, 36, data), 1)[1] for _ in range(3))
    one = min(timed(froude, scene(5, "full", 1, 1, data), 1)[1] for _ in range(3))
    return many, one


def main():
    froude, folder = os.path.abspath(sys.argv[1]), Path(sys.argv[2])
    counts = [int(a) for a in sys.argv[3:]] or [1, 5, 25, 100, 400, 1024]
    lines = []
    for count in counts:
        wall, processor, memory = timed(froude, scene(count, "self"))
        lines.append(f"| {count} | {wall:.3g} | {processor:.3g} | {memory:.0f} |")
        print(lines[-1], flush=True)
    together = []
    for count in counts:
        if not fits(count):
            together.append(f"| {count} | - | - | needs {MEMORY * 2 * 8 * (6 * count) ** 2 * 60 / 2**30:.0f} GB |")
            continue
        wall, processor, memory = coupled(froude, count)
        together.append(f"| {count} | {wall:.3g} | {processor:.3g} | {memory:.0f} |")
        print(together[-1], flush=True)
    many, one = thirty_motions(froude)
    peer = numpy_seconds()
    page = f"""# What responses of many bodies cost

Written by `validation/cost/rao/prices.py`: the whole process `froude rao`, with reading, all signals, and writing, at 60 frequencies and 12 headings, on {os.cpu_count()} processors of {platform.processor() or platform.machine()} beside other work.

A row of modules that connectors alone couple, each with the coefficients of one (sparse equations from nine on):

| modules | wall [s] | processor [s] | memory [MB] |
| --- | --- | --- | --- |
{os.linesep.join(lines)}

The same row where every module feels the waves of all others (dense equations), coefficients by the law of `validation/cost/rao/array_file.py` at the same 60 frequencies; reading and checking them is part of the time:

| modules | wall [s] | processor [s] | memory [MB] |
| --- | --- | --- | --- |
{os.linesep.join(together)}

Thirty motions of five modules that feel each other's waves, 200 frequencies, 36 headings, one thread, processor time: {1000 * many:.0f} ms the process, of which reading, preparing and starting take {1000 * one:.0f} ms (one frequency, one heading): {1000 * (many - one):.0f} ms for the
rest, writing among it. numpy's batched solution of as many equations alone, whose matrices and right-hand sides are at hand: {1000 * peer:.1f} ms.
What the equations and the rest take of it, as a profile has it: [validation/cost/rao](../../validation/cost/rao/README.md).
"""
    (folder / "rao.md").write_text(page)


if __name__ == "__main__":
    main()
