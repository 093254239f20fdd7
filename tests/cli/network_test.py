#!/usr/bin/python3
"""Nothing asks the network at run time.  network_test.py FROUDE SOURCE NO_NETWORK

NO_NETWORK is a library that ends a program at its first call of socket, connect or a look-up of names. Libraries that
Froude is linked with could do that: netCDF opens addresses too.
"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE, SOURCE, NO_NETWORK = (Path(argument).resolve() for argument in sys.argv[1:4])


class WithoutNetwork(unittest.TestCase):
    def run_alone(self, *command):
        with tempfile.TemporaryDirectory(prefix="froude_alone_") as folder:
            return subprocess.run([str(argument) for argument in command], cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "LD_PRELOAD": str(NO_NETWORK), "XDG_CACHE_HOME": folder}, timeout=300)

    def test_the_guard_ends_who_asks(self):
        done = self.run_alone("/usr/bin/python3", "-c", "import socket; socket.socket()")
        self.assertEqual((done.returncode, done.stderr), (99, "asked the network: socket\n"))

    def test_no_command_asks(self):
        examples = SOURCE / "examples"
        for command in (("run", examples / "sweep" / "float.toml", "-o", "r.h5", "--picture", "r.svg"),
                        ("plan", examples / "dropper.toml"),
                        ("rao", examples / "headings.toml", "-o", "r.h5"),
                        ("bem", "convert", examples / "data" / "box2.nc", "-o", "b.h5"),
                        ("bem", "check", examples / "data" / "hemisphere_r5.1", "--density", "1000 kg/m^3", "--gravity",
                         "9.81 m/s^2", "--depth", "infinite"),
                        ("fit", examples / "fit" / "decay.toml", "-o", "f.toml"),
                        ("sweep", examples / "sweep" / "study.toml", "--plan")):
            done = self.run_alone(FROUDE, *command)
            self.assertNotIn("asked the network", done.stderr, command)
            self.assertEqual(done.returncode, 0, (command, done.stderr))

    def test_an_address_is_no_file(self):
        for command in (("bem", "convert", "http://localhost/box.nc", "-o", "b.h5"),
                        ("bem", "check", "https://localhost/box.nc#mode=bytes"),
                        ("psd", "http://localhost/run.h5"), ("run", "http://localhost/scene.toml")):
            done = self.run_alone(FROUDE, *command)
            self.assertEqual(done.returncode, 2, (command, done.stderr))
            self.assertNotIn("asked the network", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
