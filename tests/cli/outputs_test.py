#!/usr/bin/python3
"""No command destroys what it reads, and outputs that are no plain files are written through.

    outputs_test.py FROUDE SOURCE

Each command is given each of its inputs as an output. It must say so with exit status 2 and leave every file as it was.
"""
import os
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

FROUDE = Path(sys.argv[1]).resolve()
SOURCE = Path(sys.argv[2]).resolve()

SCENE = """\
schema = 1
include = "numbers.toml"
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "14 m"
[waves]
kind = "components"
file = "waves.csv"
heading = "0 deg"
[[probe]]
name = "gauge"
at = "(0, 0, 0) m"
gives = ["elevation"]
[[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = {}
hydrostatics = true
[[mooring]]
on = ["m"]
kind = "linear"
stiffness = { surge = "numbers.k", sway = "10348 N/m", yaw = "15839 N m/rad" }
[ask]
rao = { periods = "3 s .. 8 s, 6 values", of = ["m.heave"] }
modes = {}
run = { duration = "5 s", every = "0.1 s" }
waves = { duration = "5 s", every = "0.1 s" }
"""

RECORD = "time [s],wave [m]\n" + "".join(f"{j / 5},{(j % 20 - 9.5) / 10}\n" for j in range(200))
WATER = ["--density", "1000 kg/m^3", "--gravity", "9.81 m/s^2", "--depth", "infinite"]


class Outputs(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_outputs_"))
        data = SOURCE / "examples" / "data"
        for name in ("pontoon1.nc", "box2.1", "box2.3", "box2.hst", "workboat.obj"):
            shutil.copy(data / name, self.folder)
        self.write("s.toml", SCENE)
        self.write("numbers.toml", '[coefficients]\nk = "4280 N/m"\n')
        self.write("waves.csv", "period [s],amplitude [m],phase [rad]\n5,0.1,0\n6,0.1,1\n")
        self.write("m.csv", RECORD)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def froude(self, *arguments, **options):
        return subprocess.run([str(FROUDE), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, **options)

    def contents(self):
        return {path.relative_to(self.folder): path.read_bytes()
                for path in self.folder.rglob("*") if path.is_file() and not path.is_symlink()}

    def refuses(self, *arguments, words=("would be replaced",)):
        before = self.contents()
        result = self.froude(*arguments)
        self.assertEqual(result.returncode, 2, f"{arguments}: {result.stdout}{result.stderr}")
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(self.contents(), before, arguments)

    def test_records_are_not_replaced_by_any_name(self):
        (self.folder / "soft.csv").symlink_to("m.csv")
        os.link(self.folder / "m.csv", self.folder / "hard.csv")
        for name in ("m.csv", "./m.csv", self.folder / "m.csv", "soft.csv", "hard.csv"):
            self.refuses("psd", "m.csv", "-o", name, words=("would be replaced", "-o", "the record"))
        self.refuses("psd", "m.csv", "--picture", "m.csv", words=("--picture",))
        self.refuses("psd", "soft.csv", "-o", "hard.csv")
        self.refuses("poincare", "m.csv", "--x", "wave", "--y", "wave", "--every", "4 s", "-o", "m.csv")

    def test_scenes_and_the_files_that_they_name_are_not_replaced(self):
        for command in (["run"], ["rao"], ["modes"], ["waves", "make"]):
            for name in ("s.toml", "waves.csv", "numbers.toml"):
                self.refuses(*command, "s.toml", "-o", "x.h5", "--csv", name, words=("--csv", name))
                self.refuses(*command, "s.toml", "-o", "x.h5", "--picture", name, words=("--picture", name))
            self.refuses(*command, "s.toml", "-o", "pontoon1.nc", words=("body.hydrodynamics.file", "-o"))
        # Without -o the result is called after the scene.
        self.write("s.toml", SCENE.replace("pontoon1.nc", "s.run.h5"))
        self.froude("bem", "convert", "pontoon1.nc", "-o", "s.run.h5")
        self.refuses("run", "s.toml", words=("s.run.h5",))

    def test_coefficients_are_not_replaced(self):
        self.refuses("bem", "convert", "pontoon1.nc", "-o", "pontoon1.nc")
        self.refuses("bem", "heal", "pontoon1.nc", "-o", "pontoon1.nc")
        self.refuses("bem", "irf", "pontoon1.nc", "--picture", "pontoon1.nc")
        for given in ("box2.1", "box2"):
            self.refuses("bem", "convert", given, *WATER, "-o", "box2.1")
            self.refuses("bem", "convert", given, *WATER, "--format", "froude", "-o", "box2.hst")
        self.refuses("bem", "convert", "box2.1", *WATER, "--format", "wamit", "-o", "box2")

    def test_meshes_and_fitted_records_are_not_replaced(self):
        self.refuses("hydrostatics", "workboat.obj", "--density", "1025 kg/m^3", "--cog", "(0, 0, 0) m", "--picture",
                     "workboat.obj")
        fit = SOURCE / "examples" / "fit"
        shutil.copy(fit / "oscillation.toml", self.folder)
        shutil.copy(fit / "oscillation.csv", self.folder)
        shutil.copy(fit / "batch.toml", self.folder)
        shutil.copytree(fit / "batch", self.folder / "batch")
        for option in ("-o", "--table", "--picture"):
            self.refuses("fit", "oscillation.toml", option, "oscillation.csv", words=(option, "data.files"))
            self.refuses("fit", "oscillation.toml", option, "oscillation.toml", words=(option, "the scene"))
        run = next(path for path in (self.folder / "batch").iterdir() if path.name != "runs.csv")
        for name in ("batch/runs.csv", run):
            self.refuses("fit", "batch.toml", "--table", name, words=("--table",))

    def test_a_scene_that_a_fit_runs_is_not_replaced_nor_what_it_names(self):
        fit = SOURCE / "examples" / "fit"
        for name in ("pendulums.toml", "pendulums.csv", "pendulums_scene.toml"):
            shutil.copy(fit / name, self.folder)
        self.refuses("fit", "pendulums.toml", "-o", "pendulums_scene.toml", words=("model.scene",))

    def test_two_outputs_of_one_name_are_refused(self):
        self.refuses("run", "s.toml", "-o", "x.h5", "--csv", "x.h5", words=("-o", "--csv"))
        self.refuses("psd", "m.csv", "-o", "x.csv", "--picture", "./x.csv")

    def test_a_text_that_is_no_name_of_a_file_is_no_input(self):
        for title in ("long " * 100, "x" * 300 + ".1", ".", "*", "x*"):
            self.write("s.toml", SCENE.replace("schema = 1", f'schema = 1\ntitle = "{title}"'))
            result = self.froude("waves", "make", "s.toml", "-o", "x.h5")
            self.assertEqual(result.returncode, 0, title + result.stderr)

    def test_every_output_is_tried_before_the_work(self):
        self.refuses("run", "s.toml", "-o", "x.h5", "--csv", "none/x.csv", words=("none/x.csv",))

    def test_an_old_result_is_replaced_as_ever(self):
        for _ in range(2):
            self.assertEqual(self.froude("psd", "m.csv", "-o", "x.csv").returncode, 0)
            self.assertEqual(self.froude("bem", "convert", "box2.1", *WATER, "-o", "box2.h5").returncode, 0)

    def test_what_a_killed_process_left_is_swept_and_nothing_else(self):
        killed = subprocess.Popen(["/bin/true"])
        killed.wait()
        host = socket.gethostname()
        left = {f"x.csv.{host}.{killed.pid}.froude.tmp": False, f"x.csv.{host}.{os.getpid()}.froude.tmp": True,
                f"x.csv.elsewhere.{killed.pid}.froude.tmp": True, "mine.froude.tmp": True}
        for name in left:
            self.write(name, "half")
        self.assertEqual(self.froude("psd", "m.csv", "-o", "x.csv").returncode, 0)
        self.assertEqual({name: (self.folder / name).exists() for name in left}, left)

    def test_a_picture_is_what_its_name_says(self):
        for name, begins in (("p.svg", b"<svg"), ("p.png", b"\x89PNG\r\n\x1a\n"), ("p.pdf", b"%PDF-")):
            self.assertEqual(self.froude("psd", "m.csv", "--picture", name).returncode, 0)
            self.assertTrue((self.folder / name).read_bytes().startswith(begins), name)
        width, height = (int(re.search(f' {what}="(\\d+)"', (self.folder / "p.svg").read_text()).group(1))
                         for what in ("width", "height"))
        self.assertEqual(struct.unpack(">II", (self.folder / "p.png").read_bytes()[16:24]), (2 * width, 2 * height))
        for command in (["psd", "m.csv"], ["rao", "s.toml"], ["hydrostatics", "workboat.obj", "--density", "1000 kg/m^3", "--cog",
                                                                "(0, 0, 0) m"]):
            self.refuses(*command, "--picture", "p.jpg", words=('cannot end in ".jpg"', ".svg, .png or .pdf"))

    def test_a_picture_whose_program_is_missing_is_refused_before_the_work(self):
        result = self.froude("run", "s.toml", "-o", "r.h5", "--picture", "p.png", env={"PATH": "/nonexistent"})
        self.assertEqual(result.returncode, 2)
        self.assertIn("install librsvg2-bin", result.stderr)
        self.assertFalse((self.folder / "r.h5").exists())

    def test_a_link_stays_and_its_file_is_replaced(self):
        (self.folder / "there").mkdir()
        (self.folder / "there" / "x.csv").write_text("old")
        (self.folder / "link.csv").symlink_to("there/x.csv")
        self.assertEqual(self.froude("psd", "m.csv", "-o", "link.csv").returncode, 0)
        self.assertTrue((self.folder / "link.csv").is_symlink())
        self.assertIn("wave", (self.folder / "there" / "x.csv").read_text())

    def test_devices_and_fifos_are_written_into(self):
        self.assertEqual(self.froude("psd", "m.csv", "-o", "plain.csv").returncode, 0)
        table = (self.folder / "plain.csv").read_text()
        result = self.froude("--quiet", "psd", "m.csv", "--from", "0 s", "-o", "/dev/stdout")
        self.assertEqual((result.returncode, result.stdout), (2, ""))  # its name tells no format
        (self.folder / "out.csv").symlink_to("/dev/stdout")
        result = self.froude("--quiet", "psd", "m.csv", "-o", "out.csv")
        self.assertEqual((result.returncode, result.stdout), (0, table), result.stderr)
        os.mkfifo(self.folder / "pipe.csv")
        read = []
        reader = threading.Thread(target=lambda: read.append((self.folder / "pipe.csv").read_text()))
        reader.start()
        self.assertEqual(self.froude("psd", "m.csv", "-o", "pipe.csv").returncode, 0)
        reader.join(30)
        self.assertEqual(read, [table])
        self.assertTrue((self.folder / "pipe.csv").is_fifo())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
