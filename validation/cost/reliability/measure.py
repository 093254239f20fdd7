#!/usr/bin/python3
"""What a sweep bears and how fast it is.  measure.py FROUDE SCRATCH [CASES] > docs/reliability.md

Writes the page from what it sees; a fault that is not borne ends it with an error. As root it also mounts a small and a
read-only tmpfs below SCRATCH; without that these two lines say "not tried", as lines about ranks do without mpirun and
froude-ranks.
"""
import json
import os
import random
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

FROUDE, SCRATCH = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CASES = int(sys.argv[3]) if len(sys.argv) > 3 else 10000
ENVIRONMENT = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "FROUDE_CACHE": "off", "OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
RANKS = 3
HAS_RANKS = (FROUDE.parent / "froude-ranks").exists() and shutil.which("mpirun") is not None

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


def command(*arguments, ranks=1):
    launcher = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    return [*launcher, str(FROUDE), "sweep", *map(str, arguments)]


def sweep(*arguments, ranks=1, **options):
    return subprocess.run(command(*arguments, ranks=ranks), cwd=SCRATCH, capture_output=True, text=True, errors="replace",
                          env=ENVIRONMENT, **options)


def begun(*arguments, ranks=1):
    return subprocess.Popen(command(*arguments, ranks=ranks), cwd=SCRATCH, env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)


def told(*arguments, ranks=1):
    done = sweep(*arguments, "--json", ranks=ranks)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def table(folder):
    return (folder / "table.csv").read_bytes()


def require(condition, what):
    if not condition:
        sys.exit(f"not borne: {what}")


def study(cases, more="", limits="", scene="block.toml"):
    name = f"study{cases}{'s' if more else ''}{'l' if limits else ''}{'' if scene == 'block.toml' else 'o'}.toml"
    text = STUDY.format(cases).replace("block.toml", scene).replace("schema = 1", "schema = 1\n" + limits)
    (SCRATCH / name).write_text(text + more, encoding="utf-8")
    return name


def reading_ms():
    """To put values into the text and read it: what a steepness is looked up in."""
    def seconds(more):
        begin = time.perf_counter()
        told(study(CASES, more), "--plan")
        return time.perf_counter() - begin
    return 1000 * (seconds(SKIP) - seconds("")) / CASES


def speeds():
    """Rows of the table of speeds: who answers, how many of them, time by the clock, work, the study's cases."""
    limits, short = 'time_limit = "1 h"', "other.toml"
    (SCRATCH / short).write_text(SCENE.replace('"5 s", every', '"0.2 s", every'), encoding="utf-8")
    ways = [("1 thread", 1, study(CASES), ["--threads", 1], 1), ("2 threads", 2, study(CASES), ["--threads", 2], 1),
            ("2 processes, as the study has a time_limit", 2, study(CASES, limits=limits), ["--threads", 2], 1)]
    if HAS_RANKS:
        ways.append((f"{RANKS} ranks", RANKS, study(CASES), [], RANKS))
    ways.append(("1 thread, runs of 0.2 s", 1, study(CASES, scene=short), ["--threads", 1], 1))
    rows, tables = [], []
    for number, (name, workers, file, options, ranks) in enumerate(ways):
        folder = SCRATCH / f"way{number}"
        said = told(file, "-o", folder.name, *options, ranks=ranks)
        work = sqlite3.connect(folder / "sweep.sqlite").execute("SELECT sum(seconds) FROM work").fetchone()[0]
        rows.append((name, workers, said["wall_time_s"], work))
        tables.append(table(folder))
    require(len(set(tables[:-1])) == 1, "another number of threads, processes or ranks")
    return rows


def kills(times, whole):
    name, moments = study(400), random.Random(1)
    done = 0
    for i in range(times):
        folder = SCRATCH / f"kill{i}"
        process = begun(name, "-o", folder.name)
        time.sleep(moments.uniform(0, 1.1 * whole))
        process.send_signal(signal.SIGKILL)
        process.wait()
        if (folder / "sweep.sqlite").exists():
            done += 1
        require(sweep(name, "-o", folder.name).returncode == 0, f"killed, sweep {i} does not go on")
        require(table(folder) == table(SCRATCH / "undisturbed"), f"killed, sweep {i} has another table")
        shutil.rmtree(folder)
    return done


def killed_ranks(times):
    if not HAS_RANKS:
        return "not tried: that needs mpirun and froude-ranks"
    name, moments, kept = study(4000), random.Random(3), []
    told(name, "-o", "undisturbed4000")
    for i in range(times):
        folder = SCRATCH / f"rank{i}"
        process = begun(name, "-o", folder.name, ranks=RANKS)
        while not (folder / "sweep.sqlite").exists():
            time.sleep(0.01)
        time.sleep(moments.uniform(0, 0.5))
        ranks = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="ascii").split()
        if len(ranks) == RANKS:  # not over yet
            os.kill(int(ranks[moments.randrange(RANKS)]), signal.SIGKILL)
            require(process.wait() != 0, "a rank that died goes unnoticed")
        process.wait()
        again = told(name, "-o", folder.name, ranks=RANKS if i % 2 else 1)
        require(table(folder) == table(SCRATCH / "undisturbed4000"), f"a rank that died, sweep {i} has another table")
        kept.append(4000 - again["answered"])
        shutil.rmtree(folder)
    return (f"mpirun ends the others, exit status not 0; the same command, with {RANKS} ranks or none, kept {min(kept)} to "
            f"{max(kept)} of 4000 cases and did the others, to the same table to the bit")


def limited():
    name = study(400, limits='memory_limit = "1 GB"')
    process = begun(name, "-o", "limited", "--threads", 2)
    moments, ended = random.Random(4), 0
    while process.poll() is None and ended < 5:
        time.sleep(moments.uniform(0.02, 0.04))
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        of = children.read_text(encoding="ascii").split() if children.exists() else []
        if len(of) == 2 and (SCRATCH / "limited" / "sweep.sqlite").exists():
            os.kill(int(of[0]), signal.SIGKILL)
            ended += 1
    require(process.wait() in (0, 3), "a process of cases that was killed")
    require(sweep(name, "-o", "limited", "--retry").returncode == 0, "a process of cases that was killed, again")
    require(table(SCRATCH / "limited") == table(SCRATCH / "undisturbed"), "a process of cases that was killed")
    return (f"{ended} killed in one sweep: the case is tried in a new process, and fails with its reason if it was the first of "
            "its process; with --retry the table is the same to the bit")


def size_limited():
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (400000, 400000))
    name = study(4000)
    said = sweep(name, "-o", "size", preexec_fn=limit)
    require(said.returncode == 2 and "free some space" in said.stderr, "a limit of file sizes: " + said.stderr)
    answered = told(name, "-o", "size")["answered"]
    return (f"exit status 2, one message; without the limit the same command kept {4000 - answered} cases and answered the "
            f"other {answered}")


def mounted(kind, action):
    folder = SCRATCH / kind
    folder.mkdir()
    option = "size=400k" if kind == "small" else "ro"
    if subprocess.run(["mount", "-t", "tmpfs", "-o", option, "none", str(folder)], capture_output=True).returncode != 0:
        return "not tried: that needs the right to mount"
    try:
        return action(folder)
    finally:
        subprocess.run(["umount", str(folder)])


def disk_full(folder):
    said = sweep(study(4000), "-o", folder / "out")
    require(said.returncode == 2 and "free some space" in said.stderr, "a full disk: " + said.stderr)
    subprocess.run(["mount", "-o", "remount,size=20m", str(folder)], check=True)
    again = told(study(4000), "-o", folder / "out")
    require(again["done"] == 4000, "a full disk, gone on")
    return (f"exit status 2, one message with the system's reason; with space again the same command kept "
            f"{4000 - again['answered']} cases and answered the other {again['answered']}")


def read_only(folder):
    said = sweep(study(2000), "-o", folder / "out")
    require(said.returncode == 2 and "cannot" in said.stderr, "a read-only folder: " + said.stderr)
    return "exit status 2 before any work"


def two_at_once():
    long = SCRATCH / "long.toml"
    long.write_text(STUDY.format(4000), encoding="utf-8")
    first = begun(long.name, "-o", "two")
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


def killed_run(times):
    """One run with checkpoints, killed `times` times in all; begun anew where it came to its end before."""
    scene = Path(__file__).resolve().parents[3] / "examples" / "overnight.toml"
    moments = random.Random(4)

    def run_command(name):
        return [str(FROUDE), "run", str(scene), "-o", f"{name}.h5", "--csv", f"{name}.csv"]

    def finished(name):
        done = subprocess.run(run_command(name), cwd=SCRATCH, capture_output=True, text=True, env=ENVIRONMENT)
        require(done.returncode == 0, "a run with checkpoints: " + done.stderr)
        return (SCRATCH / f"{name}.csv").read_bytes()

    begin = time.perf_counter()
    whole = finished("undisturbed_run")
    lasts = time.perf_counter() - begin
    kept, ends = 0, 0
    for i in range(times):
        process = subprocess.Popen(run_command("killed_run"), cwd=SCRATCH, env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        time.sleep(moments.uniform(0, lasts))
        process.send_signal(signal.SIGKILL)
        process.wait()
        kept += any((SCRATCH / "killed_run.h5.checkpoints").glob("*.checkpoint"))
        if i % 5 == 4:
            require(finished("killed_run") == whole, f"killed {i + 1} times, a run has other numbers")
            ends += 1
    return (f"at {kept} of them a checkpoint was there; the same command went on, and ended {ends} times, after five kills "
            "each, with the bits of an undisturbed run")


def killed_map(times):
    """A map of runs of some length, killed `times` times before its end."""
    name = Path(__file__).resolve().parents[3] / "examples" / "sweep" / "tongue.toml"
    begin, moments = time.perf_counter(), random.Random(5)
    whole = told(name, "-o", "map")
    lasts = time.perf_counter() - begin
    for _ in range(times):
        process = begun(name, "-o", "killed_map")
        time.sleep(moments.uniform(0.5, 1) * lasts / (times + 1))
        require(process.poll() is None, "the map was done before it was killed")
        process.send_signal(signal.SIGKILL)
        process.wait()
    last = told(name, "-o", "killed_map")
    require(table(SCRATCH / "killed_map") == table(SCRATCH / "map"), "killed, the map has other numbers")
    return (f"{whole['cases']} runs of 600 s, {lasts / 60:.1f} min by the clock; the last start found "
            f"{whole['cases'] - last['answered']} of them done: the table is that of an undisturbed sweep to the bit")


def machine():
    model = next((line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
                  if line.startswith("model name")), "an unknown processor")
    here = Path(__file__).parent
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=here, capture_output=True, text=True)
    return (f"{model}, {os.cpu_count()} cores; {time.strftime('%Y-%m-%d')}, commit {commit.stdout.strip() or 'unknown'}; "
            f"load of the machine at the start {os.getloadavg()[0]:.1f}")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    SCRATCH.mkdir(parents=True)
    (SCRATCH / "block.toml").write_text(SCENE, encoding="utf-8")
    where = machine()
    read = reading_ms()
    rows = speeds()
    begin = time.perf_counter()
    told(study(400), "-o", "undisturbed", "--threads", 2)
    killed = kills(50, time.perf_counter() - begin)
    one, two, shortest = rows[0], rows[1], rows[-1]
    print(f"""# Speed and faults of sweeps

Written by `validation/cost/reliability/measure.py`, which ends with an error where a fault is not borne:

    /usr/bin/python3 validation/cost/reliability/measure.py build/release/apps/froude/froude /tmp/sweeps > docs/reliability.md

{where}. OpenBLAS at one thread.

## {CASES} short cases

A mass on a spring, 5 s, with the runs that tell its error.

| answered by | by the clock [s] | cases a second | work in cases [s] | beside the cases, a case and worker [ms] |
| --- | --- | --- | --- | --- |""")
    for name, workers, wall, work in rows:
        print(f"| {name} | {wall:.1f} | {CASES / wall:.0f} | {work:.1f} | {1000 * (wall * workers - work) / CASES:.3f} |")
    print(f"""
Two threads are {one[2] / two[2]:.2f} times as fast as one; all but the last line wrote the same bits. A case is
{1000 * one[3] / CASES:.2f} ms of work, {read:.2f} ms of it to put its values into the text and to read that. What a sweep adds to the
runs themselves is the sum of this and of the last column: {read + 1000 * (one[2] - one[3]) / CASES:.2f} ms a case. All that does not depend
on how long a run is (reading, the model, its start, the runs that tell the error, statistics, the database) is less
than a case of 0.2 s takes: {1000 * shortest[2] / CASES:.2f} ms. Ranks are more than cores here, and wait for a core as for work.

## Faults

| fault | what came of it |
| --- | --- |
| kill -9 at 50 random moments, {killed} of them after the database was there | the same command went on each time, to the same table to the bit |
| kill -9 of one of {RANKS} ranks, at 10 random moments | {killed_ranks(10)} |
| kill -9 of processes of cases, where the study has limits | {limited()} |
| kill -9 of one `froude run` with checkpoints, `examples/overnight.toml`, at 20 random moments | {killed_run(20)} |
| kill -9 of the map of `examples/sweep/tongue.toml`, five times | {killed_map(5)} |
| two sweeps in one folder | {two_at_once()} |
| disk full | {mounted("small", disk_full)} |
| files may not grow beyond 400 kB | {size_limited()} |
| 64 bytes of the database overwritten, at 50 random places | {damaged()} |
| read-only folder | {mounted("readonly", read_only)} |""")


if __name__ == "__main__":
    main()
