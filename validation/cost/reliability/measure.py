#!/usr/bin/python3
"""What a sweep bears and how fast it is.  measure.py FROUDE SCRATCH [CASES] > docs/reliability.md

Writes the page from what it sees; a fault that is not borne ends it with an error. As root it also mounts a small and a
read-only tmpfs below SCRATCH; without that these two lines say "not tried".
"""
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

FROUDE, SCRATCH = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CASES = int(sys.argv[3]) if len(sys.argv) > 3 else 10000
ENVIRONMENT = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "FROUDE_CACHE": "off"}

# A mass on a spring, undamped and let go: a run of a millisecond or two.
SCENE = """\
schema = 1
[water]
density = "1025 kg/m^3"
depth = "infinite"
[waves]
kind = "regular"
height = "1 m"
period = "5 s"
heading = "0 deg"
[[body]]
name = "block"
mass = "100 kg"
free = "surge"
initial = { surge = "20 cm" }
[[mooring]]
on = "block"
kind = "linear"
stiffness = { surge = "400 N/m" }
[ask]
run = { duration = "5 s", every = "0.1 s", of = ["block.surge"] }
accuracy = 1e-2
"""
STUDY = """\
schema = 1
scene = "block.toml"
[[axis]]
name = "mass"
key = "body.block.mass"
range = "100 kg .. 400 kg, {} values"
[[output]]
kind = "run"
of = "block.surge"
statistic = ["deviation", "maximum"]
"""
SKIP = '[[skip]]\nof = "steepness"\nabove = 0.9\n'


def sweep(*arguments, **options):
    return subprocess.run([str(FROUDE), "sweep", *map(str, arguments)], cwd=SCRATCH, capture_output=True, errors="replace",
                          env=ENVIRONMENT, **options)


def told(*arguments):
    done = sweep(*arguments, "--json")
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def table(folder):
    return (folder / "table.csv").read_bytes()


def require(condition, what):
    if not condition:
        sys.exit(f"not borne: {what}")


def study(cases, more=""):
    name = f"study{cases}{'s' if more else ''}.toml"
    (SCRATCH / name).write_text(STUDY.format(cases) + more, encoding="utf-8")
    return name


def reading_ms():
    """To put values into the text and read it: what a steepness is looked up in."""
    def seconds(more):
        begin = time.perf_counter()
        told(study(CASES, more), "--plan")
        return time.perf_counter() - begin
    return 1000 * (seconds(SKIP) - seconds("")) / CASES


def speeds():
    """Rows of the table of threads, and the tables that they wrote."""
    rows, tables = [], []
    for threads in (1, 2):
        folder = SCRATCH / f"threads{threads}"
        said = told(study(CASES), "-o", folder.name, "--threads", threads)
        work = sqlite3.connect(folder / "sweep.sqlite").execute("SELECT sum(seconds) FROM work").fetchone()[0]
        rows.append((threads, said["wall_time_s"], work))
        tables.append(table(folder))
    require(tables[0] == tables[1], "another number of threads")
    return rows


def kills(times, whole):
    name, moments = study(400), random.Random(1)
    done = 0
    for i in range(times):
        folder = SCRATCH / f"kill{i}"
        process = subprocess.Popen([str(FROUDE), "sweep", name, "-o", folder.name], cwd=SCRATCH, env=ENVIRONMENT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(moments.uniform(0, 1.1 * whole))
        process.send_signal(signal.SIGKILL)
        process.wait()
        if (folder / "sweep.sqlite").exists():
            done += 1
        require(sweep(name, "-o", folder.name).returncode == 0, f"killed, sweep {i} does not go on")
        require(table(folder) == table(SCRATCH / "undisturbed"), f"killed, sweep {i} has another table")
        shutil.rmtree(folder)
    return done


def mounted(kind, action):
    folder = SCRATCH / kind
    folder.mkdir()
    option = "size=160k" if kind == "small" else "ro"
    if subprocess.run(["mount", "-t", "tmpfs", "-o", option, "none", str(folder)], capture_output=True).returncode != 0:
        return "not tried: that needs the right to mount"
    try:
        return action(folder)
    finally:
        subprocess.run(["umount", str(folder)])


def disk_full(folder):
    said = sweep(study(2000), "-o", folder / "out")
    require(said.returncode == 2 and "free some space" in said.stderr, "a full disk: " + said.stderr)
    subprocess.run(["mount", "-o", "remount,size=10m", str(folder)], check=True)
    again = told(study(2000), "-o", folder / "out")
    require(again["done"] == 2000, "a full disk, gone on")
    return (f"exit status 2, one message with the system's reason; with space again the same command kept "
            f"{2000 - again['answered']} cases and answered the other {again['answered']}")


def read_only(folder):
    said = sweep(study(2000), "-o", folder / "out")
    require(said.returncode == 2 and "cannot" in said.stderr, "a read-only folder: " + said.stderr)
    return "exit status 2 before any work"


def two_at_once():
    long = SCRATCH / "long.toml"
    long.write_text(STUDY.format(4000), encoding="utf-8")
    first = subprocess.Popen([str(FROUDE), "sweep", long.name, "-o", "two"], cwd=SCRATCH, env=ENVIRONMENT,
                             stdout=subprocess.DEVNULL)
    while not (SCRATCH / "two" / "sweep.sqlite").exists():
        time.sleep(0.01)
    second = sweep(long.name, "-o", "two")
    require(second.returncode == 2 and "another sweep is at work" in second.stderr, "two sweeps in one folder")
    require(first.wait() == 0, "the first of two sweeps")
    return "the second is refused, exit status 2; the first ends as ever"


def damaged():
    database = SCRATCH / "undisturbed" / "sweep.sqlite"
    before = database.read_bytes()
    random_bytes = random.Random(2)
    kept, refused = table(SCRATCH / "undisturbed"), 0
    for _ in range(50):
        at = random_bytes.randrange(len(before) - 64)
        database.write_bytes(before[:at] + random_bytes.randbytes(64) + before[at + 64:])
        said = sweep("study400.toml", "-o", "undisturbed")
        require(said.returncode in (0, 2), "a damaged database: " + said.stderr)
        require(said.returncode == 2 or table(SCRATCH / "undisturbed") == kept, "a damaged database goes into the table")
        refused += said.returncode == 2
    database.write_bytes(before)
    return (f"{refused} refused with exit status 2, which leaves the file as it is; {50 - refused} answered anew where a row "
            "was not as written, or not touched: the table is the same to the bit")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    (SCRATCH / "block.toml").write_text(SCENE, encoding="utf-8")
    read = reading_ms()
    rows = speeds()
    begin = time.perf_counter()
    told(study(400), "-o", "undisturbed", "--threads", 2)
    killed = kills(50, time.perf_counter() - begin)
    one = rows[0]
    print(f"""# Speed and faults of sweeps

Written by `/usr/bin/python3 validation/cost/reliability/measure.py build/release/apps/froude/froude /tmp/sweeps > docs/reliability.md`, which ends with an error where a fault is not borne. {os.cpu_count()} cores, OpenBLAS at one thread.

## {CASES} short cases

A mass on a spring, 5 s, with the runs that tell its error.

| threads | by the clock [s] | cases a second | work in cases [s] | beside the cases, a case and thread [ms] |
| --- | --- | --- | --- | --- |""")
    for threads, wall, work in rows:
        print(f"| {threads} | {wall:.1f} | {CASES / wall:.0f} | {work:.1f} | {1000 * (wall * threads - work) / CASES:.3f} |")
    print(f"""
Two threads are {one[1] / rows[1][1]:.2f} times as fast as one, and write the same bits. A case is {1000 * one[2] / CASES:.2f} ms of work, {read:.2f} ms of it to put its values into the text and to read that. What a sweep adds to the runs themselves is the sum of this and of the last column: {read + 1000 * (one[1] - one[2]) / CASES:.2f} ms a case.

## Faults

| fault | what came of it |
| --- | --- |
| kill -9 at 50 random moments, {killed} of them after the database was there | the same command went on each time, to the same table to the bit |
| two sweeps in one folder | {two_at_once()} |
| disk full | {mounted("small", disk_full)} |
| 64 bytes of the database overwritten, at 50 random places | {damaged()} |
| read-only folder | {mounted("readonly", read_only)} |""")


if __name__ == "__main__":
    main()
