"""Results as datasets of xarray."""
import sys

import numpy as np
import pytest

import froude

xarray = pytest.importorskip("xarray")


def test_a_run(examples):
    run = froude.run(examples / "forced.toml")
    data = run.to_xarray()
    assert list(data.data_vars) == run.signals and data.sizes == {"time": len(run.time)}
    for name in run.signals:
        np.testing.assert_array_equal(data[name], run[name])
        assert data[name].attrs["units"] == (run.unit(name) or "1")
        assert data[name].attrs["long_name"] == run.meaning(name)
    assert data.time.attrs["units"] == "s"


@pytest.mark.parametrize("scene", ["moored.toml", "headings.toml"])
def test_responses_have_both_dimensions(examples, scene):
    rao = froude.rao(examples / scene)
    data = rao.to_xarray()
    for name in rao.signals:
        assert data[name].dims == ("heading", "omega") and np.iscomplexobj(data[name])
        np.testing.assert_array_equal(data[name].values.ravel(), rao[name].ravel())
    np.testing.assert_array_equal(data.omega, rao.omega)


BARGE = """schema = 1
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "infinite"
[[body]]
name = "barge"
mass = "32 t"
centre_of_gravity = "(0, 0, -0.4) m"
radii_of_gyration = "(1.2, 2.4, 2.6) m"
[body.hydrodynamics]
mesh = "barge.obj"
frequencies = "0.6 rad/s .. 1.2 rad/s, 3 values"
mesh_tolerance = 0.9
excitation = true
radiation = {}
hydrostatics = true
[[body.section]]
name = "mid"
at = "(0, 0, 0) m"
mass = "16 t"
centre_of_gravity = "(1.6, 0, -0.4) m"
radii_of_gyration = "(1.2, 1.2, 1.5) m"
accept_error = 5.0
[[body.section]]
name = "fore"
at = "(2, 0, 0) m"
mass = "8 t"
centre_of_gravity = "(3, 0, -0.4) m"
radii_of_gyration = "(1.2, 0.7, 1.3) m"
accept_error = 5.0
[ask]
rao = { omega = "0.6 rad/s .. 1.2 rad/s, 3 values", headings = ["180 deg"], of = ["barge.*.force_z", "barge.fore.moment_y"] }
"""

BOX = """v -4 -2 -1
v 4 -2 -1
v 4 2 -1
v -4 2 -1
v -4 -2 1
v 4 -2 1
v 4 2 1
v -4 2 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 4 1 5 8
"""


def test_loads_at_sections_are_along_them_and_at_rest(tmp_path):
    (tmp_path / "barge.obj").write_text(BOX)
    rao = froude.rao(froude.read_text(BARGE, folder=tmp_path))
    data = rao.section_loads()
    assert data.force_z.dims == ("section", "heading", "omega") and data.force_z.attrs["units"] == "N/m"
    assert list(data.section.values) == ["barge.mid", "barge.fore"]
    np.testing.assert_array_equal(data.x, [0, 2])
    np.testing.assert_array_equal(data.force_z[1, 0], rao["barge.fore.force_z"])
    assert np.all(np.isnan(data.moment_y[0])) and data.moment_y.attrs["units"] == "N m/m"  # it was not asked for
    # Half of the mass about x = 1.6 m, not 2 m: what is missing there is a couple, by hand, less water on the bow.
    np.testing.assert_allclose(data.moment_y_at_rest[0], 16e3 * 9.81 * 0.4 - 0.5 * 9810 * 4 * 2 / 3, rtol=1e-9)
    assert data.moment_y_at_rest.attrs["units"] == "N m"
    assert 0 < rao.error("barge.mid.force_z") < 5


def test_loads_at_sections_need_sections(examples):
    with pytest.raises(ValueError, match="body.section"):
        froude.rao(examples / "moored.toml").section_loads()


PILE = """schema = 1
[water]
density = "1025 kg/m^3"
depth = "20 m"
[[body]]
name = "pile"
mass = "64.403 t"
free = "heave"
[body.hydrodynamics]
excitation = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "4 m"
draught = "5 m"
frequencies = "1.2 rad/s .. 1.3 rad/s, 2 values"
[ask]
field = { omega = "1.25 rad/s", bodies = "held", x = "-6 m .. 6 m, 7 values", y = "-4 m .. 4 m, 3 values" }
accuracy = 5e-2
"""


def test_the_free_surface_has_both_dimensions_and_is_the_sum_of_its_parts():
    field = froude.field(froude.read_text(PILE))
    data = field.to_xarray()
    assert data["elevation"].dims == ("y", "x") and data["elevation"].shape == (3, 7)
    np.testing.assert_array_equal(data.x, field.x)
    assert field.held and field.omega == 1.25 and 0 < field.estimate < 0.05
    told = ~np.isnan(field["elevation"])
    assert (~told).sum() == 1 and not told[1, 3]  # in the pile
    parts = field["incident"] + field["scattered"] + field["radiated"]
    np.testing.assert_allclose(field["elevation"][told], parts[told], rtol=1e-14)
    np.testing.assert_array_equal(field["radiated"][told], 0)
    np.testing.assert_allclose(abs(field["incident"][told]), 1, rtol=1e-14)


def test_spectra_modes_and_coefficients(examples):
    spectra = froude.response(examples / "seastate.toml")
    data = spectra.to_xarray()
    assert data["float.heave"].attrs["units"] == "m^2/Hz"
    # m0 by the trapezium rule on the spectrum's own points
    assert data["float.heave"].integrate("frequency") == pytest.approx(spectra["float.heave"].moments["m0"], rel=1e-12)
    assert froude.modes(examples / "modes.toml").to_xarray()["shape"].dims == ("mode", "motion")
    c = froude.coefficients(examples / "data/box2.nc")
    data = c.to_xarray()
    one = data.added_mass.sel(radiating_dof=c.modes[0], influenced_dof=c.modes[4])
    np.testing.assert_array_equal(one, c.added_mass[:, 4, 0])


def test_without_xarray_there_is_a_remedy(examples, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match="python3-xarray"):
        froude.modes(examples / "modes.toml").to_xarray()


def test_sources_are_the_commands_that_tell_them(examples):
    assert froude.response(examples / "seastate.toml").to_xarray().attrs["source"] == "froude response"
    time = np.arange(0, 600, 0.5)
    assert froude.psd({"time": time, "a": np.sin(time) + np.cos(1.7 * time)}).to_xarray().attrs["source"] == "froude psd"
