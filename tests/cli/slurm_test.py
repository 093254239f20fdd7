#!/usr/bin/python3
"""Sweeps under Slurm, by the scripts of docs/guide/sweep.md.  slurm_test.py FROUDE SOURCE

The batch system is one of its own, of one node, on the loopback; where its programs are not installed the test is skipped.
"""
import csv
import getpass
import os
import re
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from run_scenes import SCENE_OF_SWEEPS, STUDY_OF_SWEEPS

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
PATH = f"{FROUDE.parent}:{os.environ['PATH']}:/usr/sbin:/sbin"
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "scancel", "sinfo")
MISSING = [program for program in PROGRAMS if shutil.which(program, path=PATH) is None]
CASES = 12000  # some seconds of work, so that a signal finds it under way

SCENE = SCENE_OF_SWEEPS.replace('"60 s"', '"1 s"')
STUDY = STUDY_OF_SWEEPS.replace("40 values", f"{CASES} values")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """munged, slurmctld and slurmd in a folder."""

    def __init__(self, folder):
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(folder / "slurm.conf")}
        (folder / "munge").mkdir(mode=0o700)
        (folder / "munge" / "key").write_bytes(os.urandom(1024))
        (folder / "munge" / "key").chmod(0o600)
        controller, node = free_ports(2)
        name, user = socket.gethostname().split(".")[0], getpass.getuser()
        (folder / "slurm.conf").write_text(f"""\
ClusterName=loopback
SlurmctldHost={name}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
KillWait=5
NodeName={name} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""", encoding="utf-8")
        self.daemons = []
        try:
            self.start("munged", "--foreground", "--force", f"--key-file={folder}/munge/key",
                       f"--socket={folder}/munge/socket", f"--pid-file={folder}/munge/pid",
                       f"--log-file={folder}/munge/log", f"--seed-file={folder}/munge/seed")
            self.wait(lambda: (folder / "munge" / "socket").exists())
            self.start("slurmctld", "-D")
            self.start("slurmd", "-D")
            self.wait(lambda: "idle" in self.said("sinfo", "--noheader", "--format=%T"))
        except Exception:
            self.stop()
            raise

    def start(self, *command):
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL,
                                             stderr=subprocess.DEVNULL))

    def wait(self, ready):
        for _ in range(300):
            if ready():
                return
            if any(daemon.poll() is not None for daemon in self.daemons):
                break
            time.sleep(0.1)
        raise unittest.SkipTest("Slurm is installed and does not start here")

    def said(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()


class UnderSlurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="froude_slurm_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.cluster = Cluster(cls.folder)
        cls.addClassCleanup(cls.cluster.stop)
        (cls.folder / "block.toml").write_text(SCENE, encoding="utf-8")
        (cls.folder / "study.toml").write_text(STUDY, encoding="utf-8")
        cls.froude("sweep", "study.toml", "-o", "whole")

    @classmethod
    def froude(cls, *arguments):
        subprocess.run([FROUDE, *arguments], cwd=cls.folder, env=cls.cluster.environment, check=True, timeout=120,
                       capture_output=True)

    def table(self, name):
        return (self.folder / name / "table.csv").read_bytes()

    def done(self, name):
        with open(self.folder / name / "table.csv", newline="", encoding="utf-8") as file:
            return sum(row["state"] == "done" for row in csv.DictReader(file))

    def script(self, word):
        """A script of the guide as it stands there, but for how many tasks of how many cores, which here are few."""
        guide = (SOURCE / "docs/guide/sweep.md").read_text(encoding="utf-8")
        text = next(block for block in re.findall(r"```bash\n(.*?)```", guide, re.DOTALL) if word in block)
        for theirs, ours in (("--ntasks=8", "--ntasks=2"), ("--cpus-per-task=8", "--cpus-per-task=1"),
                             ("--array=1-16", "--array=1-4"), ("/16", "/4")):
            text = text.replace(theirs, ours)
        file = self.folder / f"{word.strip('-')}.sh"
        file.write_text(text, encoding="utf-8")
        return file.name

    def submit(self, *arguments, wait=True, check=True):
        done = subprocess.run(["sbatch", "--parsable", *(["--wait"] if wait else []), *arguments], cwd=self.folder,
                              env=self.cluster.environment, capture_output=True, text=True, timeout=180)
        said = "".join(file.read_text(errors="replace") for file in self.folder.glob("slurm-*.out"))
        if check:
            self.assertEqual(done.returncode, 0, done.stderr + said)
        return done.stdout.strip()

    def wait_for_cases(self, pattern):
        """Until a database has some of them."""
        for _ in range(1200):
            for database in self.folder.glob(pattern):
                try:
                    connection = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
                    with connection:
                        count = connection.execute("SELECT count(*) FROM cases").fetchone()[0]
                    connection.close()
                    if count > 0:
                        return
                except sqlite3.Error:
                    pass  # not made yet
            time.sleep(0.05)
        self.fail(f"no case was kept in {pattern}")

    def wait_for_end(self, job):
        for _ in range(600):
            if not self.cluster.said("squeue", "--noheader", f"--jobs={job}").strip():
                return
            time.sleep(0.1)
        self.fail(f"job {job} does not end")

    def test_ranks_share_a_sweep_and_go_on_after_a_signal(self):
        if not (FROUDE.parent / "froude-ranks").exists():
            self.skipTest("froude-ranks is not built")
        script = self.script("--mpi=pmix")
        job = self.submit(script, wait=False)
        self.wait_for_cases("sweep/rank-*/sweep.sqlite")
        self.cluster.said("scancel", "--signal=TERM", job)  # as when its time is over
        self.wait_for_end(job)
        self.assertLess(self.done("sweep"), CASES)
        self.submit(script)
        self.assertEqual(self.table("sweep"), self.table("whole"))

    def test_tasks_of_an_array_do_a_part_each_and_one_that_died_is_submitted_again(self):
        script = self.script("--array")
        job = self.submit(script, wait=False)
        self.wait_for_cases("part2/sweep.sqlite")
        self.cluster.said("scancel", "--full", "--signal=KILL", f"{job}_2")
        self.wait_for_end(job)
        parts = [f"part{n}" for n in range(1, 5)]
        self.froude("sweep", "--merge", *parts, "-o", "partial")
        self.assertLess(self.done("partial"), CASES)
        self.submit("--array=2", script)
        self.froude("sweep", "--merge", *parts, "-o", "merged")
        self.assertEqual(self.table("merged"), self.table("whole"))
        self.assertEqual(self.done("part3"), CASES // 4)


if __name__ == "__main__":
    if MISSING:
        print(f"Slurm is not installed: there is no {', '.join(MISSING)} (Debian: apt install slurmctld slurmd munge)")
        sys.exit(77)  # skipped
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that the daemons are stopped
    unittest.main(argv=sys.argv[:1])
