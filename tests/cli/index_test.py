"""The index of examples is followed as it stands: each command runs. Usage: index_test.py FROUDE SOURCE

Where froude-film is not built beside froude, examples of films are not followed. FROUDE_FOLLOWED=6 follows one example in
six, by lot, others after each commit: all are two minutes of a core, and cli.examples answers the scenes too.
"""
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from documents import commands_of

FROUDE, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
HAS_FILMS = (FROUDE.parent / "froude-film").exists()
OTHERS_RUN = {"hull.toml", "row.toml"}  # half a minute each, and cli.examples answers them
PLANNED = {"sweep/rows.toml", "sweep/tongue.toml"}  # hundreds of runs: that their cases can be made is enough here
# What one of these writes another reads: all are followed, or none.
TOGETHER = ({"fit/swings.toml", "fit/held_back.toml"},)
NEEDS_FILMS = {"film/film.toml", "film/fit.toml", "film/arms_film.toml", "film/arms_fit.toml", "film/tags.toml"}


def by_lot(examples):
    """One in so many of these, and all where git tells no commit."""
    parts = int(os.environ.get("FROUDE_FOLLOWED", "1"))
    head = subprocess.run(["git", "-C", str(SOURCE), "rev-parse", "HEAD"], capture_output=True, text=True, check=False).stdout.strip()
    drawn = {name for name in examples if int(hashlib.sha256((head + name).encode()).hexdigest(), 16) % parts == 0}
    for group in (*TOGETHER, NEEDS_FILMS):
        drawn |= group if group & drawn else set()
    return set(examples) if parts == 1 or not head else drawn


def sections():
    """The example of each section of the page, with its commands."""
    text = (SOURCE / "docs" / "examples.md").read_text(encoding="utf-8")
    for section in re.split(r"(?m)^### ", text)[1:]:
        yield re.match(r"\[([^\]]+)\]", section).group(1), [command.words for command in commands_of(section)]


class Index(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="froude_index_"))
        shutil.copytree(SOURCE / "examples", self.folder / "examples")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_commands_run_as_they_stand_there(self):
        page = dict(sections())
        self.assertGreaterEqual(len(page), 100)
        chosen = by_lot(page)
        print(f"{len(chosen)} of {len(page)} examples are followed")
        for example, commands in page.items():
            if example not in chosen or example in OTHERS_RUN or (example in NEEDS_FILMS and not HAS_FILMS):
                continue
            for command in commands:
                with self.subTest(example=example, command=command):
                    planned = ["--plan"] if example in PLANNED else []
                    done = subprocess.run([str(FROUDE), *command[1:], *planned], cwd=self.folder, capture_output=True,
                                          text=True, timeout=300, check=False)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    if "--picture" in command:
                        self.assertTrue((self.folder / command[command.index("--picture") + 1]).exists())

    def test_exceptions_stand_on_the_page(self):
        self.assertLessEqual(OTHERS_RUN | PLANNED | NEEDS_FILMS, {example for example, _ in sections()})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
