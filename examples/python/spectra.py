# %% [markdown]
# Spectra of runs beside those of the linear answer: a module in three seas of one spectrum. Run it from the folder of
# the clone, as a script or cell by cell as a notebook.

# %%
import numpy as np

import froude

scene = froude.read("examples/cylinders.toml")
seas = [froude.run(scene.with_values({"waves.seed": seed})) for seed in (1, 2, 3)]
for warning in {w for run in seas for w in run.warnings}:
    print(warning)

# %% [markdown]
# `Hs` of a response is four standard deviations. The band says within what factors each density of one record lies.

# %%
spectra = [froude.psd(run, "module.*", start="20 s") for run in seas]
low, high = spectra[0].band
print(f"with {100 * spectra[0].confidence:.0f} % a density lies between {low:.2f} and {high:.2f} times the estimate")
for name in spectra[0].signals:
    print(f"{name}: deviations {', '.join(f'{s[name].standard_deviation:.4f}' for s in spectra)} {spectra[0][name].unit}")

# %% [markdown]
# The same from transfer functions and the spectrum of the sea, without any run.

# %%
linear = froude.response(scene)
for name in linear.signals:
    if name in spectra[0].signals:
        mean = np.sqrt(np.mean([s[name].standard_deviation ** 2 for s in spectra]))
        print(f"{name}: {mean:.4f} in runs, {linear[name].standard_deviation:.4f} linear")
