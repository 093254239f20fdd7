"""Random seas by the names of their spectra."""
import json
import math
import re
from collections.abc import Mapping
from typing import Tuple, Union

from froude import _froude
from froude.calls import FileName, read_text, waves

Parameter = Union[bool, int, float, str, Mapping[str, Union[int, float, str]]]


def _value(kind: str, key: str, value: Parameter) -> str:
    """As TOML writes it; numbers of quantities in SI."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{k} = {_value(kind, k, v)}" for k, v in value.items()) + " }"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    unit = _froude.unit_of(kind, key)
    number = repr(value.item() if hasattr(value, "item") else value)
    return number if unit is None else json.dumps(f"{number} {unit}")


def _of_argument(message: str, text: str, given: Mapping[str, str]) -> str:
    """An error at a line of this text as one of the argument that wrote it: "Hs: error: ...; remedy"."""
    found = re.match(r".*scene\.toml:(\d+):\d+: (error: [^\n]*)(.*)", message, re.S)
    if found is None:
        return message
    key = text.split("\n")[int(found.group(1)) - 1].split(" = ")[0]
    remedy = found.group(3).split("^")[-1].strip()
    return f"{given.get(key, key)}: {found.group(2)}" + (f"; {remedy}" if remedy else "")


def _scene(kind: str, parameters: Mapping[str, Parameter], depth: float, gravity: float, folder: FileName,
           heading: float = 0.0, at: Tuple[float, float] = (0.0, 0.0), duration: float = 1.0,
           step: float = 1.0) -> _froude.Scene:
    """A scene of that sea alone, with a gauge. What is wrong with it is told of the argument, not of this text."""
    deep = "infinite" if math.isinf(depth) else f"{float(depth)!r} m"
    keys = {**{key.lower(): value for key, value in parameters.items()}, "heading": heading}
    lines = [f"{key} = {_value(kind, key, value)}" for key, value in keys.items() if value is not None]
    text = "\n".join([
        "schema = 1",
        "[waves]", f"kind = {json.dumps(kind)}", *lines,
        "[water]", 'density = "1025 kg/m^3"', f'gravity = "{float(gravity)!r} m/s^2"', f"depth = {json.dumps(deep)}",
        "[[probe]]", 'name = "gauge"', f'at = "({float(at[0])!r}, {float(at[1])!r}, 0) m"',
        "[ask]", f'waves = {{ duration = "{float(duration)!r} s", every = "{float(step)!r} s" }}', ""])
    try:
        return read_text(text, folder)
    except _froude.InputError as error:
        given = {**{key.lower(): key for key in parameters}, "heading": "heading"}
        raise _froude.InputError(_of_argument(str(error), text, given)) from None


def spectrum(kind: str, *, depth: float = math.inf, gravity: float = 9.81, folder: FileName = ".",
             **parameters: Parameter) -> _froude.Spectrum:
    """The variance spectrum of a random sea.

    Parameters
    ----------
    kind : str
        "jonswap", "jonswap-dnv", "pierson-moskowitz", "fully-developed", "tma", "ochi-hubble", "torsethaugen",
        "wallops", "donelan", "swell", "tabulated" or "measured", as ``[waves] kind`` has them.
    depth, gravity : float
        Of the water, m and m/s^2, for those spectra that they act on: TMA and those of a wind or steepness.
    folder : path
        Where a file that `parameters` name is looked for.
    **parameters
        Keys of that kind, in SI units; capitals do not matter: ``Hs=2.0, Tp=8.0, gamma=3.3``.

    Returns
    -------
    Spectrum
        ``S(omega)``, m^2 s/rad; ``S.moment(n)``, ``S.hs``, ``S.tp``, ``S.tz``.

    Raises
    ------
    InputError
        For a kind or key that there is not, with the nearest, and for values outside their range.

    Notes
    -----
    Formulas and sources are in docs/theory/waves-spectra.md.
    """
    return _froude.spectrum_of(_scene(kind, parameters, depth, gravity, folder))


def sea(kind: str, *, duration: float, step: float, seed: int, heading: float = 0.0,
        at: Tuple[float, float] = (0.0, 0.0), depth: float = math.inf, gravity: float = 9.81, folder: FileName = ".",
        **parameters: Parameter) -> _froude.Water:
    """The elevation of a random sea at one place, in time.

    Parameters
    ----------
    kind : str
        As of `spectrum`.
    duration, step : float
        s. The first sample is at t = 0.
    seed : int
        Of the random phases; the same seed gives the same sea on every machine, however long the record.
    heading : float
        Where the waves go, rad, from +x towards +y.
    at : (float, float)
        x and y of the gauge, m.
    depth, gravity : float
        Of the water, m and m/s^2.
    folder : path
        Where a file that `parameters` name is looked for.
    **parameters
        Keys of that kind and of all random seas, in SI units:
        ``spreading={"kind": "cos2s", "s": 10}``.

    Returns
    -------
    Water
        Its signal "gauge.elevation", m; `Water.notes` tell how many waves it has, and when it repeats.

    Raises
    ------
    InputError
        As of `spectrum`.
    """
    return waves(_scene(kind, {**parameters, "seed": seed}, depth, gravity, folder, heading, at, duration,
                        step))
