"""Results as datasets of xarray: labelled axes, and for each variable its unit and what it is."""
from typing import TYPE_CHECKING, Any

import numpy as np

from froude import _froude

if TYPE_CHECKING:
    import xarray


def _xarray() -> Any:
    try:
        import xarray
    except ImportError as missing:
        raise ImportError("to_xarray() needs xarray, which is not installed: apt-get install python3-xarray, or pip "
                          "install xarray. Without it signals are numpy arrays: run[\"m1.heave\"]") from missing
    return xarray


def _attributes(unit: str, meaning: str, error: "float | None" = None) -> dict:
    out = {"units": unit or "1", "long_name": meaning}
    if error is not None:
        out["error"] = error  # relative, as the result estimates it
    return out


def _axis(name: str, values: Any, unit: str, meaning: str) -> Any:
    return _xarray().DataArray(values, dims=name, attrs=_attributes(unit, meaning))


def _error_of(result: Any, name: str) -> "float | None":
    return result.error(name) if hasattr(result, "error") else None


def _about(result: Any, kind: str) -> dict:
    """What belongs to all of a result."""
    out = {"source": f"froude {kind}", "froude_version": _froude.__version__}
    for name in ("accuracy", "stopped", "method"):
        if getattr(result, name, ""):
            out[name] = getattr(result, name)
    for name in ("notes", "warnings"):
        if getattr(result, name, []):
            out[name] = "\n".join(getattr(result, name))
    return out


def of_run(result: Any) -> "xarray.Dataset":
    """A run, or the water at probes: signals along time, s."""
    time = _axis("time", result.time, "s", "time")
    return _xarray().Dataset(
        {name: ("time", result[name], _attributes(result.unit(name), result.meaning(name), _error_of(result, name)))
         for name in result.signals}, {"time": time}, _about(result, "run"))


def of_rao(rao: _froude.Rao) -> "xarray.Dataset":
    """Responses along heading, rad, and omega, rad/s, both also where there is one."""
    shape = (len(rao.heading), len(rao.omega))
    return _xarray().Dataset(
        {name: (("heading", "omega"), rao[name].reshape(shape),
                _attributes(rao.unit(name), rao.meaning(name), rao.error(name))) for name in rao.signals},
        {"heading": _axis("heading", rao.heading, "rad", "where the waves go, from +x towards +y"),
         "omega": _axis("omega", rao.omega, "rad/s", "frequency of the waves")},
        {**_about(rao, "rao"), "convention": "Re(amplitude e^{+i omega t}), phase against the crest at the origin"})


_LOADS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")


def _load_of_sections(rao: _froude.Rao, load: str) -> tuple:
    """A load along section, heading and omega; NaN where a section was not asked for it."""
    values = np.full((len(rao.sections), len(rao.heading), len(rao.omega)), np.nan, dtype=complex)
    for i, section in enumerate(rao.sections):
        name = f"{section['name']}.{load}"
        if name in rao:
            values[i] = rao[name].reshape(values.shape[1:])
    unit = "N/m" if load.startswith("force") else "N m/m"
    return (("section", "heading", "omega"), values,
            _attributes(unit, f"{load} on the part that a section describes, per metre of wave amplitude"))


def of_section_loads(rao: _froude.Rao) -> "xarray.Dataset":
    """Loads at sections of hulls in waves, along section, heading, rad, and omega, rad/s, and where bodies are still.

    x, y and z are of a point of each section, m, along axes of its body from its origin.
    """
    if not rao.sections:
        raise ValueError("these responses have no loads at sections: [[body.section]] tells where, and `of` which")
    data = {load: _load_of_sections(rao, load) for load in _LOADS}
    for k, load in enumerate(_LOADS):
        data[f"{load}_at_rest"] = ("section", [s["at_rest"][k] for s in rao.sections], _attributes(
            "N" if k < 3 else "N m", f"{load} on the part that a section describes, where the bodies are still"))
    places = {axis: ("section", [s["at"][k] for s in rao.sections], _attributes("m", f"{axis} of a point of the section"))
              for k, axis in enumerate("xyz")}
    whole = of_rao(rao)
    return _xarray().Dataset(data, {"section": [s["name"] for s in rao.sections], **places, "heading": whole.heading,
                                    "omega": whole.omega}, whole.attrs)


def of_field(surface: _froude.FreeSurface) -> "xarray.Dataset":
    """The free surface along y and x, m."""
    return _xarray().Dataset(
        {name: (("y", "x"), surface[name], _attributes(surface.unit(name), surface.meaning(name)))
         for name in surface.signals},
        {"y": _axis("y", surface.y, "m", "of the grid, global"), "x": _axis("x", surface.x, "m", "of the grid, global"),
         "omega": surface.omega, "heading": surface.heading},
        {**_about(surface, "field"), "estimated_error": surface.estimate,
         "mean_drift_N_m2": list(surface.mean_drift), "power_taken_W_m2": surface.power_taken,
         "power_sent_out_W_m2": surface.power_sent_out,
         "convention": "Re(amplitude e^{+i omega t}), phase against the crest at the origin"})


def of_modes(modes: _froude.Modes) -> "xarray.Dataset":
    """Free motions: mode from 1, motions as they are called."""
    data = {
        "omega": ("mode", modes.omega, _attributes("rad/s", "undamped frequency")),
        "period": ("mode", modes.period, _attributes("s", "undamped period")),
        "damped_period": ("mode", modes.damped_period, _attributes("s", "period of a decay")),
        "damping_ratio": ("mode", modes.damping_ratio, _attributes("", "share of the critical damping")),
        "outside_data": ("mode", modes.outside_data, _attributes("", "frequency outside those of the coefficients")),
        "shape": (("mode", "motion"), modes.shape, _attributes("m or rad", "shape, of the centres of gravity"))}
    return _xarray().Dataset(data, {"mode": np.arange(1, len(modes.omega) + 1), "motion": modes.motions},
                             _about(modes, "modes"))


def of_densities(of: _froude.Densities) -> "xarray.Dataset":
    """Spectra along frequency, Hz, each with its moments; an estimate also with the band of its confidence.

    Spectra at other frequencies than the first, slow drift and sums of frequencies, have a dimension of their own.
    """
    first = of[of.signals[0]].frequency
    data, axes = {}, {"frequency": _axis("frequency", first, "Hz", "frequency")}
    for name in of.signals:
        one = of[name]
        along = "frequency"
        if not np.array_equal(one.frequency, first):
            along = f"frequency of {name}"
            axes[along] = _axis(along, one.frequency, "Hz", "frequency")
        about = {**_attributes(one.density_unit, f"one-sided variance density of {name}"),
                 "standard_deviation": one.standard_deviation, "tm02": one.tm02, "tp": one.tp}
        data[name] = (along, one.density, about)
        if of.band:
            for end, factor in zip(("low", "high"), of.band):
                data[f"{name}_{end}"] = (along, factor * one.density, _attributes(
                    one.density_unit, f"{end} end of the {100 * of.confidence:g} % band of {name}"))
    return _xarray().Dataset(data, axes, _about(of, "psd" if of.confidence > 0 else "response"))


def of_coefficients(c: _froude.Coefficients) -> "xarray.Dataset":
    """Coefficients under the names and dimensions that Capytaine gives them; phases are those of e^{+i omega t}."""
    matrix = ("omega", "radiating_dof", "influenced_dof")
    turned = (0, 2, 1)  # ours has the load first
    data = {"added_mass": (matrix, c.added_mass.transpose(turned), _attributes("kg, m", "added mass")),
            "radiation_damping": (matrix, c.damping.transpose(turned), _attributes("kg/s, m", "radiation damping"))}
    if len(c.heading):
        data["excitation_force"] = (("omega", "wave_direction", "influenced_dof"), c.excitation.transpose((1, 0, 2)),
                                    _attributes("N/m, N", "excitation per metre of wave amplitude"))
    for name, values, meaning in (
            ("hydrostatic_stiffness", c.restoring, "restoring by buoyancy and weight"),
            ("added_mass_zero", c.added_mass_zero, "added mass at omega = 0"),
            ("added_mass_infinite", c.added_mass_infinite, "added mass at omega = infinity")):
        if values is not None:
            data[name] = (("influenced_dof", "radiating_dof"), values, _attributes("SI", meaning))
    return _xarray().Dataset(
        data, {"omega": _axis("omega", c.omega, "rad/s", "frequency"),
               "wave_direction": _axis("wave_direction", c.heading, "rad", "where the waves go, from +x towards +y"),
               "radiating_dof": c.modes, "influenced_dof": c.modes},
        {"rho": c.density, "g": c.gravity, "water_depth": c.depth, "source": c.source, "notes": "\n".join(c.notes),
         "froude_version": _froude.__version__,
         "convention": "Re(amplitude e^{+i omega t}), phase against the crest at the origin"})


def of_sweep(sweep: _froude.Sweep) -> "xarray.Dataset":
    """The table of a sweep along case, from 1; `set_index(case=AXES).unstack()` makes a grid of a full one."""
    axes = {name: ("case", sweep[name], _attributes(sweep.unit(name), f"axis {name}")) for name in sweep.axes}
    data = {name: ("case", sweep[name], _attributes(sweep.unit(name), name)) for name in sweep.numbers}
    for name in ("state", "reason", "warnings"):
        data[name] = ("case", np.array(getattr(sweep, name), dtype=str), _attributes("", f"{name} of the case"))
    return _xarray().Dataset(data, {"case": sweep.case, **axes}, {"source": "froude sweep", "folder": str(sweep.folder),
                                                                 "froude_version": _froude.__version__})
