#!/usr/bin/env python3
"""What a periodic motion costs by harmonic balance and by stepping, at equal error.

prices.py FROUDE FOLDER: writes FOLDER/periodic.md. Both programs answer the same equations, those of examples/buoy.toml
in one regular wave, radiation by the same poles; errors are those of the standard deviations of two signals, against a
harmonic balance that is a thousand times as accurate, which the finest run is held against.
"""
import csv
import json
import math
import os
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PERIOD, HEIGHT = 6.2, 1.0  # s, m: a motion that lasts, whose disturbances lose a thirtieth a period
SIGNALS = ("pivot.angle", "rack.stroke")
KEPT = 8  # last periods of a run, of which deviations are taken
STEPS = (0.1, 0.05, 0.025)  # s
REPEATS = 2  # least time of so many
PERIODS, HEIGHTS = 40, 20  # cells of the map
RUN_PERIODS, RUN_HEIGHTS = 8, 5  # of its range that are run: a twentieth of the cells
TOLERANCES = (1e-2, 5e-4)  # of the memory: that of the scene, and that of the runs


def scene(ask, accuracy):
    text = (ROOT / "examples/buoy.toml").read_text()
    text = re.sub(r'(?m)^(stability|run|accuracy) = .*\n', "", text)
    text = re.sub(r'(?m)^height = .*$', f'height = "{HEIGHT} m"', text, count=1)
    text = re.sub(r'(?m)^period = .*$', f'period = "{PERIOD} s"', text, count=1)
    text = text.replace("radiation = { memory_tolerance", 'radiation = { method = "poles", memory_tolerance')
    return text + f"{ask}\naccuracy = {accuracy}\n"


def balance_scene(accuracy):
    names = ", ".join(f'"{s}"' for s in SIGNALS)
    return scene(f'stability = {{ periods = "{PERIOD} s .. {PERIOD} s, 1 values", heights = "{HEIGHT} m .. {HEIGHT} m, 1 values", of = [{names}] }}', accuracy)


def run_scene(duration, step):
    names = ", ".join(f'"{s}"' for s in SIGNALS)
    ask = f'run = {{ duration = "{duration:.6g} s", every = "{PERIOD / 62:.6g} s", of = [{names}] }}'
    return scene(ask, 2e-2) + f'[solve]\nstep = "{step} s"\n'


def process(froude, command, text):
    """Processor time of the whole process, s, what it tells as JSON, and the table that it writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(text)
        table = Path(folder) / "table.csv"
        environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", FROUDE_CACHE="off")
        child = subprocess.Popen([froude, command, str(path), "--json", "-o", str(Path(folder) / "result.h5"),
                                  "--csv", str(table)],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        told = child.stdout.read().decode()
        error = child.stderr.read().decode()
        _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            raise SystemExit(f"froude {command} failed:\n{error}")
        return usage.ru_utime + usage.ru_stime, json.loads(told), table.read_text()


def rows_of(text):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    head, *rows = csv.reader(lines)
    names = [re.sub(r" \[.*\]$", "", name) for name in head]
    return [dict(zip(names, map(float, row))) for row in rows]


def by_balance(froude, accuracy):
    """Deviations, largest multiplier, and least time of the process and of what is within it, s."""
    taken = [process(froude, "stability", balance_scene(accuracy)) for _ in range(REPEATS)]
    cell = rows_of(taken[0][2])[0]
    return ([cell[s] for s in SIGNALS], cell["multiplier"], min(t[0] for t in taken),
            min(t[1]["processor_s"] for t in taken))


def deviations(rows):
    """Over the last whole periods, by equal samples of which one period has 62."""
    last = rows[-62 * KEPT:]
    out = []
    for signal in SIGNALS:
        values = [row[signal] for row in last]
        mean = sum(values) / len(values)
        out.append(math.sqrt(sum((v - mean) ** 2 for v in values) / len(values)))
    return out


def by_steps(froude, duration, step):
    """Deviations, and time of the process and of what is beyond that of a single period, s."""
    taken = [process(froude, "run", run_scene(duration, step)) for _ in range(REPEATS)]
    start = min(process(froude, "run", run_scene(PERIOD, step))[0] for _ in range(REPEATS))
    whole = min(t[0] for t in taken)
    return deviations(rows_of(taken[0][2])), whole, whole - start


def by_map(froude, tolerance):
    """Least time of the process that maps all cells, s."""
    text = scene(f'stability = {{ periods = "6 s .. 9.9 s, {PERIODS} values", heights = "0.2 m .. 4 m, {HEIGHTS} values", '
                 f'of = ["pivot.angle", "rack.stroke"] }}', 2e-2)
    text = text.replace("memory_tolerance = 1e-2", f"memory_tolerance = {tolerance}")
    return min(process(froude, "stability", text)[0] for _ in range(REPEATS))


def by_study(froude):
    """Time of the process that runs a part of the cells of examples/sweep/tongue.toml, s a cell."""
    study = (ROOT / "examples/sweep/tongue.toml").read_text()
    study = study[:study.index("[[picture]]")].replace('"../buoy.toml"', f'"{ROOT}/examples/buoy.toml"')
    study = study.replace("9.9 s, 40 values", f"9.9 s, {RUN_PERIODS} values")
    study = study.replace("4 m, 20 values", f"4 m, {RUN_HEIGHTS} values")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "study.toml"
        path.write_text(study)
        child = subprocess.Popen([froude, "sweep", str(path), "-o", str(Path(folder) / "runs")], stdout=subprocess.DEVNULL,
                                 env=dict(os.environ, OPENBLAS_NUM_THREADS="1", FROUDE_CACHE="off"))
        _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            raise SystemExit("froude sweep failed")
        return (usage.ru_utime + usage.ru_stime) / (RUN_PERIODS * RUN_HEIGHTS)


def map_rows(froude):
    """A row of runs, and one of the map for each tolerance of the memory."""
    cells = PERIODS * HEIGHTS
    maps = [by_map(froude, tolerance) for tolerance in TOLERANCES]
    a_run = by_study(froude)
    rows = [f"| runs of 600 s | {TOLERANCES[-1]:g} | {1000 * a_run:.0f} | {cells * a_run:.0f} | 1 |"]
    for tolerance, taken in zip(TOLERANCES, maps):
        rows.append(f"| map | {tolerance:g} | {1000 * taken / cells:.1f} | {taken:.2f} | 1/{cells * a_run / taken:.0f} |")
    return rows


def error_of(values, reference):
    return max(abs(v / r - 1) for v, r in zip(values, reference))


def main():
    froude, folder = os.path.abspath(sys.argv[1]), Path(sys.argv[2])
    reference = by_balance(froude, 2e-5)[0]
    values, multiplier, whole, within = by_balance(froude, 2e-2)
    error = error_of(values, reference)
    rows = [f"| harmonic balance | {error:.1g} | {1000 * whole:.0f} | {1000 * within:.0f} | 1 | 1 |"]
    print(rows[0], flush=True)
    def lasting(error):
        """Whole periods, s, after which a tenth of the error is left of the start: the ramp of 30 s, decay, those kept."""
        return PERIOD * math.ceil(30 / PERIOD + math.log(error / 10) / math.log(multiplier) + KEPT)

    duration = lasting(max(error, 1e-6))
    equal = None
    for step in STEPS:
        found, run, steps = by_steps(froude, duration, step)
        off, whole_start = error_of(found, reference), run - steps
        rows.append(f"| steps of {1000 * step:g} ms, {duration:.0f} s | {off:.1g} | {1000 * run:.0f} | "
                    f"{1000 * steps:.0f} | {run / whole:.0f} | {steps / within:.0f} |")
        print(rows[-1], flush=True)
        if off <= max(error, 1e-5):
            equal = (run / whole, steps / within)
            break
    verdict = (f"At equal error, or 1e-5, stepping takes {equal[0]:.0f} times as long as harmonic balance, the process with its "
               f"start, and {equal[1]:.0f} times without it." if equal else
               f"No run came to the error of harmonic balance, nor to 1e-5. At {off:.1g}, the least that was tried, stepping takes "
               f"{run / whole:.0f} times as long, the process with its start, and {steps / within:.0f} times without it: "
               f"at equal error it takes more. For its own error a run of {lasting(off):.0f} s would do, which takes "
               f"{(whole_start + lasting(off) / duration * steps) / whole:.0f} and {lasting(off) / duration * steps / within:.0f} times as long.")
    maps = map_rows(froude)
    print(os.linesep.join(maps), flush=True)
    page = f"""# What a periodic motion costs

Written by `validation/cost/periodic/prices.py` on {os.cpu_count()} processors of {platform.processor() or platform.machine()} beside other work: [the buoy](../../examples/buoy.toml) in one
regular wave of {PERIOD} s and {HEIGHT:g} m, by `froude stability` of one cell, its Floquet multipliers and Mathieu's boundary
included, and by `froude run` until what the start has left is a tenth of the error, {multiplier:.3f} of it a period, with the
same poles of the radiation memory. The error is that of the standard deviations of pivot and rack over a period, the larger of
both. Processor time, one thread, least of {REPEATS}: the process with reading, coefficients and writing, and what is left without
that (of a run: without its first period).

| by | error | process [ms] | within [ms] | process, times | within, times |
| --- | --- | --- | --- | --- | --- |
{os.linesep.join(rows)}

{verdict}

A whole map, {PERIODS} periods × {HEIGHTS} heights, by `froude stability`, and the same cells by the runs of [tongue.toml](../../examples/sweep/tongue.toml) with
those that tell their error, of which {RUN_PERIODS} × {RUN_HEIGHTS} evenly over the map were run. Processor time of the whole processes, in the same run of
this program; the memory is that of `memory_tolerance`, of which a finer one has more states.

| by | memory | a cell [ms] | all cells [s] | of runs |
| --- | --- | --- | --- | --- |
{os.linesep.join(maps)}
"""
    (folder / "periodic.md").write_text(page)


if __name__ == "__main__":
    main()
