"""What a scene, a study, a record or a file of coefficients is asked."""
import json
import numbers as numbers_of_python
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np

from froude import _froude
from froude.progress import Progress, telling

FileName = Union[str, "os.PathLike[str]"]
Value = Union[bool, int, float, str]
AnyScene = Union[_froude.Scene, FileName]
# Of a Sample a stiffness; of a JointSample a force, or force, stiffness and damping.
Controller = Callable[[Any], Union[None, float, tuple[float, float, float]]]


def _plain(values: Optional[Mapping[str, Value]]) -> dict:
    """Numbers of numpy as Python's own: those that the module takes."""
    return {path: value.item() if hasattr(value, "item") else value for path, value in (values or {}).items()}


def _scene(scene: AnyScene) -> _froude.Scene:
    if isinstance(scene, _froude.Scene):
        return scene
    return read(_path("scene", scene, "a scene of froude.read() or froude.read_text(), or the path of a scene"))


def _path(argument: str, value: Any, needed: str) -> FileName:
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{argument} = {value!r} is no path: give {needed}")
    return value


def _number(argument: str, value: Optional[float], needed: str) -> Optional[float]:
    """None where it is left out; numbers of numpy are numbers."""
    if value is None or (isinstance(value, numbers_of_python.Real) and not isinstance(value, bool)):
        return value
    if getattr(value, "ndim", None) == 0:
        return _number(argument, value.item(), needed)
    raise TypeError(f"{argument} = {value!r} is no number: give {needed}")


def read(file: FileName, set: Optional[Mapping[str, Value]] = None, *,
         numbers: Optional[Mapping[str, float]] = None) -> _froude.Scene:
    """Reads a scene.

    Parameters
    ----------
    file : path
        TOML, as docs/guide/motion.md and docs/guide/fit.md describe it.
    set : dict, optional
        Values by their paths, written over those of the file: numbers in the units written there, texts with theirs:
        ``{"waves.height": 2.0, "waves.seed": 7, "body.buoy.mass": "3 t"}``. Of several tables with one heading the
        name stands in the path, or the number counts from 1: ``"line[1].length"``; of a vector a component,
        ``"load.at.x"``. A key that its table does not write is written there.
    numbers : dict, optional
        An older name of `set`.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        With file, line, column, the rule that is broken and the remedy.
    """
    if set is not None and numbers is not None:
        raise TypeError("set and numbers are two names of one thing: give one")
    return _froude.read(file, _plain(set if numbers is None else numbers))


def read_text(text: str, folder: FileName = ".", set: Optional[Mapping[str, Value]] = None) -> _froude.Scene:
    """Reads a scene from a text.

    Parameters
    ----------
    text : str
        As a file would hold it. Errors call it ``scene.toml``.
    folder : path
        Where files that the scene names are looked for.
    set : dict, optional
        As of `read`.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        With line, column, the rule that is broken and the remedy.
    """
    return _froude.read_text(text, os.path.join(folder, "scene.toml"), _plain(set))


def run(scene: AnyScene, controllers: Optional[Mapping[str, Controller]] = None, *,
        progress: Progress = None) -> _froude.Run:
    """Runs a scene in time, as its ``[ask] run`` says.

    Parameters
    ----------
    scene : Scene or path
    controllers : dict, optional
        Functions by names; ``*`` stands for any characters. Of axial connectors a function of a `Sample`, called at the
        end of each step, that returns the new stiffness, N/m, or None to leave it. Of sliders and hinges a function of
        a `JointSample`, called at the beginning and at the end of each step, that returns the force against the
        stroke, N, or the moment against the angle, N m, or with it how it follows both within the step, ``(force,
        stiffness, damping)``, or None to leave what acts. From its first force on it takes the place of spring,
        damper and preload of a ``[joint.pto]``, whose limit, stops and latch stay.
    progress : bool or function, optional
        True draws a bar on stderr after a second; a function is called with the share done, 0 to 1, and "run".

    Returns
    -------
    Run
        Numerics that give up, and controllers that return what is not finite, end it early: `Run.stopped` says why.

    Raises
    ------
    InputError
        For a scene that asks for no run or cannot be, and for controllers of what is not there.
    Exception
        What a controller raises, with what the run has until then as its attribute ``run``.
    KeyboardInterrupt
        At Ctrl-C; nothing is kept.
    """
    with telling(progress) as told:
        return _froude.run(_scene(scene), dict(controllers or {}), told)


def rao(scene: AnyScene, *, progress: Progress = None) -> _froude.Rao:
    """Response amplitude operators, as ``[ask] rao`` says.

    Parameters
    ----------
    scene : Scene or path
    progress : bool or function, optional
        As of `run`; it is told how far meshes of hulls are solved, where the scene has any.

    Returns
    -------
    Rao
        Complex amplitudes per metre of wave amplitude.

    Raises
    ------
    InputError, NumericsError
        For a scene that asks for none or cannot be; for equations without an answer.
    """
    with telling(progress) as told:
        return _froude.rao(_scene(scene), told)


def field(scene: AnyScene, *, progress: Progress = None) -> _froude.FreeSurface:
    """The free surface about bodies of cylinders or meshes in one regular wave, as ``[ask] field`` says.

    Parameters
    ----------
    scene : Scene or path
    progress : bool or function, optional
        As of `rao`.

    Returns
    -------
    FreeSurface
        Complex amplitudes per metre of wave amplitude on a grid.

    Raises
    ------
    InputError, NumericsError
        For a scene that asks for none, whose bodies have no shape there, or whose estimate misses its accuracy.
    """
    with telling(progress) as told:
        return _froude.field(_scene(scene), told)


def modes(scene: AnyScene, *, progress: Progress = None) -> _froude.Modes:
    """Free motions about rest, as ``[ask] modes`` says.

    Parameters
    ----------
    scene : Scene or path
    progress : bool or function, optional
        As of `rao`.

    Returns
    -------
    Modes
        Periods, damping ratios and shapes, by rising frequency.

    Raises
    ------
    InputError, NumericsError
        For a scene that asks for none or cannot be; for motions that cannot be found.
    """
    with telling(progress) as told:
        return _froude.modes(_scene(scene), told)


def plan(scene: AnyScene, *, progress: Progress = None) -> _froude.Plan:
    """What the answers to a scene will take, and what it leaves out.

    Parameters
    ----------
    scene : Scene or path
    progress : bool or function, optional
        As of `rao`.

    Returns
    -------
    Plan
        ``print(plan)`` is what ``froude plan`` prints.

    Raises
    ------
    InputError
        For a scene that cannot be.
    """
    with telling(progress) as told:
        return _froude.plan(_scene(scene), told)


def waves(scene: AnyScene, *, progress: Progress = None) -> _froude.Water:
    """What the water does at the probes of a scene, as ``[ask] waves`` says.

    Parameters
    ----------
    scene : Scene or path
    progress : bool or function, optional
        As of `run`.

    Returns
    -------
    Water
        Elevations, velocities, accelerations, pressures in time.

    Raises
    ------
    InputError
        For a scene that asks for none or cannot be.
    """
    with telling(progress) as told:
        return _froude.waves(_scene(scene), told)


def response(scene: AnyScene, *, progress: Progress = None) -> _froude.Densities:
    """Spectra of responses in the random sea of a scene, from its transfer functions.

    Parameters
    ----------
    scene : Scene or path
        With ``[ask] rao`` and waves that are a random sea.
    progress : bool or function, optional
        As of `rao`.

    Returns
    -------
    Densities
        Of "sea" and of each signal; of bodies with second-order loads also of "NAME slow" and "NAME sums".

    Raises
    ------
    InputError, NumericsError
        For a scene that asks for no RAOs, or another sea; for a response that is too sharp.
    """
    with telling(progress) as told:
        return _froude.response(_scene(scene), told)


def cost(scene: AnyScene, *, tolerance: Optional[float] = None, measure: str = "rms", repeat_for: float = 15.0,
         progress: Progress = None) -> _froude.Cost:
    """What accuracy costs: the settings of a scene's own approximations, each with its error and its time.

    Parameters
    ----------
    scene : Scene or path
        As it is written, without `set`: settings are written into its text.
    tolerance : float, optional
        Relative error; with it the cheapest settings within are chosen.
    measure : {"rms", "deviation", "extreme", "range"}
        Of errors of runs.
    repeat_for : float
        s of processor time of each answer, spent on repeats.
    progress : bool or function, optional
        As of `run`.

    Returns
    -------
    Cost

    Raises
    ------
    InputError, NumericsError
        For a scene that cannot be, or was changed.
    """
    with telling(progress) as told:
        return _froude.cost(_scene(scene), tolerance, measure, repeat_for, told)


def fit(scene: AnyScene, *, progress: Progress = None) -> _froude.Fit:
    """What measurements say of the coefficients of a model.

    Parameters
    ----------
    scene : Scene or path
        A scene with a ``[model]``, as docs/guide/fit.md describes it.
    progress : bool or function, optional
        As of `run`. How many searches a fit takes shows only as they come: each fills half of what is left. Fits of
        linear models have one, which is over at once.

    Returns
    -------
    Fit
        ``fit["cd"].value``, ``.interval``, ``.standard_error``.

    Raises
    ------
    InputError
        For a scene or data that cannot be.
    NumericsError
        Where no value may be told, with the reason.
    KeyboardInterrupt
        At Ctrl-C, between two trials; nothing is kept.
    """
    with telling(progress) as told:
        return _froude.fit(_scene(scene), told)


def sweep(study: FileName, folder: Optional[FileName] = None, *, threads: Optional[int] = None, retry: bool = False,
          progress: Progress = None) -> _froude.Sweep:
    """Answers all cases of a study, and keeps them as they come.

    Parameters
    ----------
    study : path
        TOML, as docs/guide/sweep.md describes it.
    folder : path, optional
        Where database, table and pictures are kept; the study's name with ``.sweep`` in the working folder, as the
        program does, unless it is given. Cases that are there already are not answered again.
    threads : int, optional
        One for each processor unless it is given. Numbers do not depend on it.
    retry : bool
        Cases that have failed are answered again.
    progress : bool or function, optional
        As of `run`.

    Returns
    -------
    Sweep

    Raises
    ------
    InputError
        For a study that cannot be, or a folder of another one.
    KeyboardInterrupt
        At Ctrl-C; cases that are done are kept, and the same call goes on from there.
    """
    if folder is None:
        folder = os.path.splitext(os.path.basename(os.fspath(study)))[0] + ".sweep"
    with telling(progress) as told:
        return _froude.sweep(study, folder, threads, retry, told)


def _series(name: str, values: Sequence[float]) -> np.ndarray:
    """Values of a signal in time, as the program takes them."""
    if np.ma.isMaskedArray(values) and np.ma.is_masked(values):
        raise ValueError(f"{np.ma.count_masked(values)} of {np.size(values)} samples of \"{name}\" are masked, and a "
                         "record has a number at each time: leave these times out of all signals, "
                         "{\"time\": time[~mask], ...}, with uneven=True")
    series = np.asarray(values)
    if series.ndim != 1 or series.dtype.kind not in "fiub":
        raise ValueError(f"\"{name}\" has the shape {series.shape} and the type {series.dtype}; a signal of a record is "
                         "a list of real numbers over the time")
    return series


def psd(record: Union[_froude.Run, _froude.Water, Mapping[str, Sequence[float]], FileName],
        signals: Union[str, Sequence[str]] = (), *, segment: Optional[str] = None, tapers: Optional[int] = None,
        uneven: bool = False, input: Optional[str] = None, start: Optional[str] = None, end: Optional[str] = None,
        confidence: float = 0.95) -> _froude.Densities:
    """Variance spectra of a record, by Welch's method unless something else is asked for.

    Parameters
    ----------
    record : Run, Water, dict or path
        A dict holds "time", s, and signals of that length; a file is a CSV with a header or a result of the program.
    signals : str or list of str
        Names; ``*`` stands for any characters. All of them unless some are given.
    segment : str, optional
        Length of a segment, "100 s"; 15 half overlapping segments unless it is given.
    tapers : int, optional
        Instead of segments so many sine tapers over the whole record.
    uneven : bool
        The record has gaps or uneven times: Lomb and Scargle's method.
    input : str, optional
        Signal of which the others are responses: `Densities.transfer`, `Densities.coherence`.
    start, end : str, optional
        "60 s": what lies before or after is left out.
    confidence : float
        Of `Densities.band`.

    Returns
    -------
    Densities

    Raises
    ------
    InputError
        For a record that is uneven or too short, or signals that it does not have.
    """
    names = [signals] if isinstance(signals, str) else list(signals)
    given = isinstance(record, (_froude.Run, _froude.Water, Mapping))
    content = {name: _series(name, values) for name, values in record.items()} if isinstance(record, Mapping) else record
    return _froude.psd(content, "the record" if given else record, names, segment, tapers, uneven, input, start, end,
                       confidence)


def export(results: Union[FileName, Sequence[FileName]], output: FileName, *, form: Optional[str] = None,
           signals: Union[str, Sequence[str]] = (), start: Optional[str] = None, end: Optional[str] = None,
           every: Optional[str] = None, scene_folder: Optional[FileName] = None) -> list:
    """Writes results for other programs, as docs/guide/export.md describes them.

    Parameters
    ----------
    results : path or list of paths
        Files that ``write(file)`` of a result or the program wrote, or tables of the program.
    output : path
        .csv, .mat for MATLAB or .pvd for ParaView; with `form` a folder.
    form : {"csv", "matlab", "vtk"}, optional
        Of several results, which then go into a folder.
    signals : str or list of str
        Names; ``*`` stands for any characters. All of them unless some are given.
    start, end : str, optional
        "60 s": of results in time, what lies before or after is left out.
    every : str, optional
        "0.5 s": of results in time, the samples that are nearest to so much later and later.
    scene_folder : path, optional
        Where the scenes stood, whose files .pvd needs; beside each result unless it is given.

    Returns
    -------
    list of dict
        For each result what ``froude export --json`` tells: "written", "notes", and how much.

    Raises
    ------
    InputError
        For a file that is no result, or an output that cannot be.
    """
    if form not in (None, "csv", "matlab", "vtk"):
        raise ValueError(f"form is csv, matlab or vtk, not {form!r}")
    names = [signals] if isinstance(signals, str) else list(signals)
    files = [results] if isinstance(results, (str, os.PathLike)) else list(results)
    if not files:
        raise ValueError("export needs one result at least, and got none")
    return json.loads(_froude.export(files, output, form or "", names, start, end, every, scene_folder))["exports"]


def coefficients(file: FileName, *, density: Optional[float] = None, gravity: Optional[float] = None,
                 depth: Optional[float] = None, ulen: Optional[float] = None,
                 iperout: Optional[int] = None) -> _froude.Coefficients:
    """Reads hydrodynamic coefficients of any format that docs/guide/coefficients.md lists.

    Parameters
    ----------
    file : path
        Formats are told apart by content; of those of several files, any or the folder.
    density, gravity, depth : float, optional
        Of the water, kg/m^3, m/s^2, m (math.inf is deep), where the file does not say.
    ulen : float, optional
        WAMIT's ULEN, m.
    iperout : int, optional
        WAMIT's IPEROUT, 1 to 4.

    Returns
    -------
    Coefficients

    Raises
    ------
    InputError
        With file, line and remedy.
    """
    return _froude.coefficients(
        _path("file", file, "the path of a file of coefficients, or of its folder"),
        _number("density", density, "kg/m^3"), _number("gravity", gravity, "m/s^2"),
        _number("depth", depth, "metres, math.inf for deep water"), _number("ulen", ulen, "metres"),
        _number("iperout", iperout, "1, 2, 3 or 4"))
