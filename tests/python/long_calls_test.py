"""Long calls end at Ctrl-C, tell how far they are, and let other threads work."""
import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import froude
from conftest import EXAMPLES

long_run = {"ask.run.duration": "20000 s", "ask.run.every": "1 s"}


@pytest.mark.parametrize("call", [
    "froude.run(froude.read(file, set={'ask.run.duration': '2000000 s', 'ask.run.every': '100 s'}))",
    "[froude.fit(swings) for _ in range(1000)]",
])
def test_ctrl_c_ends_a_call(call, tmp_path):
    script = (f"import froude, sys\nfile = {str(EXAMPLES / 'forced.toml')!r}\n"
              f"swings = {str(EXAMPLES / 'fit/swings.toml')!r}\nprint('begins', flush=True)\n"
              f"try:\n    {call}\nexcept KeyboardInterrupt:\n    sys.exit(7)\n")
    ran = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, cwd=tmp_path)
    assert ran.stdout.readline() == "begins\n"
    time.sleep(1)
    ran.send_signal(signal.SIGINT)
    assert ran.wait(20) == 7
    assert os.listdir(tmp_path) == []


def test_progress_is_told_and_what_it_raises_comes_out():
    scene = froude.read(EXAMPLES / "forced.toml", set=long_run)
    told = []
    froude.run(scene, progress=lambda share, text: told.append((share, text)))
    shares = [share for share, _ in told]
    assert len(shares) > 3 and shares == sorted(shares) and shares[0] >= 0 and shares[-1] <= 1  # runs beside it too
    assert {text for _, text in told} == {"run"}

    def enough(share, text):
        raise ZeroDivisionError("of the caller")

    with pytest.raises(ZeroDivisionError, match="of the caller"):
        froude.run(scene, progress=enough)
    with pytest.raises(TypeError, match="progress is True"):
        froude.run(scene, progress="yes")


def test_a_fit_tells_how_far_its_searches_are():
    told = []
    fit = froude.fit(EXAMPLES / "fit/swings.toml", progress=lambda share, text: told.append((share, text)))
    shares = [share for share, _ in told]
    assert len(shares) > 3 and shares == sorted(shares) and 0 < shares[0] < shares[-1] < 1
    assert {text for _, text in told} == {"fit"}
    plain = froude.fit(EXAMPLES / "fit/swings.toml")
    values = [[(e.name, e.value, e.interval) for e in one.estimates] for one in (plain, fit)]
    assert values[0] and values[0] == values[1]  # whoever watches changes nothing

    def enough(share, text):
        raise ZeroDivisionError("of the caller")

    with pytest.raises(ZeroDivisionError, match="of the caller"):
        froude.fit(EXAMPLES / "fit/swings.toml", progress=enough)


def test_other_threads_work_meanwhile():
    scene = froude.read(EXAMPLES / "forced.toml", set=long_run)
    ran = threading.Thread(target=froude.run, args=(scene,))
    ticks = 0
    ran.start()
    while ran.is_alive():
        ticks += 1
        time.sleep(0.001)
    assert ticks > 20  # of a call that takes longer than 100 ms; none if it held the lock
