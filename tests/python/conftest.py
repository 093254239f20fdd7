"""What the tests of the package share: the program, the examples, and what the program says."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = SOURCE / "examples"


def program(*arguments):
    """Runs froude; its standard output."""
    ran = subprocess.run([os.environ["FROUDE"], *map(str, arguments)], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def table(file):
    """Columns of a CSV of the program by name, without units."""
    with open(file, encoding="utf-8") as lines:
        rows = [line.rstrip("\n").split(",") for line in lines if not line.startswith("#")]
    names = [cell.split(" [")[0] for cell in rows[0]]
    return {name: np.array([float(row[at]) for row in rows[1:]]) for at, name in enumerate(names)}


@pytest.fixture
def examples():
    return EXAMPLES
