# Springs between two modules that are stiff while the gap widens or closes and soft while it comes back: each cycle
# takes energy out, whatever the period. A controller in Python, sampled at the end of every step.
import pathlib

import froude

file = pathlib.Path(__file__).with_name("switching.toml")
stiff, soft = 29000.0, 6300.0  # N/m


def decide(sample):
    gap = sample["m2.surge"] - sample["m1.surge"]
    rate = sample.velocity("m2")[0] - sample.velocity("m1")[0]
    return stiff if gap * rate > 0 else soft


def gap(scene, controller):
    """Standard deviation after the first minute, m."""
    run = froude.run(scene, controllers={"spring*": controller})
    return (run["m2.surge"] - run["m1.surge"])[run.time > 60].std()


for period in (2.5, 4.5):  # near the resonances of the stiff and of the soft springs
    scene = froude.read(file, {"waves.period": period, "waves.height": 0.1})
    print(f"{period} s: the gap moves {gap(scene, lambda sample: stiff):.3f} m with stiff springs, "
          f"{gap(scene, lambda sample: soft):.3f} m with soft ones, {gap(scene, decide):.3f} m with the controller")
