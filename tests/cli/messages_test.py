#!/usr/bin/python3
"""What the program says and returns, seen from outside.

    messages_test.py FROUDE SOURCE

Each wrong input is one good scene, or one good data file, with a single fault planted; the test reads the message as a
person would: it must name the place, the offending text, the rule and the remedy. Exit status: 0 done, 1 a check failed,
2 the input is wrong, 3 the numerics gave up.
"""
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from mutants_test import SCENE

FROUDE = Path(sys.argv[1]).resolve()
SOURCE = Path(sys.argv[2]).resolve()


SECOND_BODY = """\
[[body]]
name = "{name}"
position = "(13, 0, 0) m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
"""


def line_of(text, part):
    """The number of the line that holds `part`."""
    return next(i for i, line in enumerate(text.splitlines(), 1) if part in line)


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_cli_"))
        shutil.copy(SOURCE / "examples" / "data" / "pontoon1.nc", self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def froude(self, *arguments, **options):
        return subprocess.run([str(FROUDE), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=300, **options)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def refuses(self, result, *words, status=2):
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(result.stdout, "")

    def refuses_scene(self, old, new, *words, command="run", scene=SCENE):
        """The scene with `old` replaced by `new` is refused at the last line of `new`."""
        self.assertIn(old, scene)
        text = scene.replace(old, new, 1)
        self.write("scene.toml", text)
        result = self.froude(command, "scene.toml", "-o", "result.h5")
        self.refuses(result, f"scene.toml:{line_of(text, new.splitlines()[-1])}:", *words)
        self.assertEqual(self.leftovers(), {"pontoon1.nc", "scene.toml"})

    def leftovers(self):
        return {path.name for path in self.folder.iterdir()}


class Success(CommandLine):
    def test_run_and_rao_write_their_result_and_nothing_else(self):
        self.write("scene.toml", SCENE)
        for command in ("run", "rao"):
            result = self.froude(command, "scene.toml", "-o", f"{command}.h5")
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.leftovers(), {"pontoon1.nc", "scene.toml", "run.h5", "rao.h5"})

    def test_modes_are_written_as_told(self):
        self.write("scene.toml", SCENE.replace("rao =", 'modes = { longest = "60 s" }\nrao ='))
        result = self.froude("--json", "modes", "scene.toml", "-o", "modes.h5", "--csv", "modes.csv", "--picture", "modes.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        told = json.loads(result.stdout)["modes"]
        rows = [line for line in (self.folder / "modes.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(len(told), len(rows) - 1)
        omega = [mode["omega_rad_per_s"] for mode in told]
        self.assertEqual(omega, sorted(omega))
        for mode, row in zip(told, rows[1:]):
            self.assertAlmostEqual(2 * math.pi / float(row.split(",")[0]), mode["omega_rad_per_s"], places=12)

    def test_modes_that_cannot_be_are_refused(self):
        self.write("scene.toml", SCENE.replace("rao =", 'modes = { longest = "2 s", shortest = "3 s" }\nrao ='))
        self.refuses(self.froude("modes", "scene.toml", "-o", "modes.h5"), "scene.toml", "longer than the shortest")
        self.write("scene.toml", SCENE.replace("rao =", 'modes = { longest = "0.01 s" }\nrao ='))
        self.refuses(self.froude("modes", "scene.toml", "-o", "modes.h5"), "of 6 free motions none", "0.01")
        self.write("scene.toml", SCENE)
        self.refuses(self.froude("modes", "scene.toml", "-o", "modes.h5"), "modes = {")

    def test_quiet_prints_nothing(self):
        self.write("scene.toml", SCENE)
        result = self.froude("run", "scene.toml", "-o", "run.h5", "--quiet")
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)

    def test_json_is_one_document(self):
        self.write("scene.toml", SCENE)
        for command in (["rao", "scene.toml", "-o", "rao.h5"], ["plan", "scene.toml"], ["bem", "info", "pontoon1.nc"]):
            result = self.froude("--json", *command)
            self.assertEqual(result.returncode, 0, result.stderr)
            json.loads(result.stdout)

    def test_help_shows_an_example_of_every_command(self):
        for command in (["new"], ["bem", "info"], ["bem", "convert"], ["bem", "check"], ["rao"], ["modes"], ["run"], ["psd"], ["prepare"], ["poincare"], ["trajectory"], ["snapshot"], ["response"], ["fatigue"], ["extremes"], ["fit"], ["plan"], ["cost"]):
            result = self.froude(*command, "-h")
            self.assertEqual(result.returncode, 0)
            self.assertIn("froude " + " ".join(command) + " ", result.stdout.split("Example")[1])

    def test_version(self):
        self.assertRegex(self.froude("--version").stdout, r"^froude \d+\.\d+\.\d+\n$")

    def test_a_scene_in_another_folder_finds_its_data(self):
        (self.folder / "there").mkdir()
        self.write("there/scene.toml", SCENE.replace("pontoon1.nc", "../pontoon1.nc"))
        self.assertEqual(self.froude("rao", "there/scene.toml", "-o", "rao.h5").returncode, 0)


class Headings(CommandLine):
    """Responses to waves of several headings: the same numbers in every form, and those of one heading by itself."""

    def rao(self, heading, *options):
        self.write("scene.toml", SCENE.replace("rao = {", f"rao = {{ {heading},"))
        result = self.froude("rao", "scene.toml", "-o", "rao.h5", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_json_has_a_list_for_each(self):
        several = json.loads(self.rao('headings = ["90 deg", "0 deg"]', "--json"))
        self.assertEqual([round(math.degrees(h), 9) for h in several["heading_rad"]], [90, 0])
        for number, heading in enumerate(("90 deg", "0 deg")):
            one = json.loads(self.rao(f'heading = "{heading}"', "--json"))
            self.assertNotIn("heading_rad", one)
            for name, signal in one["signals"].items():
                both = several["signals"][name]
                self.assertEqual(len(both["amplitude"]), 2)
                size = max(map(max, both["amplitude"]))  # surge in beam waves is nothing but rounding
                for got, alone in zip(both["amplitude"][number], signal["amplitude"], strict=True):
                    self.assertAlmostEqual(got, alone, delta=1e-11 * size)
                self.assertEqual(len(both["phase_rad"][number]), len(signal["phase_rad"]))

    def test_a_list_of_one_is_one_heading(self):
        one, listed = (json.loads(self.rao(heading, "--json")) for heading in ('heading = "45 deg"', 'headings = ["45 deg"]'))
        for told in (one, listed):
            self.assertGreater(told.pop("time")["whole_s"], 0)  # no two answers take as long
        self.assertEqual(one, listed)

    def test_the_table_has_a_row_and_the_csv_rows_for_each(self):
        told = self.rao('headings = "0 deg .. 90 deg, 4 values"', "--csv", "rao.csv", "--picture", "rao.svg")
        self.assertIn("2 signals at 6 frequencies and 4 headings", told)
        rows = [line.split() for line in told.splitlines() if line.startswith("m.")]
        self.assertEqual([row[:2] for row in rows], [[name, angle] for name in ("m.surge", "m.heave") for angle in ("0", "30", "60", "90")])
        lines = [line for line in (self.folder / "rao.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertTrue(lines[0].startswith("heading [deg],omega [rad/s],period [s],m.surge amplitude [m/m],"), lines[0])
        self.assertEqual([round(float(line.split(",")[0]), 9) for line in lines[1:]], [h for h in (0, 30, 60, 90) for _ in range(6)])
        self.assertEqual(len({line.split(",")[1] for line in lines[1:]}), 6)
        picture = (self.folder / "rao.svg").read_text()
        for part in ("m.surge", "m.heave", "30 deg", "90 deg"):
            self.assertIn(part, picture)

    def test_one_heading_is_told_as_ever(self):
        told = self.rao('heading = "0 deg"', "--csv", "rao.csv")
        self.assertIn("2 signals at 6 frequencies, periods 3 to 8 s", told)
        self.assertNotIn("heading", told)
        lines = (self.folder / "rao.csv").read_text().splitlines()
        self.assertIn("# heading = 0 deg", lines)
        self.assertNotIn("heading", [line for line in lines if not line.startswith("#")][0])

    def test_the_plan_says_who_shares_factors(self):
        self.write("scene.toml", SCENE.replace("rao = {", 'rao = { headings = "0 deg .. 90 deg, 4 values",'))
        told = self.froude("plan", "scene.toml").stdout
        self.assertIn("6 frequencies, 4 headings, 6 unknowns", told)
        self.assertIn("one factorisation at each frequency serves all", told)

    def test_headings_that_cannot_be_are_refused_where_they_stand(self):
        def refuses(value, *words):
            self.refuses_scene("rao = {", f"rao = {{ headings = {value},", *words, command="rao")

        refuses("[]", "headings = [] is empty", "write at least one")
        refuses('["0 deg", "0 deg"]', "stands twice", "keep one")
        refuses('["0 deg", "30"]', "has no unit", "an angle is needed")
        refuses('"0 deg .. 180 deg, 13 values"', "heading 105 deg is asked for", "from 0 to 90 deg", "--symmetric")
        text = SCENE.replace("rao = {", 'rao = { headings = ["0 deg", "90 deg"],').replace("excitation = true\n", "")
        self.write("scene.toml", text)
        self.refuses(self.froude("rao", "scene.toml", "-o", "result.h5"), "scene.toml:", "no body names excitation", "add excitation = true")


class PartOfARecord(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("table.csv", "time [s], force [N]\n" + "".join(f"{0.1 * i:.1f}, {math.sin(0.3 * i):.6f}\n" for i in range(1000)))

    def test_is_what_psd_analyses(self):
        told = self.froude("psd", "table.csv", "--from", "20 s", "--to", "1 min", "--segment", "10 s")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("401 samples", told.stdout)
        self.assertIn("--to", self.froude("psd", "--help").stdout)

    def test_that_is_none_is_refused(self):
        def refuses(options, *words):
            self.refuses(self.froude("psd", "table.csv", *options), *words)

        refuses(["--from", "20 s", "--to", "10 s"], "command line", "--to 10 s is not after --from 20 s", "exchange the two")
        refuses(["--to", "100 s"], "table.csv", "the record ends at 99.9 s, before --to 100 s", "leave --to out")
        refuses(["--to", "60"], "--to: error", "has no unit; a time is needed")
        refuses(["--from", "200 s"], "table.csv", "the record ends at 99.9 s, before --from 200 s", "leave --from out")


class StepsBeforeASpectrum(CommandLine):
    def setUp(self):
        super().setUp()
        rows = "".join(f"{0.1 * i:.1f}, {math.sin(0.25 * i) + 0.002 * i + (5 if i == 700 else 0):.6f}\n"
                       for i in range(3000) if i not in (1500, 1501))
        self.write("table.csv", "time [s], force [N]\n" + rows)

    def test_are_done_in_order_and_told(self):
        told = self.froude("psd", "table.csv", "--gaps", "0.5 s", "--outliers", "1 s", "--detrend", "--wave-frequency", "2.5 rad/s",
                           "--segment", "30 s")
        self.assertEqual(told.returncode, 0, told.stderr)
        places = [told.stdout.find(words) for words in (
            "gaps: 2 of 3000 samples were missing", "outliers: 1 of 3000 samples of force", "trend: force changes by",
            "band-pass from 0.07958 Hz to 1.592 Hz", "prepared: steady from", "resolution")]
        self.assertEqual(places, sorted(places))
        self.assertGreater(places[0], -1, told.stdout)
        self.assertEqual(told.stdout, self.froude("psd", "table.csv", "--longest-gap", "0.5 s", "--outliers", "1 s", "--detrend",
                                                  "--band-pass", "0.5 rad/s, 10 rad/s", "--segment", "30 s").stdout)

    def test_that_cannot_be_done_are_refused_with_the_remedy(self):
        def refuses(options, *words):
            result = self.froude("psd", "table.csv", *options, "-o", "out.csv")
            self.refuses(result, *words)
            self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
            self.assertFalse((self.folder / "out.csv").exists())

        refuses(["--detrend"], "table.csv: error: 0.3 s are missing after 149.9 s", "a longest gap of 0.3 s bridges it")
        refuses(["--gaps", "0.2 s"], "0.3 s are missing after 149.9 s; gaps may be 0.2 s long")
        refuses(["--gaps", "0.2"], "--longest-gap: error", "has no unit; a time is needed")
        refuses(["--gaps=-1 s"], "--longest-gap: error", '"-1 s" must be positive', 'for example "0.5 s"')
        ready = ["--gaps", "0.5 s"]
        refuses(ready + ["--outliers", "0.1 s"], "table.csv: error", "must be 0.4003 s at least", "ten samples")
        refuses(ready + ["--outliers", "1 m"], "--outliers: error", "is a length")
        refuses(ready + ["--outliers", "1 s", "--outlier-deviations", "2"], "--outlier-deviations: error", "3 at least")
        refuses(ready + ["--outlier-deviations", "5"], "does not act without --outliers", "add --outliers")
        refuses(ready + ["--band-pass", "0.05 Hz"], "--band-pass: error", '"0.05 Hz" is not two frequencies', "0.05 Hz, 0.5 Hz")
        refuses(ready + ["--band-pass", "0.05 Hz, 8 s"], "--band-pass: error", "is a time")
        refuses(ready + ["--band-pass", "0.05, 0.5 Hz"], "--band-pass: error", "has no unit")
        refuses(ready + ["--band-pass", "0.5 Hz, 0.05 Hz"], "--band-pass: error", '"0.5 Hz, 0.05 Hz"', "exchange the two")
        refuses(ready + ["--band-pass", "0 Hz, 0.05 Hz"], "--band-pass: error", "must be positive")
        refuses(ready + ["--band-pass", "0.05 Hz, 5 Hz"], "--band-pass: error", "half the sampling rate, 5 Hz; got 5",
                "more samples a second")
        refuses(ready + ["--band-pass", "0.01 Hz, 0.5 Hz"], "table.csv: error", "the record is 299.9 s long", "nothing would be left",
                "raise the lower edge")
        refuses(ready + ["--wave-frequency", "8 s"], "--wave-frequency: error", "is a time")
        refuses(ready + ["--wave-frequency", "2 Hz"], "--wave-frequency: error", "half the sampling rate", "got 8")
        refuses(ready + ["--wave-frequency", "1 rad/s", "--band-pass", "0.1 Hz, 1 Hz"], "names another", "leave out one")
        refuses(ready + ["--notch", "1 Hz, 2 Hz"], "--notch: error", "must lie between 0 and its centre")
        refuses(ready + ["--low-pass", "9 Hz"], "--low-pass: error", "half the sampling rate")
        refuses(ready + ["--resample", "0 Hz"], "--resample: error", "must be positive")
        refuses(ready + ["--resample", "2 kHz"], "table.csv: error", "more than 100 times that of the record")
        refuses(ready + ["--uneven"], "--uneven takes it as it is", "leave out --uneven, or the steps")
        band = ready + ["--wave-frequency", "1 rad/s"]
        refuses(band + ["--to", "290 s"], "table.csv: error", "the steps leave", "and --to is 290 s", "give an earlier end")
        refuses(band + ["--to", "50 s"], "table.csv: error", "lies outside what is left of the record")
        refuses(band + ["--from", "1000 s"], "the record ends at 299.9 s, before --from 1000 s")

    def test_of_signals_that_never_change_are_refused(self):
        self.write("still.csv", "time [s], force [N]\n" + "".join(f"{0.1 * i:.1f}, 3\n" for i in range(1000)))
        self.refuses(self.froude("psd", "still.csv", "--detrend"), "still.csv: error", "no signal changes", "leave the steps out")


class KeptFits(CommandLine):
    def planned(self, **environment):
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.folder / "cache"), "FROUDE_CACHE": "on", **environment}
        self.write("scene.toml", SCENE)
        return self.froude("plan", "scene.toml", env=environment)

    def kept(self):
        return sorted((self.folder / "cache").rglob("*.fit"))

    def test_serve_the_next_start_of_the_program(self):
        first, second = self.planned(), self.planned()
        self.assertEqual((first.returncode, second.returncode), (0, 0), first.stderr + second.stderr)
        self.assertEqual(len(self.kept()), 1)
        note = [line for line in second.stdout.splitlines() if "were fitted to these data before" in line]
        self.assertEqual(len(note), 1, second.stdout)
        self.assertIn(f"kept in {self.folder}/cache/froude; FROUDE_CACHE=off fits anew", note[0])
        self.assertEqual([line for line in second.stdout.splitlines() if line not in note], first.stdout.splitlines())
        self.kept()[0].write_bytes(b"spoilt")
        self.assertEqual(self.planned().stdout, first.stdout)
        self.assertEqual(self.planned().stdout, second.stdout)

    def test_can_be_switched_off(self):
        told = self.planned(FROUDE_CACHE="off")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual(self.kept(), [])
        self.refuses(self.planned(FROUDE_CACHE="of"), "FROUDE_CACHE=of", '"on" nor "off"')


class WrongCommandLine(CommandLine):
    def test_an_unknown_command_with_the_nearest_one(self):
        self.refuses(self.froude("rum", "scene.toml"), '"rum"', '"run"', "froude --help")
        self.refuses(self.froude("bem", "chek"), '"chek"', '"check"', "froude bem --help")

    def test_no_command(self):
        self.refuses(self.froude(), "--help")

    def test_help_is_a_word_too(self):
        for words in ((), ("run",), ("bem", "solve")):
            self.assertEqual(self.froude("help", *words).stdout, self.froude(*words, "--help").stdout)

    def test_an_unknown_option_names_the_help_of_its_command(self):
        self.refuses(self.froude("run", "scene.toml", "--fast"), "--fast", "froude run --help")

    def test_an_option_without_unit(self):
        self.refuses(self.froude("bem", "info", "pontoon1.nc", "--density", "1025"), "--density", "kg/m^3")

    def test_an_experiment_that_cannot_be(self):
        waves = {"--period": "1.6 s", "--height": "0.06 m", "--depth": "1.25 m", "--gauge": "20 m", "--body": "23 m"}
        for option, value in (("--ramp", "-1 s"), ("--settle", "-1"), ("--period", "1e200 s"), ("--height", "-1 m"),
                              ("--depth", "0 m"), ("--depth", "1e-320 m"), ("--gauge", "-1 m")):
            given = {**waves, option: value}
            result = self.froude("experiment", "waves", *(part for both in given.items() for part in both))
            self.refuses(result, value.split()[0] if "e" not in value else "between 1e-30 and 1e30")
        deep = {**waves, "--depth": "infinite"}
        result = self.froude("experiment", "waves", *(part for both in deep.items() for part in both))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("deep water (kh infinite)", result.stdout)
        swing = {"--diameter": "0.12 m", "--kc": "20", "--period": "4 s", "--viscosity": "1.05e-6 m^2/s", "--width": "0.05",
                 "--noise": "2 N", "--length": "0.5 m", "--density": "997 kg/m^3"}
        for option, value in (("--diameter", "0 m"), ("--period", "-4 s"), ("--kc", "0"), ("--width", "0"),
                              ("--noise", "1e200 N"), ("--mass", "1e200 kg")):
            given = {**swing, option: value}
            result = self.froude("experiment", "oscillation", *(part for both in given.items() for part in both))
            self.assertEqual(result.returncode, 2, option + result.stdout)
            self.assertNotIn("nan", result.stderr)

    def test_an_option_of_wrong_dimension(self):
        self.refuses(self.froude("bem", "info", "pontoon1.nc", "--depth", "14 s"), "--depth", "a length")


class WrongScene(CommandLine):
    def test_a_missing_scene(self):
        self.refuses(self.froude("run", "none.toml"), "none.toml", "No such file")

    def test_an_error_as_json_for_programs(self):
        text = SCENE.replace('"9088 kg"', '"9088 m"')
        self.write("scene.toml", text)
        result = self.froude("run", "scene.toml", "-o", "result.h5", "--json")
        self.assertEqual(result.returncode, 2)
        error = json.loads(result.stdout)["error"]
        self.assertEqual(set(error), {"rule", "file", "line", "column", "text", "remedy"})
        self.assertEqual(Path(error["file"]).name, "scene.toml")
        self.assertEqual(error["line"], line_of(text, "9088 m"))
        self.assertEqual(error["text"], 'mass = "9088 m"')
        self.assertGreater(error["column"], 0)

    def test_text_that_is_no_toml(self):
        self.refuses_scene('depth = "14 m"', 'depth = "14 m')

    def test_an_unknown_key_with_the_nearest_known_one(self):
        self.refuses_scene("mass =", "mas =", '"mas"', "mass")

    def test_an_unknown_table(self):
        self.refuses_scene("[water]", "[watr]", "watr", "water")

    def test_a_missing_unit(self):
        self.refuses_scene('"9088 kg"', '"9088"', "mass", "has no unit", "write it like")

    def test_a_bare_number(self):
        self.refuses_scene('"9088 kg"', "9088", "mass", "kg")

    def test_a_unit_of_the_wrong_dimension(self):
        self.refuses_scene('"9088 kg"', '"9088 m"', "a length", "a mass")

    def test_an_unknown_unit(self):
        self.refuses_scene('"9088 kg"', '"9088 kgg"', "kgg")

    def test_a_negative_mass(self):
        self.refuses_scene('"9088 kg"', '"-9088 kg"', "mass", "positive")

    def test_an_infinite_mass(self):
        self.refuses_scene('"9088 kg"', '"inf kg"', "mass")

    def test_a_negative_radius_of_gyration(self):
        self.refuses_scene('radii_of_gyration = "(4.6, 4.6, 6.4) m"', 'radii_of_gyration = "(4.6, -4.6, 6.4) m"', "positive")

    def test_an_inertia_that_is_not_positive_definite(self):
        self.refuses_scene('radii_of_gyration = "(4.6, 4.6, 6.4) m"',
                           'inertia = "(1, 1, 1) kg m^2"\nproducts_of_inertia = "(2, 0, 0) kg m^2"',
                           "principal moment of inertia of -1 kg m^2")

    def test_two_bodies_of_one_name(self):
        text = SCENE.replace("[[mooring]]", SECOND_BODY.format(name="m") + "[[mooring]]")
        self.write("scene.toml", text)
        self.refuses(self.froude("run", "scene.toml", "-o", "result.h5"), "scene.toml:", "m", "name")

    def test_a_connector_to_a_body_that_does_not_exist(self):
        connector = '[[connector]]\nbetween = ["m", "n"]\nends = ["(6, 0, 0) m", "(-6, 0, 0) m"]\nkind = "axial"\nstiffness = "1 kN/m"\n'
        text = SCENE.replace("[ask]", connector + "[ask]")
        self.write("scene.toml", text)
        self.refuses(self.froude("run", "scene.toml", "-o", "result.h5"), f"scene.toml:{line_of(text, 'between')}:", '"n"')

    def test_a_step_of_zero_or_less(self):
        for step in ("0 s", "-0.1 s"):
            text = SCENE + f'[solve]\nstep = "{step}"\n'
            self.write("scene.toml", text)
            self.refuses(self.froude("run", "scene.toml", "-o", "result.h5"), f"scene.toml:{line_of(text, 'step =')}:", "step", "positive")

    def test_a_duration_that_is_no_multiple_of_the_samples(self):
        self.refuses_scene('duration = "10 s"', 'duration = "10.05 s"', "duration", "every")

    def test_a_result_that_is_not_asked_for(self):
        self.write("scene.toml", SCENE.replace("rao =", "# rao ="))
        self.refuses(self.froude("rao", "scene.toml", "-o", "result.h5"), "rao")


class WrongData(CommandLine):
    def test_a_missing_data_file(self):
        self.refuses_scene('"pontoon1.nc"', '"pontoon9.nc"', "pontoon9.nc", "no such file")

    def test_a_data_file_cut_short(self):
        whole = (self.folder / "pontoon1.nc").read_bytes()
        (self.folder / "pontoon1.nc").write_bytes(whole[:len(whole) // 2])
        self.refuses(self.froude("bem", "info", "pontoon1.nc"), "pontoon1.nc")
        self.write("scene.toml", SCENE)
        self.refuses(self.froude("run", "scene.toml", "-o", "result.h5"), "pontoon1.nc")

    def test_a_file_that_is_no_data_file(self):
        self.write("noise.nc", "this is no table of coefficients\n")
        self.refuses(self.froude("bem", "info", "noise.nc"), "noise.nc")

    def test_a_body_that_the_data_do_not_hold(self):
        self.refuses_scene('file = "pontoon1.nc"', 'file = "pontoon1.nc"\nbody = 2', "body 2", "holds one body")

    def edit_data(self, change):
        import netCDF4
        with netCDF4.Dataset(self.folder / "pontoon1.nc", "a") as data:
            data.set_auto_mask(False)
            change(data)

    def test_a_frequency_given_twice(self):
        def repeat(data):
            data["omega"][3] = data["omega"][2]
        self.edit_data(repeat)
        self.refuses(self.froude("bem", "info", "pontoon1.nc"), "pontoon1.nc", "is there twice")

    def test_a_coefficient_that_is_not_a_number(self):
        def spoil(data):
            data["added_mass"][2, 0, 0] = float("nan")
        self.edit_data(spoil)
        self.refuses(self.froude("bem", "info", "pontoon1.nc"), "pontoon1.nc", "added_mass")

    def test_a_table_with_a_value_that_is_not_a_number(self):
        self.write("table.csv", "time [s], force [N]\n0, 1\n0.1, nan\n0.2, 3\n")
        self.refuses(self.froude("psd", "table.csv"), "table.csv:3:")

    def test_a_table_whose_time_goes_back(self):
        self.write("table.csv", "time [s], force [N]\n" + "".join(f"{t}, 1\n" for t in (0, 0.1, 0.2, 0.15, 0.4)))
        self.refuses(self.froude("psd", "table.csv"), "table.csv", "time does not rise", "0.15 s")

    def test_a_signal_that_is_not_there_with_the_nearest_one(self):
        self.write("table.csv", "time [s], force [N]\n" + "".join(f"{0.1 * i:.1f}, {i % 3}\n" for i in range(100)))
        self.refuses(self.froude("psd", "table.csv", "--signal", "forse"), "forse", "force")


class WrongPlaceToWrite(CommandLine):
    def test_a_folder_that_does_not_exist(self):
        self.write("scene.toml", SCENE)
        self.refuses(self.froude("run", "scene.toml", "-o", "absent/result.h5"), "absent/result.h5", "No such file or directory")

    def test_a_folder_that_is_a_file(self):
        self.write("scene.toml", SCENE)
        self.refuses(self.froude("run", "scene.toml", "-o", "scene.toml/result.h5"), "scene.toml/result.h5", "Not a directory")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_folder_without_permission(self):
        self.write("scene.toml", SCENE)
        (self.folder / "locked").mkdir(mode=0o555)
        self.refuses(self.froude("run", "scene.toml", "-o", "locked/result.h5"), "locked/result.h5", "Permission denied")

    def test_a_full_disk_leaves_nothing_behind(self):
        """A limit on the size of files stands for the full disk: write() fails in the middle in the same way."""
        self.write("scene.toml", SCENE)
        result = self.froude("run", "scene.toml", "-o", "result.h5",
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.refuses(result, "result.h5", "File too large", "nothing was left behind")
        self.assertEqual(self.leftovers(), {"pontoon1.nc", "scene.toml"})

    def test_a_full_disk_keeps_the_older_result(self):
        self.write("scene.toml", SCENE)
        self.write("result.h5", "an older result")
        self.froude("run", "scene.toml", "-o", "result.h5",
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertEqual((self.folder / "result.h5").read_text(), "an older result")

    def test_a_full_standard_output(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run([str(FROUDE), "bem", "info", "pontoon1.nc"], cwd=self.folder, stdout=full,
                                    stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, 2)
        self.assertIn("standard output", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
