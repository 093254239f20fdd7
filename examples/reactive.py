# A heaving float on a power take-off, in waves longer than its own period. A brake takes out what it can; a controller
# that also pushes, with a stiffness that tunes the float to the wave, takes out as much as there is to be had, if its
# machine is strong enough. What theory has for both (Falnes 2002, chapter 6) stands beside it.
import pathlib

import numpy as np

import froude

examples = pathlib.Path(__file__).parent
period, height, mass = 5.0, 0.04, 9088.0  # s, m, kg
omega = 2 * np.pi / period

# Of the water, in heave: added mass, damping and restoring, and the load per metre of wave amplitude.
water, heave = froude.coefficients(examples / "data/pontoon1.nc"), 2
added, damping, load = (np.interp(omega, water.omega, values) for values in (
    water.added_mass[:, heave, heave], water.damping[:, heave, heave], np.abs(water.excitation[0, :, heave])))
force = load * height / 2
tuning = omega**2 * (mass + added) - water.restoring[heave, heave]  # N/m: it makes the float resonant
impedance = np.hypot(damping, tuning / omega)                       # N s/m, of the float without a take-off


def brake(sample):
    return impedance * sample.rate, 0.0, impedance  # with its slopes: it follows the motion within the step


def tuned(sample):
    return tuning * sample.coordinate + damping * sample.rate, tuning, damping


def power(controller, limit):
    """Mean over the last four waves, W, with a machine of so many kN."""
    scene = froude.read(examples / "takeoff.toml", {
        "waves.period": period, "waves.height": height, "ask.run.duration": "80 s",
        "joint.rack.pto.force_limit": limit})
    run = froude.run(scene, {"rack": controller})
    return run["rack.pto_power"][run.time > 80 - 4 * period].mean()


print(f"brake: {power(brake, 30.0):.1f} W, by theory {force**2 / (4 * (impedance + damping)):.1f} W")
print(f"tuned: {power(tuned, 30.0):.1f} W, by theory {force**2 / (8 * damping):.1f} W")
print(f"tuned, with 10 kN at most: {power(tuned, 10.0):.1f} W")
