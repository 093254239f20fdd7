#!/usr/bin/env python3
"""What whole runs of the examples cost: from the start of the program to its end, and where the time goes.

prices.py FROUDE FOLDER [BASELINES]: writes FOLDER/whole.md. BASELINES is a program that is called with the name
cummins-rk4-5-100 and prints a JSON object whose "median_s" is the time of 100 s of five modules with their memory by
another code; without it there is no such row.
"""
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SHARES = ("reading", "preparing", "stepping", "estimating", "answering", "writing")
PAGE = """# What whole runs cost

Written by `validation/cost/whole/prices.py` on {processors} processors of {machine}, nothing else beside it: `froude run` of each
example that asks for a run, seconds from the start of the program to its end. *First* is without anything kept
(`FROUDE_CACHE=off`), *again* with what the first has kept. *Estimating* is what the runs beside the run take, which
[tell the error](../guide/scenes.md) of the step, of the memory, of pieces and segments: they take the second processor, and begin with
the run. A scene that gives no accuracy a way to be estimated, or stops early, has none. *Answering* is what a scene
without anything that bends takes instead of stepping: transfer functions times the spectrum of its sea.

| scene | simulated [s] | first [s] | again [s] | {shares} | simulated over again |
| --- | --- | --- | --- | {dashes} | --- |
{rows}

Shares are those of the second time.
{peer}
"""
PEER = """
## Five modules beside a loop by hand

The same five modules with their memory as a sum over the past, by numpy (Runge-Kutta of fourth order, steps of
0.01 s), take {numpy:.0f} s for 100 s, hence {whole:.0f} s for the {simulated:.0f} s of `examples/pontoon5.toml`, in the same hour on the same
machine: {first:.0f} times as long as the first run here, and {again:.0f} times the second, estimates of the error included.
"""


def asks_for_run(path):
    with open(path, "rb") as file:
        return "run" in tomllib.load(file).get("ask", {})


def timed(froude, scene, kept, folder):
    """Seconds of the whole process, and what the program says they went into."""
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", FROUDE_CACHE="on" if kept else "off",
                       XDG_CACHE_HOME=folder)
    begin = time.perf_counter()
    done = subprocess.run([froude, "run", str(scene), "-o", str(Path(folder) / "run.h5")], capture_output=True,
                          text=True, env=environment)
    whole = time.perf_counter() - begin
    if done.returncode != 0:
        raise SystemExit(f"froude run {scene} failed:\n{done.stderr}")
    line = re.search(r"^time: .*$", done.stdout + done.stderr, re.MULTILINE)
    shares = {name: 0.0 for name in SHARES}
    for name, seconds in re.findall(r"(\w+) ([\d.e+-]+)(?:,|$)", line.group().split(" s: ", 1)[1] if line else ""):
        shares[name] = float(seconds)
    return whole, shares


def simulated(scene):
    with open(scene, "rb") as file:
        run = tomllib.load(file)["ask"]["run"]
    value, unit = run["duration"].split()
    return float(value) * {"s": 1, "min": 60, "h": 3600}[unit]


def row(froude, scene):
    with tempfile.TemporaryDirectory() as folder:
        first, _ = timed(froude, scene, False, folder)
        timed(froude, scene, True, folder)
        again, shares = timed(froude, scene, True, folder)
    length = simulated(scene)
    numbers = " | ".join(f"{shares[name]:.2g}" for name in SHARES)
    line = (f"| [{scene.stem}](../../examples/{scene.name}) | {length:g} | {first:.2g} | {again:.2g} | {numbers} | "
            f"{length / again:.2g} |")
    print(line, flush=True)
    return line, first, again


def peer_page(baselines, first, again):
    case = subprocess.run([sys.executable, baselines, "cummins-rk4-5-100", "--repeat", "1"], capture_output=True,
                          text=True, check=True, env=dict(os.environ, OPENBLAS_NUM_THREADS="1"))
    numpy = json.loads(case.stdout)["median_s"]
    length = simulated(ROOT / "examples" / "pontoon5.toml")
    whole = numpy * length / 100
    return PEER.format(numpy=numpy, whole=whole, simulated=length, first=whole / first, again=whole / again)


def main():
    froude, folder = sys.argv[1], Path(sys.argv[2])
    scenes = [path for path in sorted((ROOT / "examples").glob("*.toml")) if asks_for_run(path)]
    rows = {scene.stem: row(froude, scene) for scene in scenes}
    peer = peer_page(sys.argv[3], *rows["pontoon5"][1:]) if len(sys.argv) > 3 else ""
    page = PAGE.format(processors=os.cpu_count(), machine=platform.machine(), shares=" | ".join(SHARES),
                       dashes=" | ".join("---" for _ in SHARES), rows="\n".join(line for line, *_ in rows.values()),
                       peer=peer)
    (folder / "whole.md").write_text(page)


if __name__ == "__main__":
    main()
