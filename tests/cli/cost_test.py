#!/usr/bin/python3
"""`froude cost` as a user meets it: what is told, what is written, what is refused.

    cost_test.py FROUDE SOURCE
"""
import json
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()

SCENE = """\
schema = 1
[water]
density = "1025 kg/m^3"
depth = "infinite"
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
run = { duration = "10 s", every = "0.2 s", of = ["block.surge"] }
[solve]
step = "0.1 s"   # by hand
"""


class Cost(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_cost_"))
        (self.folder / "scene.toml").write_text(SCENE)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments):
        return subprocess.run([str(FROUDE), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=600)

    def refused(self, *arguments):
        """The message; the file of the scene stays as it was."""
        done = self.froude("cost", *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual((self.folder / "scene.toml").read_text(), SCENE)
        return done.stderr

    def test_the_setting_that_is_written_is_the_one_that_is_named(self):
        done = self.froude("cost", "scene.toml", "--tolerance", "1e-2", "-o", "cheaper.toml", "--picture", "cost.svg", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)["answers"][0]
        chosen = answer["rungs"][answer["chosen"]]
        self.assertLessEqual(chosen["errors"]["rms"]["error"], 1e-2)
        # The scene's own step of 0.1 s is off by (ωh)²/12 ωT/√3 = 0.04: something else was chosen.
        self.assertFalse(chosen["as_scene"])
        written = (self.folder / "cheaper.toml").read_text()
        self.assertIn("# by hand", written)
        self.assertIn(tomllib.loads(written)["solve"]["step"].removesuffix(" s"), chosen["setting"])
        self.assertEqual(self.froude("run", "cheaper.toml").returncode, 0)
        self.assertTrue((self.folder / "cost.svg").read_text().startswith("<svg"))

    def test_people_are_told_a_table_and_what_it_comes_to(self):
        told = self.froude("cost", "scene.toml", "--by", "deviation", "--tolerance", "1e-2").stdout
        for word in ("approximation", "step", "0.1 s (scene)", "integrator", "reference: ", "the scene as it is: ",
                     "cheapest within 0.01: "):
            self.assertIn(word, told)

    def test_a_tolerance_that_nothing_keeps_is_refused_with_what_is_nearest(self):
        done = self.froude("cost", "scene.toml", "--tolerance", "1e-10", "-o", "cheaper.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no setting keeps the run within 1e-10; nearest is ", done.stderr)
        self.assertFalse((self.folder / "cheaper.toml").exists())

    def test_wrong_input(self):
        for tolerance in ("0", "1", "-1", "nan", "1e-16"):
            self.assertIn("--tolerance", self.refused("scene.toml", "--tolerance", tolerance))
        self.assertIn("--tolerance 1e-2", self.refused("scene.toml", "-o", "other.toml"))
        self.assertIn("would be replaced", self.refused("scene.toml", "--tolerance", "1e-2", "-o", "scene.toml"))
        self.assertIn(".toml", self.refused("scene.toml", "--tolerance", "1e-2", "-o", "other.h5"))
        self.assertIn("--by", self.refused("scene.toml", "--by", "feeling"))
        (self.folder / "modes.toml").write_text(SCENE.replace('run = { duration = "10 s", every = "0.2 s", of = ["block.surge"] }', "modes = {}"))
        self.assertIn("nothing to price", self.refused("modes.toml"))

    def test_a_copy_stays_beside_the_files_that_its_scene_names(self):
        shutil.copytree(SOURCE / "examples" / "data", self.folder / "in" / "data")
        shutil.copy(SOURCE / "examples" / "roll.toml", self.folder / "in")
        told = self.refused("in/roll.toml", "--tolerance", "1e-2", "-o", "cheaper.toml")
        self.assertIn("write it to in/cheaper.toml", told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
