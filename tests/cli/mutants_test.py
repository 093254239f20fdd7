#!/usr/bin/python3
"""Scenes and data that were good, with something changed: each is answered, or refused with a place.

    mutants_test.py FROUDE SOURCE [--count 500] [--first 0] [--keep FOLDER]

Mutant number n is the same on every machine: its changes are drawn by a generator that begins at n. A mutant fails the
test by a signal, by exit status 4 (a fault of froude), by a refusal that names neither file nor option, by NaN or
infinity in a table that it wrote with exit status 0, or by time: beyond `limit_s` for what says nothing of time, and
beyond what `froude plan` told for a run. With --keep the failing ones are written into FOLDER.
"""
import argparse
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# Plan and readers answer in 0.05 s, and HDF5 that does not end is left after 2 s of processor time: what takes ten times
# that hangs, whatever else the machine does.
LIMIT_S = 20.0
# A plan's time is an estimate on a machine that others use, and a run takes up to 64 times as many steps where its accuracy
# asks for them: sixty times it, and what starting takes.
FACTOR, START_S = 60.0, 5.0
# What a plan tells to take longer is not run: the suite is to end.
LONGEST_TOLD_S = 1.0
# Of address space; a mutant that asks for more must be refused before it is taken.
MEMORY_BYTES = 4 << 30

WATER = ["--density", "1000 kg/m^3", "--gravity", "9.81 m/s^2", "--depth", "infinite"]
NUMBERS = ["0", "-1", "1", "1e-9", "1e9", "2e9", "1e-320", "1e200", "1e-29", "1e29", "1e308", "nan", "inf", "-inf", "1e400",
           "2147483648", "-2147483649", "9223372036854775808", "0.5", "1000", "1e5", "1e-3", "", "-0.0", "1,5", "0x10"]
UNITS = ["m", "s", "kg", "deg", "Hz", "rad/s", "N/m", "kN s/m", "t", "m^2", "1", "%", "", "m^-9", "parsec"]
WORDS = ["true", "false", "\"\"", "[]", "{}", "\"infinite\"", "\"x\"", "[1, 2]", "1979-05-27", "\"m.heave\"", "\"..\"", "\"/dev/null\""]

SCENE = """\
schema = 1
title = "One module in a regular wave"
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "14 m"
[waves]
kind = "regular"
amplitude = "0.1 m"
period = "5 s"
heading = "0 deg"
[[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = { accept_error = 0.02 }
hydrostatics = true
[[mooring]]
on = ["m"]
kind = "linear"
stiffness = { surge = "4280 N/m", sway = "10348 N/m", yaw = "15839 N m/rad" }
[ask]
rao = { periods = "3 s .. 8 s, 6 values", of = ["m.surge", "m.heave"] }
run = { duration = "10 s", every = "0.1 s" }
"""
CYLINDERS = """\
schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "regular"
amplitude = "0.1 m"
period = "5 s"
heading = "0 deg"
[[body]]
name = "b"
mass = "2272 kg"
centre_of_gravity = "(0, 0, -0.6) m"
radii_of_gyration = "(0.6, 0.6, 0.6) m"
[body.hydrodynamics]
excitation = true
radiation = { memory_tolerance = 1e-2 }
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "1.6 m"
draught = "1.13 m"
frequencies = "0.2 rad/s .. 4 rad/s, 9 values"
[ask]
rao = { periods = "3 s .. 8 s, 6 values", of = ["b.heave"] }
"""


class Case:
    """A command and the files that it reads; those of `mutated` are changed, the last word of a command names its table."""

    def __init__(self, command, files, mutated, table=None, plans=False):
        self.command, self.files, self.mutated, self.table, self.plans = command, files, mutated, table, plans


def cases(source):
    """Everything is small: a mutant is to be answered in some hundredths of a second."""
    data, fit, examples = source / "examples/data", source / "examples/fit", source / "examples"

    def read(*paths):
        return {path.name: path.read_bytes() for path in paths}

    out = []
    pontoon, scene = read(data / "pontoon1.nc"), {"s.toml": SCENE.encode()}
    for command in ("run", "rao"):
        out.append(Case([command, "s.toml", "-o", "o.h5", "--csv", "o.csv"], {**pontoon, **scene}, ["s.toml"], "o.csv", True))
    cylinders = {"s.toml": CYLINDERS.encode()}
    out.append(Case(["bem", "solve", "s.toml", "-o", "o.h5"], cylinders, ["s.toml"], None, True))
    out.append(Case(["rao", "s.toml", "-o", "o.h5", "--csv", "o.csv"], cylinders, ["s.toml"], "o.csv", True))
    for name in ("reed", "dropper", "windy", "wild", "rolling", "anchored", "takeoff", "latched", "skipper", "mussels",
                 "forced", "capsize"):
        files = {"s.toml": (examples / f"{name}.toml").read_bytes()}
        for used in re.findall(rb'"(data/[^"]+)"', files["s.toml"]):
            stem = examples / used.decode()
            files.update({f"data/{path.name}": path.read_bytes() for path in stem.parent.glob(stem.stem + ".*")})
        out.append(Case(["run", "s.toml", "-o", "o.h5", "--csv", "o.csv"], files, ["s.toml"], "o.csv", True))
    for name, table in (("decay", ["--table", "o.csv"]), ("oscillation", ["--table", "o.csv"]), ("restoring", []),
                        ("friction", [])):
        used = sorted(path.name for path in [*fit.glob(f"{name}.csv"), *fit.glob(f"{name}_*.csv")])
        files = read(fit / f"{name}.toml", *(fit / each for each in used))
        for mutated in ([f"{name}.toml"], used):
            out.append(Case(["fit", f"{name}.toml", "-o", "o.toml", *table], files, mutated, "o.csv" if table else None))
    for name in ("pontoon1.nc", "hemisphere_r5.nc", "modules5.h5"):
        for command in (["check"], ["info"]):
            out.append(Case(["bem", *command, name], read(data / name), [name]))
    box = read(data / "box2.1", data / "box2.3", data / "box2.hst")
    out.append(Case(["bem", "check", "box2.1", *WATER], box, list(box)))
    out.append(Case(["bem", "convert", "box2.1", *WATER, "-o", "o.h5"], box, list(box)))
    out.append(Case(["hydrostatics", "workboat.obj", "--density", "1025 kg/m^3", "--cog", "(0, 0, 0) m"],
                    read(data / "workboat.obj"), ["workboat.obj"]))
    record = "time [s],wave [m]\n" + "".join(f"{j / 5},{(j * 7 % 20 - 9.5) / 10}\n" for j in range(200))
    for command in (["psd", "r.csv", "-o", "o.csv"], ["extremes", "r.csv", "--signal", "wave"],
                    ["waves", "info", "r.csv", "--column", "wave"]):
        out.append(Case(command, {"r.csv": record.encode()}, ["r.csv"], "o.csv" if "-o" in command else None))
    components = read(data / "huijgen_appendixG_wave_components.csv")
    out.append(Case(["waves", "info", *components, "--depth", "30 m"], components, list(components)))
    return out


def spoil_text(text, draw):
    """One change as people and programs make them: a number, a unit, a word, a line."""
    lines = text.split("\n")
    kind = draw.randrange(9)
    at = draw.randrange(len(lines))
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(at, lines[at])
    elif kind == 2:
        other = draw.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 3:
        lines = lines[:at] + [lines[at][:draw.randrange(len(lines[at]) + 1)]]
    elif kind == 4 and "=" in lines[at]:
        lines[at] = lines[at].split("=")[0] + "= " + draw.choice(WORDS)
    elif kind == 5:
        units = [match for match in re.finditer(r"(?<=[0-9)] )[A-Za-z][A-Za-z/^ 0-9]*(?=\")", text)]
        if units:
            one = draw.choice(units)
            return text[:one.start()] + draw.choice(UNITS) + text[one.end():]
    else:
        numbers = list(re.finditer(r"[-+]?[0-9]+\.?[0-9]*(?:[eE][-+]?[0-9]+)?", text))
        if numbers:
            one = draw.choice(numbers)
            return text[:one.start()] + draw.choice(NUMBERS) + text[one.end():]
    return "\n".join(lines)


def spoil_bytes(content, draw):
    """One change as disks and transfers make them. The first kilobytes hold what files say of themselves."""
    content = bytearray(content)
    near = min(len(content), 4096) if draw.random() < 0.7 else len(content)
    at = draw.randrange(max(near, 1))
    kind = draw.randrange(6)
    if kind == 0:
        return bytes(content[:at])
    if kind == 1:
        del content[at:at + draw.randrange(1, 64)]
    elif kind == 2:
        content[at:at] = content[at:at + draw.randrange(1, 64)]
    elif kind == 3:
        content[at:at + 8] = draw.choice([b"\0" * 8, b"\xff" * 8, b"\x7f\xf0" + b"\0" * 6, b"\x7f\xff" * 4])
    else:
        for _ in range(draw.randrange(1, 5)):
            if content:
                content[min(at + draw.randrange(64), len(content) - 1)] = draw.randrange(256)
    return bytes(content)


def mutated(case, draw):
    files = dict(case.files)
    for _ in range(draw.choice([1, 1, 1, 2, 4])):
        name = draw.choice(case.mutated)
        is_text = name.split(".")[-1] not in ("nc", "h5")
        if is_text and draw.random() < 0.85:
            files[name] = spoil_text(files[name].decode("utf-8", "surrogateescape"), draw).encode("utf-8", "surrogateescape")
        else:
            files[name] = spoil_bytes(files[name], draw)
    return files


def told_seconds(plan):
    """What a plan says that the answer takes, s."""
    seconds = sum(float(number) for number in re.findall(r"about ([0-9.e+-]+) s\b", plan))
    # Of a run it tells steps. Each takes some 1e-5 s, and seven runs with other steps tell the error.
    steps = sum(float(number) for number in re.findall(r"^run: ([0-9.e+]+) steps", plan, re.M))
    return seconds + 7e-5 * steps


class Suite:
    def __init__(self, froude, source, keep):
        self.froude, self.cases, self.keep = froude, cases(source), keep
        self.failures, self.counts = [], {"answered": 0, "refused": 0, "gave up": 0, "told to be long": 0}

    def call(self, folder, command, limit):
        def limited():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        environment = {**os.environ, "FROUDE_CACHE": "off", "OPENBLAS_NUM_THREADS": "1"}
        try:
            return subprocess.run([str(self.froude), *command], cwd=folder, capture_output=True, timeout=limit,
                                  preexec_fn=limited, env=environment)
        except subprocess.TimeoutExpired:
            return None

    def fault_of(self, result, case, limit):
        """Why this end is none that a user should see, or None."""
        if result is None:
            return f"still running after {limit:.0f} s"
        message = result.stderr.decode("utf-8", "replace")
        if result.returncode < 0:
            return f"ended by signal {-result.returncode}"
        if result.returncode not in (0, 1, 2, 3):
            return f"exit status {result.returncode}: {message[:300]}"
        named = any(Path(name).name in message for name in [*case.files, "o.h5", "o.csv", "o.toml"]) or "--" in message
        if result.returncode == 2 and not named:
            return f"refused without a place: {message[:300]}"
        return None

    def not_finite(self, folder, case):
        table = folder / case.table if case.table else None
        if table and table.exists() and re.search(r"(^|[,; ])-?(nan|inf)\b", table.read_text(errors="replace"), re.M):
            return f"NaN or infinity in {case.table}"
        return None

    def try_in(self, folder, case):
        limit = LIMIT_S
        if case.plans:
            plan = self.call(folder, ["plan", "s.toml"], LIMIT_S)
            fault = self.fault_of(plan, case, LIMIT_S)
            if fault:
                return "plan: " + fault
            if plan.returncode == 0:
                told = told_seconds(plan.stdout.decode("utf-8", "replace"))
                if told > LONGEST_TOLD_S:
                    self.counts["told to be long"] += 1
                    return None
                limit = START_S + FACTOR * LONGEST_TOLD_S
        result = self.call(folder, case.command, limit)
        fault = self.fault_of(result, case, limit)
        if fault:
            return fault
        self.counts[{0: "answered", 1: "answered", 2: "refused", 3: "gave up"}[result.returncode]] += 1
        return self.not_finite(folder, case) if result.returncode in (0, 1) else None

    def require_good(self):
        """What is mutated must be answered as it stands; else its mutants say little."""
        for case in self.cases:
            with tempfile.TemporaryDirectory(prefix="froude_mutant_") as folder:
                self.write(Path(folder), case.files)
                result = self.call(Path(folder), case.command, LIMIT_S)
                if result is None or result.returncode not in (0, 1):
                    self.failures.append((None, case.command, "the original is not answered"))
                    print(f"froude {' '.join(case.command)}: the original is not answered:",
                          result and result.stderr.decode("utf-8", "replace")[:300], flush=True)

    @staticmethod
    def write(folder, files):
        for name, content in files.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)

    def try_mutant(self, number):
        draw = random.Random(number)
        case = self.cases[number % len(self.cases)]
        folder = Path(tempfile.mkdtemp(prefix="froude_mutant_"))
        try:
            self.write(folder, mutated(case, draw))
            fault = self.try_in(folder, case)
            if fault:
                self.failures.append((number, case.command, fault))
                print(f"mutant {number}: froude {' '.join(case.command)}: {fault}", flush=True)
                if self.keep:
                    shutil.copytree(folder, Path(self.keep) / str(number), dirs_exist_ok=True)
        finally:
            shutil.rmtree(folder)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("froude", type=Path)
    parser.add_argument("source", type=Path)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", type=Path)
    words = parser.parse_args()
    suite = Suite(words.froude.resolve(), words.source.resolve(), words.keep)
    begin = time.monotonic()
    suite.require_good()
    for number in range(words.first, words.first + words.count):
        suite.try_mutant(number)
    told = ", ".join(f"{count} {end}" for end, count in suite.counts.items())
    print(f"{words.count} mutants in {time.monotonic() - begin:.0f} s: {told}; {len(suite.failures)} failed")
    return 1 if suite.failures else 0


if __name__ == "__main__":
    sys.exit(main())
