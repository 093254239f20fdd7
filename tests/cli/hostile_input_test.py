#!/usr/bin/python3
"""Input that once ended the program, or kept it busy without end, is refused with a place.

    hostile_input_test.py FROUDE SOURCE

Each was found by mutants_test.py, by a fuzzer (scripts/fuzz) or by a reader of the code; more stand in the tests of readers.
"""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import mutants_test

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SCENE, CYLINDERS = mutants_test.SCENE, mutants_test.CYLINDERS
PERIODS = "period [s],amplitude [m],phase [rad]\n"


class Hostile(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_hostile_"))
        self.suite = mutants_test.Suite(FROUDE, SOURCE, None)
        shutil.copy(SOURCE / "examples/data/pontoon1.nc", self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def refuses(self, name, content, words, *command):
        """With exit status 2, a message that has all words, and within the time and memory of a mutant."""
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        result = self.suite.call(self.folder, list(command), mutants_test.LIMIT_S)
        self.assertIsNotNone(result, "still running")
        message = result.stderr.decode("utf-8", "replace")
        self.assertEqual(result.returncode, 2, message)
        for word in words:
            self.assertIn(word, message)

    def refuses_scene(self, old, new, words, *command, scene=SCENE):
        self.assertIn(old, scene)
        self.refuses("s.toml", scene.replace(old, new, 1), words, *(command or ("plan", "s.toml")))

    def test_keys_and_values_nested_without_end(self):
        for text in ("a." * 20000 + "b = 1\n" + SCENE, "[" + "a." * 20000 + "b]\n", "\nx = " + "[" * 20000,
                     "x = {" + ",".join(["a." * 60 + "b = {"] * 50)):
            self.refuses("s.toml", text, ["s.toml:", "levels deep"], "plan", "s.toml")
        self.refuses("s.toml", "x = [" + "1, " * 20000 + "]\n", ["s.toml:1:1", "60006 characters long"], "plan", "s.toml")

    def test_series_and_runs_without_end(self):
        self.refuses_scene('every = "0.1 s"', 'every = "1e-9 s"', ["s.toml:28:", "1e+10 samples"])
        self.refuses_scene('duration = "10 s"', 'duration = "2147483648 s"', ["s.toml:28:", "samples"])
        self.refuses_scene('yaw = "15839 N m/rad"', 'yaw = "1e29 N m/rad"', ["s.toml:28:", "steps", "m.yaw"])

    def test_sizes_beyond_what_is_computed_with(self):
        self.refuses_scene("(0, 0, 1.31) m", "(0, 1e200, 1.31) m", ["s.toml:15:", "1e30"])
        self.refuses_scene("0.02", "1e-200", ["s.toml:20:", "1e30"])
        self.refuses("r.csv", PERIODS + "5,1e200,0\n", ["r.csv:2:3", "1e200"], "waves", "info", "r.csv")
        self.refuses("m.obj", "v 0 0 -1\nv 1 0 -1\nv 0 1e200 -1\nf 1 2 3\n", ["m.obj", "1e+200"], "hydrostatics", "m.obj",
                     "--density", "1025 kg/m^3", "--cog", "(0, 0, 0) m")

    def test_waves_of_which_one_is_a_million_times_as_long(self):
        waves = PERIODS + "".join(f"{3 + i / 10},0.1,0\n" for i in range(50)) + "2e9,0.1,0\n"
        self.refuses("r.csv", waves, ["r.csv", "instants"], "waves", "info", "r.csv", "--depth", "30 m")

    def test_cylinders_of_a_size_that_no_sum_reaches(self):
        solve = ("bem", "solve", "s.toml", "-o", "o.h5")
        for old, new in (("1.13 m", "1e-29 m"), ("1.6 m", "1e-29 m"), (".. 4 rad/s", ".. 2e9 rad/s")):
            self.refuses_scene(old, new, ["s.toml:19:", "terms"], *solve, scene=CYLINDERS)

    def test_hdf5_that_its_library_does_not_survive(self):
        data = SOURCE / "examples/data"
        for name, changes in (("hemisphere_r5.nc", {3771: 127, 3772: 240, 3776: 0}),  # searches a heap without end
                              ("modules5.h5", {3507: 132, 3542: 116}),  # a fault of memory
                              ("pontoon1.nc", {3640: 33, 3651: 67, 3664: 66})):
            content = bytearray((data / name).read_bytes())
            for at, byte in changes.items():
                content[at] = byte
            self.refuses(name, bytes(content), [name, "damaged"], "bem", "info", name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
