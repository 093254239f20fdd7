"""Each call gives what the program gives, number for number."""
import json
import math

import numpy as np
import pytest

import froude
from conftest import program, table

# A CSV has 17 digits, and a unit that is divided out and put in again: rounding of the last.
SAME = dict(rtol=1e-14, atol=0)

# A mass on a spring in no water, let go from 0.1 m: omega = sqrt(k/m) = 2 rad/s.
SPRING = """schema = 1
[water]
density = "1000 kg/m^3"
depth = "20 m"
[[body]]
name = "m"
mass = "2 kg"
free = ["surge"]
initial = { surge = "0.1 m" }
[[mooring]]
on = "m"
kind = "linear"
stiffness = { surge = "8 N/m" }
"""


def test_modes(examples, tmp_path):
    program("modes", examples / "modes.toml", "-o", tmp_path / "m.h5", "--csv", tmp_path / "m.csv")
    modes, said = froude.modes(examples / "modes.toml"), table(tmp_path / "m.csv")
    np.testing.assert_allclose(modes.period, said["period"], **SAME)
    np.testing.assert_allclose(modes.omega, said["omega"], **SAME)
    np.testing.assert_allclose(modes.damped_period, said["damped period"], **SAME)
    np.testing.assert_allclose(modes.damping_ratio, said["damping ratio"], **SAME)
    for at, motion in enumerate(modes.motions):
        np.testing.assert_allclose(modes.shape[:, at], said[motion], **SAME)


def test_plan(examples):
    assert str(froude.plan(examples / "moored.toml")).strip() == program("plan", examples / "moored.toml").strip()


def test_export(tmp_path):
    (tmp_path / "spring.toml").write_text(SPRING + "[ask]\nrun = { duration = \"3 s\", every = \"0.1 s\" }\n")
    run = froude.run(tmp_path / "spring.toml")
    run.write(tmp_path / "run.h5")
    told, = froude.export(tmp_path / "run.h5", tmp_path / "run.csv", signals="m.surge", start="1 s", every="0.5 s")
    assert told["written"] == [str(tmp_path / "run.csv")]
    said = table(tmp_path / "run.csv")
    assert list(said) == ["time", "m.surge"]
    np.testing.assert_allclose(said["time"], [1, 1.5, 2, 2.5, 3], **SAME)
    np.testing.assert_array_equal(said["m.surge"], run["m.surge"][10::5])
    froude.export([tmp_path / "run.h5"], tmp_path / "for_matlab", form="matlab")
    assert (tmp_path / "for_matlab" / "run.mat").read_bytes()[:10] == b"MATLAB 7.3"
    told, = froude.export(tmp_path / "run.h5", tmp_path / "run.pvd", every="1 s")
    assert told["instants"] == 4 and (tmp_path / "run.pvd").exists()
    with pytest.raises(froude.InputError, match="ends in none of"):
        froude.export(tmp_path / "run.h5", tmp_path / "run.xlsx")
    with pytest.raises(ValueError, match="form is csv, matlab or vtk"):
        froude.export(tmp_path / "run.h5", tmp_path / "folder", form="pdf")


def test_waves(examples, tmp_path):
    scene = examples / "waves/storm.toml"
    program("waves", "make", scene, "-o", tmp_path / "w.h5", "--csv", tmp_path / "w.csv")
    water, said = froude.waves(scene), table(tmp_path / "w.csv")
    np.testing.assert_allclose(water.time, said["time"], **SAME)
    for name in water.signals:
        np.testing.assert_allclose(water[name], said[name], **SAME)


def test_response(examples, tmp_path):
    program("response", examples / "seastate.toml", "-o", tmp_path / "r.csv")
    spectra, said = froude.response(examples / "seastate.toml"), table(tmp_path / "r.csv")
    for name in spectra.signals:
        np.testing.assert_allclose(spectra[name].frequency, said["frequency"], **SAME)
        np.testing.assert_allclose(spectra[name].density, said[name], **SAME)
    told = json.loads(program("--json", "response", examples / "seastate.toml"))["signals"]
    assert spectra["float.heave"].standard_deviation == told["float.heave"]["standard_deviation"]


def test_fit(examples):
    fit = froude.fit(examples / "fit/oscillation.toml")
    told = json.loads(program("--json", "fit", examples / "fit/oscillation.toml"))["run"][0]
    for name in ("cd", "ca", "cm"):
        assert fit[name].value == told[name]["value"]
        assert list(fit[name].interval) == told[name]["interval"]
    with pytest.raises(KeyError, match="cx"):
        fit["cx"]


def test_a_psd_of_a_run_is_that_of_its_file(examples, tmp_path):
    run = froude.run(examples / "forced.toml")
    run.write(tmp_path / "run.h5")
    program("psd", tmp_path / "run.h5", "-o", tmp_path / "s.csv")
    said = table(tmp_path / "s.csv")
    for record in (run, tmp_path / "run.h5", {"time": run.time, **{name: run[name] for name in run.signals}}):
        spectra = froude.psd(record)
        for name in spectra.signals:
            np.testing.assert_allclose(spectra[name].frequency, said["frequency"], **SAME)
            np.testing.assert_allclose(spectra[name].density, said[name + ".density"], rtol=1e-12)


def test_what_is_no_record_no_result_and_no_name_is_refused_in_words(examples, tmp_path):
    time = np.linspace(0, 10, 101)
    with pytest.raises(ValueError, match=r'"x" has the shape \(101, 2\)'):
        froude.psd({"time": time, "x": np.zeros((101, 2))})
    with pytest.raises(ValueError, match='"x" has the shape .* complex128'):
        froude.psd({"time": time, "x": np.exp(1j * time)})
    masked = np.ma.masked_where(np.abs(np.sin(time)) > 0.9, np.sin(time))
    with pytest.raises(ValueError, match='samples of "x" are masked.*time\\[~mask\\]'):
        froude.psd({"time": time, "x": masked})
    with pytest.raises(ValueError, match="one result at least"):
        froude.export([], tmp_path / "out.csv")
    with pytest.raises(froude.InputError, match="cannot end in"):
        froude.run(examples / "forced.toml").write(tmp_path / "run.csv")


def test_a_sweep_is_kept_and_goes_on(tmp_path):
    (tmp_path / "scene.toml").write_text(SPRING + "[ask]\nmodes = {}\n")
    (tmp_path / "study.toml").write_text("""schema = 1
scene = "scene.toml"
[[axis]]
name = "mass"
key = "body.m.mass"
values = ["2 kg", "8 kg"]
[[output]]
kind = "modes"
statistic = "period"
count = 1
""")
    sweep = froude.sweep(tmp_path / "study.toml", tmp_path / "kept", threads=1)
    assert sweep.state == ["done", "done"]
    np.testing.assert_array_equal(sweep["mass"], [2, 8])
    period = next(name for name in sweep.numbers if "period" in name)
    np.testing.assert_allclose(sweep[period], [math.pi, 2 * math.pi], rtol=1e-9)  # 2 pi sqrt(m/k)
    np.testing.assert_array_equal(froude.sweep(tmp_path / "study.toml", tmp_path / "kept")[period], sweep[period])
    said = (tmp_path / "kept/table.csv").read_text().splitlines()
    assert len(said) == 3


def test_coefficients(examples, tmp_path):
    h5py = pytest.importorskip("h5py")
    program("bem", "convert", examples / "data/box2.nc", "-o", tmp_path / "c.h5")
    c = froude.coefficients(examples / "data/box2.nc")
    with h5py.File(tmp_path / "c.h5") as file:
        np.testing.assert_array_equal(c.omega, file["omega"])
        np.testing.assert_array_equal(c.added_mass, file["added_mass"])
        np.testing.assert_array_equal(c.damping, file["radiation_damping"])
        X = file["excitation_re"][()] + 1j * file["excitation_im"][()]
        np.testing.assert_array_equal(c.excitation, X.transpose((0, 2, 1)))
        np.testing.assert_array_equal(c.restoring, file["restoring"])
    assert len(c.modes) == 12 and c.excitation.shape == (len(c.heading), len(c.omega), 12)


def test_a_spectrum_has_the_moments_of_its_formula():
    S = froude.spectrum("jonswap", Hs=2.0, Tp=8.0, gamma=1)
    assert S.hs == pytest.approx(2, rel=1e-12) and S.tp == pytest.approx(8, rel=1e-12)
    omega_p = 2 * math.pi / 8
    # Pierson and Moskowitz: 5/16 Hs^2 wp^4 w^-5 exp(-5/4 (wp/w)^4)
    omega = np.linspace(0.3, 3, 50)
    plain = 5 / 16 * 4 * omega_p**4 * omega**-5.0 * np.exp(-1.25 * (omega_p / omega) ** 4)
    np.testing.assert_allclose(S(omega), plain, rtol=1e-11)
    assert S.moment(0) == pytest.approx(0.25, rel=1e-12)
    with pytest.raises(froude.InputError, match="did you mean \"gamma\""):
        froude.spectrum("jonswap", Hs=2.0, Tp=8.0, gama=1)
    with pytest.raises(froude.InputError, match="jonswap"):
        froude.spectrum("jonswop", Hs=2.0, Tp=8.0)


def test_a_sea_is_that_of_a_scene_and_has_its_height():
    ask = dict(hs=2.0, tp=8.0, gamma=3.3, duration=1800, step=0.25)
    sea = froude.sea("jonswap", seed=3, **ask)["gauge.elevation"]
    np.testing.assert_array_equal(froude.sea("jonswap", seed=3, **ask)["gauge.elevation"], sea)
    assert np.abs(froude.sea("jonswap", seed=4, **ask)["gauge.elevation"] - sea).max() > 0.5
    # Amplitudes are fixed: half an hour of some 200 waves has Hs but for what a record of it cuts off.
    assert 4 * sea.std() == pytest.approx(2, rel=0.1)


def test_values_of_any_kind_are_written_over_those_of_a_scene(examples):
    scene = froude.read(examples / "waves/storm.toml")
    first = froude.waves(scene)["gauge.elevation"]
    other = froude.waves(scene.with_values({"waves.seed": 11}))["gauge.elevation"]
    again = froude.waves(froude.read(examples / "waves/storm.toml", set={"waves.seed": np.int64(11)}))["gauge.elevation"]
    assert np.abs(first - other).max() > 0.1
    np.testing.assert_array_equal(other, again)
    with pytest.raises(froude.InputError, match="did you mean \"seed\""):
        scene.with_values({"waves.sed": 7})


def test_a_scene_of_a_text_finds_its_files(examples):
    text = (examples / "moored.toml").read_text()
    rao = froude.rao(froude.read_text(text, folder=examples))
    np.testing.assert_array_equal(rao["module.heave"], froude.rao(examples / "moored.toml")["module.heave"])


def test_cost_has_the_error_that_is_known_of_a_spring(tmp_path):
    text = SPRING + """[ask]
run = { duration = "10 s", every = "0.05 s", of = ["m.surge"] }
[solve]
step = "0.025 s"
"""
    cost = froude.cost(froude.read_text(text, tmp_path), tolerance=1e-2, repeat_for=0)
    (answer,) = cost.answers
    assert (answer.ask, answer.measure) == ("run", "rms")
    steps = {rung.setting: rung.error["rms"][0] for rung in answer.rungs if rung.approximation == "step"}
    assert [rung.setting for rung in answer.rungs if rung.as_scene] == ["0.025 s"]
    # The midpoint rule turns by (omega h)^2/12 too little a radian: at the time t cos(omega t) is late by omega^3 h^2 t/12,
    # and of these the rms over T is T/sqrt(3). T has 3.2 periods, no whole number of them: a tenth.
    omega, T = 2.0, 10.0
    for setting, error in steps.items():
        h = float(setting.split()[0])
        assert error == pytest.approx(omega**3 * h**2 / 12 * T / math.sqrt(3), rel=0.1)
    chosen = answer.rungs[answer.chosen]
    assert chosen.error["rms"][0] <= 1e-2 and chosen.on_front
    assert froude.run(froude.read_text(cost.scene, tmp_path)).stopped == ""
    with pytest.raises(froude.InputError, match="measures are: rms"):
        froude.cost(froude.read_text(text, tmp_path), measure="rmse")
    with pytest.raises(froude.InputError, match="was changed"):
        froude.cost(froude.read_text(text, tmp_path).with_values({"body.m.mass": 3.0}))


def test_arguments_that_cannot_be_are_named_with_a_remedy(examples):
    with pytest.raises(TypeError, match=r"scene = None is no path: give a scene of froude\.read\(\)"):
        froude.run(None)
    with pytest.raises(TypeError, match="depth = 'infinite' is no number: give metres, math.inf for deep water"):
        froude.coefficients(examples / "data" / "hemisphere_r5.1", density=1025, gravity=9.81, depth="infinite")
    with pytest.raises(froude.InputError, match=r'^Hs: error: \[waves\] hs = "-2.0 m" must be positive'):
        froude.spectrum("jonswap", Hs=-2.0, Tp=8.0)
    with pytest.raises(froude.InputError, match='^kind: error: .*; did you mean "jonswap"'):
        froude.spectrum("jonswp", Hs=2.0, Tp=8.0)
