# %% [markdown]
# Force coefficients from measurements: a cylinder of 0.12 m is moved to and fro in still water, and a CSV has time,
# position and force. Run it from the folder of the clone, as a script or cell by cell as a notebook.

# %%
import pathlib

import froude

scene = pathlib.Path("examples/fit/oscillation.toml")
print(scene.read_text())

# %% [markdown]
# The interval has the chance that the scene asks for. What is the same throughout, a delay or a wrong diameter, is told
# apart as `systematic_error`.

# %%
fit = froude.fit(scene)
for name in ("cd", "ca"):
    one = fit[name]
    print(f"{name} = {one.value:.3f}, from {one.interval[0]:.3f} to {one.interval[1]:.3f}")

# %% [markdown]
# What a run then needs is the drag area and the added mass of a metre of it.

# %%
density, diameter = 997.0, 0.12  # kg/m^3, m
print(f"drag {0.5 * density * diameter * fit['cd'].value:.1f} N/(m/s)^2 a metre")
print(f"added mass {fit['ca'].value * density * 3.14159265 * diameter**2 / 4:.2f} kg a metre")
