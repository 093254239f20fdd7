#!/usr/bin/python3
"""Runs scripts/demo into a folder of its own and looks at what it wrote: files open, numbers are finite and lie where they must.

    results_test.py SOURCE_DIR
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest
import xml.etree.ElementTree

import numpy
import xarray

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
FILES = ["rao.h5", "rao.csv", "rao.svg", "run.h5", "run.svg", "psd.csv", "psd.svg", "fit.toml", "fit.svg"]


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.out = pathlib.Path(folder.name)
        cls.told = subprocess.run([SOURCE / "scripts/demo", cls.out], check=True, capture_output=True, text=True).stdout

    def columns(self, name):
        """The columns of a table by their headers, without the units."""
        with open(self.out / name, encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        values = numpy.array(rows[1:], dtype=float)
        self.assertTrue(numpy.isfinite(values).all(), name)
        return {header.split(" [")[0]: values[:, i] for i, header in enumerate(rows[0])}

    def test_every_file_is_there_and_named_and_the_picture_to_open_first_too(self):
        for name in FILES:
            self.assertGreater((self.out / name).stat().st_size, 0, name)
            self.assertIn(name, self.told)
        self.assertIn(f"Open {self.out}/psd.svg first", self.told)

    def test_a_build_with_reports_makes_one(self):
        report = self.out / "report.html"
        self.assertEqual(report.exists(), "report.html" in self.told)
        if report.exists():
            self.assertLess(report.stat().st_size, 10e6)  # what a report promises
            self.assertIn("<script type=\"application/json\" id=\"data\">", report.read_text(encoding="utf-8"))

    def test_pictures_are_drawings_with_curves(self):
        for name in FILES:
            if name.endswith(".svg"):
                drawing = xml.etree.ElementTree.parse(self.out / name)
                self.assertTrue([e for e in drawing.iter() if e.tag.endswith(("path", "polyline"))], name)

    def test_a_module_follows_long_waves(self):
        rao = self.columns("rao.csv")
        longest = rao["period"].argmax()
        self.assertEqual(rao["period"][longest], 8)
        # A hull that is small beside the wave rides it: heave 1 but for a Smith factor of exp(-k T) = 0.93 at its draught.
        self.assertAlmostEqual(rao["m3.heave amplitude"][longest], 0.96, delta=0.06)
        with xarray.open_dataset(self.out / "rao.h5") as results:
            for name, values in results.items():
                self.assertTrue(numpy.isfinite(values).all(), name)

    def test_the_sea_is_as_high_as_the_scene_says_and_nothing_runs_away(self):
        with xarray.open_dataset(self.out / "run.h5") as run:
            for name, values in run.items():
                if values.dtype.kind == "f":
                    self.assertTrue(numpy.isfinite(values).all(), name)
            after_ramp = run["wave.elevation"].values[600:]
            # 570 s hold some hundred waves: their variance has a standard deviation of about a tenth.
            self.assertAlmostEqual(4 * after_ramp.std(), 1.2, delta=0.18)
            # Near resonance a module heaves more than the waves, but not thrice as much.
            self.assertLess(run["m3.heave"].values.std(), 3 * after_ramp.std())

    def test_the_area_of_a_spectrum_is_the_variance(self):
        psd = self.columns("psd.csv")
        with xarray.open_dataset(self.out / "run.h5") as run:
            variance = run["m3.heave"].values[600:].var()
        area = psd["m3.heave.density"].sum() * (psd["frequency"][1] - psd["frequency"][0])
        # Segments of a tapered record weigh its parts unequally; nine of them do so within some ten percent.
        self.assertAlmostEqual(area / variance, 1, delta=0.15)

    def test_the_fit_finds_coefficients_of_a_cylinder(self):
        fit = tomllib.loads((self.out / "fit.toml").read_text())
        run = fit["run"][0]
        for name in ("cd", "ca"):
            low, high = run[name]["interval"]
            self.assertLess(low, fit["coefficients"][name])
            self.assertLess(fit["coefficients"][name], high)
            self.assertLess(high - low, 0.3 * fit["coefficients"][name])
        # The record was made with C_D = 1.2 and C_A = 1.
        self.assertAlmostEqual(fit["coefficients"]["cd"], 1.2, delta=0.05)
        self.assertAlmostEqual(fit["coefficients"]["ca"], 1.0, delta=0.05)


unittest.main(verbosity=2)
