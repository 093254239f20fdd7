#!/usr/bin/python3
"""`froude bem check`, `froude bem heal` and the scene key `accept`, seen from outside.

    doctor_test.py FROUDE SOURCE

A good data file is spoilt in one way; the program must name it, refuse it in a scene, take it where the scene accepts it, and
heal what can be healed.
"""
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FROUDE = Path(sys.argv[1]).resolve()
SOURCE = Path(sys.argv[2]).resolve()

SCENE = """\
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
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.hydrodynamics]
file = "wrong.nc"
excitation = true
hydrostatics = true
[ask]
rao = { periods = "3 s .. 8 s, 6 values", of = ["m.heave"] }
"""


class Doctor(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_cli_"))
        shutil.copy(SOURCE / "examples" / "data" / "pontoon1.nc", self.folder / "good.nc")
        shutil.copy(self.folder / "good.nc", self.folder / "wrong.nc")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments):
        return subprocess.run([str(FROUDE), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=300)

    def spoil(self, change):
        import netCDF4
        with netCDF4.Dataset(self.folder / "wrong.nc", "a") as data:
            data.set_auto_mask(False)
            change(data)

    def other_time_factor(self):
        """Excitation as if it had been written for the other time factor."""
        def conjugate(data):
            for name in ("excitation_force", "diffraction_force", "Froude_Krylov_force"):
                if name in data.variables:
                    at = data[name].dimensions.index("complex")
                    imaginary = tuple(slice(1, 2) if i == at else slice(None) for i in range(data[name].ndim))
                    data[name][imaginary] = -data[name][imaginary]
        self.spoil(conjugate)

    def unsymmetric(self):
        """Surge and pitch of A a little apart."""
        def change(data):
            A = data["added_mass"][:]
            A[:, 0, 4] *= 1.3
            data["added_mass"][:] = A
        self.spoil(change)

    def findings(self, name, *options):
        result = self.froude("bem", "check", name, "--json", *options)
        document = json.loads(result.stdout)
        self.assertEqual(document["status"], result.returncode)
        return result.returncode, document["files"][0]

    def scene(self, extra=""):
        (self.folder / "scene.toml").write_text(SCENE.replace('file = "wrong.nc"\n', 'file = "wrong.nc"\n' + extra), encoding="utf-8")


class Check(Doctor):
    def test_good_data_pass_without_warning(self):
        status, told = self.findings("good.nc", "--strict")
        self.assertEqual((status, told["errors"], told["warnings"]), (0, 0, 0))

    def test_an_error_is_told_with_place_reason_and_remedy_and_status_1(self):
        self.other_time_factor()
        status, told = self.findings("wrong.nc")
        self.assertEqual(status, 1)
        wrong = [f for f in told["findings"] if f["severity"] == "error"]
        self.assertEqual([f["check"] for f in wrong], ["surge and sway in long waves"])
        self.assertEqual(wrong[0]["body"], 1)
        for key in ("where", "message", "why", "remedy"):
            self.assertTrue(wrong[0][key], key)
        text = self.froude("bem", "check", "wrong.nc").stdout
        for word in ("surge and sway in long waves", wrong[0]["where"], wrong[0]["why"], wrong[0]["remedy"], "1 errors"):
            self.assertIn(word, text)

    def test_a_warning_has_status_1_only_if_strict(self):
        self.unsymmetric()
        status, told = self.findings("wrong.nc")
        self.assertEqual((status, told["errors"]), (0, 0))
        self.assertGreater(told["warnings"], 0)
        self.assertEqual(self.findings("wrong.nc", "--strict")[0], 1)


class Accept(Doctor):
    def test_a_scene_with_an_error_finding_is_refused_with_the_key_that_accepts_it(self):
        self.other_time_factor()
        self.scene()
        result = self.froude("rao", "scene.toml", "-o", "rao.h5")
        self.assertEqual(result.returncode, 2)
        for word in ("scene.toml:16:", "wrong.nc", "surge and sway in long waves", 'accept = ["surge and sway in long waves"]'):
            self.assertIn(word, result.stderr)
        self.assertFalse((self.folder / "rao.h5").exists())

    def test_an_accepted_error_is_recorded_in_the_result(self):
        import netCDF4
        self.other_time_factor()
        self.scene('accept = ["surge and sway in long waves"]\n')
        result = self.froude("rao", "scene.toml", "-o", "rao.h5")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("accepted, surge and sway in long waves", result.stdout)
        with netCDF4.Dataset(self.folder / "rao.h5") as data:
            text = str(data["provenance"]["notes"].__dict__)
        self.assertIn("accepted, surge and sway in long waves", text)

    def test_an_unknown_check_is_refused_with_the_nearest_one(self):
        self.scene('accept = ["symetry of A"]\n')
        result = self.froude("rao", "scene.toml", "-o", "rao.h5")
        self.assertEqual(result.returncode, 2)
        for word in ("scene.toml:17:", "symetry of A", "symmetry of A"):
            self.assertIn(word, result.stderr)

    def test_what_the_scene_does_not_use_is_not_judged(self):
        self.other_time_factor()
        (self.folder / "scene.toml").write_text(SCENE.replace("excitation = true\n", "").replace(
            SCENE[SCENE.index("[waves]"):SCENE.index("[[body]]")], "").replace(
            SCENE[SCENE.index("[ask]"):], '[ask]\nrun = { duration = "1 s", every = "0.1 s" }\n'), encoding="utf-8")
        result = self.froude("run", "scene.toml", "-o", "run.h5")
        self.assertEqual(result.returncode, 0, result.stderr)


class Heal(Doctor):
    def test_healing_tells_each_step_and_the_result_is_clean(self):
        self.unsymmetric()
        result = self.froude("bem", "heal", "wrong.nc", "--symmetry", "--passivity", "-o", "healed.h5", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        told = json.loads(result.stdout)
        self.assertEqual([s["step"] for s in told["steps"]], ["symmetry", "passivity"])
        self.assertGreater(told["steps"][0]["largest_relative_change"], 0.02)
        self.assertGreater(told["before"]["warnings"], told["after"]["warnings"])
        symmetry = [f for f in self.findings("healed.h5")[1]["findings"] if f["check"] == "symmetry of A"]
        self.assertEqual(symmetry[0]["severity"], "note")
        self.assertIn("healed, symmetry", self.froude("bem", "info", "healed.h5").stdout)

    def test_the_file_that_is_read_is_never_replaced(self):
        before = (self.folder / "good.nc").read_bytes()
        result = self.froude("bem", "heal", "good.nc", "-o", "good.nc")
        self.assertEqual(result.returncode, 2)
        self.assertIn("would be replaced", result.stderr)
        self.assertEqual((self.folder / "good.nc").read_bytes(), before)
        self.froude("bem", "convert", "good.nc", "-o", "set.1")
        water = ["--density", "1000 kg/m^3", "--gravity", "9.81 m/s^2", "--depth", "14 m"]
        for name in ("set.1", "set"):
            result = self.froude("bem", "heal", name, *water, "-o", "set.1")
            self.assertEqual(result.returncode, 2, name)
            self.assertIn("would be replaced", result.stderr)

    def test_help_shows_an_example(self):
        self.assertIn("froude bem heal ", self.froude("bem", "heal", "-h").stdout.split("Example")[1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
