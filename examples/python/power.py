# %% [markdown]
# A study: the power matrix of a float, 28 cases over period and height. Cases are kept as they come, and a second call
# goes on where the first one ended. Run it from the folder of the clone, as a script or cell by cell as a notebook.

# %%
import tempfile

import numpy as np

import froude

folder = tempfile.mkdtemp(prefix="power_")
sweep = froude.sweep("examples/sweep/study.toml", folder)
print(f"{sweep.state.count('done')} cases are done, {sweep.state.count('skipped')} skipped: {set(filter(None, sweep.reason))}")

# %% [markdown]
# A column is an array with a number a case. As a table, one row a height:

# %%
period, height, power = sweep["period"], sweep["height"], sweep["rack.pto_power.mean"]
print("height [m] " + "".join(f"{t:8.1f} s" for t in np.unique(period)))
for h in np.unique(height):
    row = [power[(period == t) & (height == h)][0] for t in np.unique(period)]
    print(f"{h:10.1f} " + "".join(f"{p:8.0f} W" for p in row))

# %% [markdown]
# `froude report` makes figures of the folder, and `sweep.to_xarray()` a dataset.

# %%
best = np.nanargmax(power)
print(f"most: {power[best]:.0f} W at {period[best]} s and {height[best]} m")
