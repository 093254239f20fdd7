#!/usr/bin/python3
"""Completion by shells and the manual page have every command and every option that `--help` has.

    described_test.py FROUDE SOURCE
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


def said(*words):
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout


COMMON = {"--version", "--json", "--quiet"}  # of the program that a command belongs to


def options_in(text):
    return {name for line in text.splitlines() if re.match(r"  -", line)
            for name in re.findall(r"(?<![\w-])--?[a-z][\w-]*", re.split(r"  +", line.strip())[0])}


def commands(path=()):
    """Each command with its options, as its own help tells them."""
    text = said(*path, "--help")
    yield path, options_in(text)
    listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
    for name in re.findall(r"^  (\w+)", listed[1], re.MULTILINE) if listed else []:
        yield from commands((*path, name))


def completed(script, *words):
    """What bash offers for the last of these words."""
    line = " ".join(f"'{w}'" for w in ("froude", *words))
    ran = subprocess.run(["bash", "-c", f'source "{script}"; COMP_WORDS=({line}); COMP_CWORD={len(words)}; _froude; '
                          'printf "%s\\n" "${COMPREPLY[@]}"'], capture_output=True, text=True, check=True)
    assert ran.stderr == "", ran.stderr
    return ran.stdout.split("\n")[:-1]


class Described(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="froude_described_"))
        cls.bash = cls.folder / "froude.bash"
        cls.bash.write_text(said("completion", "bash"))
        cls.commands = list(commands())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_help_is_read_as_it_is(self):
        known = dict(self.commands)
        self.assertIn("--nondimensional", known[("rao",)])
        self.assertIn("-o", known[("waves", "make")])
        self.assertIn(("bem", "solve"), known)

    def test_programs_of_their_own_tell_the_same(self):
        """froude describes them without starting them; where they are built, their own help has the same options."""
        known = dict(self.commands)
        self.assertIn("--markers", known[("track",)])
        self.assertIn("--reference-curves", known[("validate",)])
        for program, words in (("froude-film", ("track",)), ("froude-film", ("calibrate",)), ("froude-film", ("film",)),
                               ("froude-validate", ())):
            path = words or ("validate",)
            with self.subTest(path):
                if not (PROGRAM.parent / program).exists():
                    self.skipTest(f"{program} is not built")
                own = subprocess.run([PROGRAM.parent / program, *words, "--help"], check=True, capture_output=True,
                                     text=True).stdout
                self.assertEqual(options_in(own) - COMMON, known[path] - COMMON)

    def test_no_library_of_theirs_is_loaded(self):
        """Of OpenCV and MPI froude knows nothing; the help of `track` is there where froude-film is not."""
        needed = subprocess.run(["readelf", "-d", PROGRAM], check=True, capture_output=True, text=True).stdout
        self.assertNotRegex(needed, r"NEEDED.*(opencv|libmpi)")
        alone = self.folder / "alone"
        alone.mkdir()
        shutil.copy(PROGRAM, alone / "froude")
        told = subprocess.run([alone / "froude", "track", "--help"], check=True, capture_output=True, text=True).stdout
        self.assertIn("--roundness", told)
        ran = subprocess.run([alone / "froude", "track", "a.avi", "-m", "a", "-o", "a.csv"], capture_output=True,
                             text=True)
        self.assertEqual(ran.returncode, 2)
        self.assertIn("scripts/setup camera", ran.stderr)

    def test_bash_offers_every_command_and_option(self):
        for path, options in self.commands:
            if path:
                self.assertIn(path[-1], completed(self.bash, *path[:-1], ""))
            self.assertLessEqual({o for o in options if o.startswith("--")}, set(completed(self.bash, *path, "--")))
            self.assertIn("--quiet", completed(self.bash, *path, "--q"))

    def test_bash_offers_values(self):
        self.assertEqual(completed(self.bash, "poincare", "--through", ""), ["up", "down", "both"])
        self.assertEqual(completed(self.bash, "track", "--order", ""), ["left to right", "top to bottom"])
        self.assertEqual(completed(self.bash, "waves", "info", "--phase-of", "k"), ["k x - omega t"])
        scenes = completed(self.bash, "run", f"{SOURCE}/examples/moo")
        self.assertIn(f"{SOURCE}/examples/moored.toml", scenes)
        self.assertEqual(completed(self.bash, "run", "-o", f"{SOURCE}/examples/moo"), scenes)
        self.assertEqual(completed(self.bash, "--json", "rao", "--ref"), ["--refine"])

    def test_zsh_has_every_command_and_option(self):
        script = said("completion", "zsh")
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n"], input=script, text=True, check=True)
        for path, options in self.commands:
            function = re.search(rf"^_froude{''.join('_' + w for w in path)}\(\) {{\n(.*?)\n}}$", script,
                                 re.MULTILINE | re.DOTALL)
            self.assertIsNotNone(function, path)
            for option in options - {"-h", "--help"} if path else options:
                self.assertRegex(function[1], rf"(['{{,]){re.escape(option)}[\[,}}]", (path, option))

    def test_the_manual_has_every_command_and_option(self):
        page = said("man")
        if shutil.which("groff"):
            ran = subprocess.run(["groff", "-k", "-man", "-Tutf8", "-ww", "-P-cbou"], input=page, text=True, check=True,
                                 capture_output=True)
            self.assertEqual(ran.stderr, "")
            page = ran.stdout.replace("‐", "-").replace("−", "-")
        else:
            page = page.replace("\\-", "-")
        for path, options in self.commands:
            self.assertIn(" ".join(("froude", *path)), page)
            for option in options - {"-h", "--help"}:
                self.assertIn(option, page, path)

    def test_another_shell_is_refused(self):
        ran = subprocess.run([PROGRAM, "completion", "fish"], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 2)
        self.assertIn("fish not in {bash,zsh}", ran.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
