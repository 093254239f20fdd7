#!/usr/bin/python3
"""Opens run.h5, rao.h5 and headings.h5 of a folder as any user of xarray would, and checks what is seen.

An engine that is not installed is left out; netcdf4 must be there.
"""
import importlib.util
import sys
from pathlib import Path

import numpy
import xarray


def check_run(data):
    assert dict(data.sizes) == {"time": 20000}, data.sizes
    assert data["m1.heave"].dims == ("time",)
    assert data["m1.heave"].attrs == {"units": "m", "long_name": "heave of m1"}, data["m1.heave"].attrs
    assert data["ratio"].attrs["units"] == "1"
    assert data.time.attrs["units"] == "s" and data.time.dtype == numpy.float64
    numpy.testing.assert_array_equal(data.time.values, 0.05 * numpy.arange(20000))
    assert data.attrs["kind"] == "froude run" and data.attrs["froude_version"]
    # 1e-15: sin of two libraries may differ in the last place.
    numpy.testing.assert_allclose(data["m1.heave"].values, numpy.sin(data.time.values), rtol=0, atol=1e-15)


def check_rao(data):
    assert data["m1.heave"].dims == ("omega", "complex")
    assert list(data["complex"].values) == ["re", "im"]
    assert data.omega.attrs["units"] == "rad/s"
    assert float(data.heading) == 0.25 and data.heading.attrs["units"] == "rad"
    amplitude = data["m1.heave"].sel(complex="re") + 1j * data["m1.heave"].sel(complex="im")
    numpy.testing.assert_array_equal(amplitude.values, [1 + 2j, 3 + 4j, 5 + 6j])


def check_headings(data):
    assert dict(data.sizes) == {"heading": 2, "omega": 3, "complex": 2}, data.sizes
    assert data["m1.heave"].dims == ("heading", "omega", "complex")
    assert data.heading.attrs["units"] == "rad" and data.heading.dims == ("heading",)
    numpy.testing.assert_array_equal(data.heading.values, [1.25, 0.25])
    amplitude = data["m1.heave"].sel(complex="re") + 1j * data["m1.heave"].sel(complex="im")
    numpy.testing.assert_array_equal(amplitude.sel(heading=0.25).values, [7 + 8j, 9 + 10j, 11 + 12j])
    assert amplitude.sel(heading=1.25, omega=1.0).item() == 3 + 4j
    assert abs(amplitude).max("omega").dims == ("heading",)


def main(folder):
    engines = [e for e, module in (("netcdf4", "netCDF4"), ("h5netcdf", "h5netcdf")) if importlib.util.find_spec(module)]
    for engine in engines:
        with xarray.open_dataset(folder / "run.h5", engine=engine) as data:
            check_run(data)
        with xarray.open_dataset(folder / "rao.h5", engine=engine) as data:
            check_rao(data)
        with xarray.open_dataset(folder / "headings.h5", engine=engine) as data:
            check_headings(data)
        with xarray.open_dataset(folder / "run.h5", engine=engine, group="provenance") as data:
            scene = data["scene"].item()
            scene = scene.decode("utf-8") if isinstance(scene, bytes) else scene  # h5netcdf leaves texts undecoded
            assert scene == 'schema = 1\ntitle = "Grüße"\n', repr(scene)
            assert data["settings"].attrs["body[1].mass"] == "9088 kg"


main(Path(sys.argv[1]))
