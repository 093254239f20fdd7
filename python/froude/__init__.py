"""Floating and submerged structures in waves: scenes and their answers, spectra, coefficients, fits, controllers.

A scene is read, and asked::

    import froude

    scene = froude.read("moored.toml", set={"waves.height": 2.0})
    run = froude.run(scene, progress=True)
    run["module.heave"], run.time                # numpy arrays, SI
    froude.rao(scene).to_xarray()                # labelled, where xarray is installed

Lengths are in metres, angles in radians, everything else in SI units; x is forward, y to port, z up from the still
waterplane; harmonic quantities are Re(amplitude e^{+i omega t}). What cannot be raises `InputError`, which says file,
line, column, the rule and the remedy.
"""
from froude._froude import (
    AnswerCost, Coefficients, Cost, CostRung, Densities, Density, Estimate, Fit, FreeSurface, InputError, JointSample,
    Modes, NumericsError, Plan, PlanLine, Rao, Run, Sample, Scene, Spectrum, Sweep, Water, __version__)
from froude.calls import (
    coefficients, cost, export, field, fit, modes, plan, psd, rao, read, read_text, response, run, sweep, waves)
from froude.seas import sea, spectrum

__all__ = [
    "AnswerCost", "Coefficients", "Cost", "CostRung", "Densities", "Density", "Estimate", "Fit", "FreeSurface", "InputError",
    "JointSample", "Modes", "NumericsError", "Plan", "PlanLine", "Rao", "Run", "Sample", "Scene", "Spectrum", "Sweep", "Water",
    "__version__", "coefficients", "cost", "export", "field", "fit", "modes", "plan", "psd", "rao", "read", "read_text",
    "response", "run", "sea", "spectrum", "sweep", "waves"]
