"""The scripts of examples/python run whole and cell by cell, as a notebook does, and say what is so."""
import contextlib
import io
import re
import subprocess
import sys

import pytest

from conftest import EXAMPLES, SOURCE

SCRIPTS = sorted((EXAMPLES / "python").glob("*.py"))


def said_in_cells(script, monkeypatch):
    """Output of the cells, which know no file that they stand in."""
    monkeypatch.chdir(SOURCE)
    cells = re.split(r"^# %%", script.read_text(), flags=re.MULTILINE)
    assert cells[0] == "" and cells[1].startswith(" [markdown]")
    out, names = io.StringIO(), {"__name__": "__main__"}
    with contextlib.redirect_stdout(out):
        for cell in cells[1:]:
            if cell.startswith(" [markdown]"):
                assert all(line.startswith("# ") for line in cell.splitlines()[1:] if line)
            else:
                exec(compile(cell, script.name, "exec"), names)
    return out.getvalue()


def numbers(text):
    return [float(n) for n in re.findall(r"-?\d+\.\d+", text)]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_scripts_run(script):
    ran = subprocess.run([sys.executable, str(script)], cwd=SOURCE, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert len(ran.stdout.splitlines()) > 3


def test_coefficients_are_those_of_the_guide(monkeypatch):
    said = said_in_cells(EXAMPLES / "python/coefficients.py", monkeypatch)
    cd, low, high = numbers(re.search(r"^cd = .*", said, re.MULTILINE)[0])
    assert low < cd < high and cd == pytest.approx(1.2185, abs=6e-4)  # of `froude fit`, to the digits that are told


def test_an_array_is_symmetric_in_beam_seas(monkeypatch):
    said = said_in_cells(EXAMPLES / "python/array.py", monkeypatch)
    assert len(re.findall(r"^m\d\.heave: ", said, re.MULTILINE)) == 5
    head, beam = (float(n) for n in re.findall(r"(\d+) N/m in", said))
    assert head > beam > 0  # modules beside one another move alike when waves come across


def test_runs_and_the_linear_answer_have_one_deviation(monkeypatch):
    said = said_in_cells(EXAMPLES / "python/spectra.py", monkeypatch)
    pairs = re.findall(r"^(module\.\w+): (\S+) in runs, (\S+) linear", said, re.MULTILINE)
    assert {name for name, _, _ in pairs} >= {"module.heave", "module.pitch"}
    for name, runs, linear in pairs:
        if name != "module.surge":  # a slow motion, of which 100 s have a few cycles
            assert float(runs) == pytest.approx(float(linear), rel=0.15)  # three records of some 25 waves each


def test_power_grows_with_the_square_of_the_height(monkeypatch):
    said = said_in_cells(EXAMPLES / "python/power.py", monkeypatch)
    rows = {float(row.split()[0]): [float(p) for p in re.findall(r"(\S+) W", row)]
            for row in said.splitlines() if re.match(r" +\d\.\d ", row)}
    assert sorted(rows) == [0.3, 0.8, 1.3, 1.8]
    # A linear float: of the last column, whole watts, 40 W at 0.3 m
    assert rows[1.8][-1] / rows[0.3][-1] == pytest.approx((1.8 / 0.3) ** 2, rel=0.02)
