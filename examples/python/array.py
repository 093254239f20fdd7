# %% [markdown]
# RAOs of an array: five floating modules in a row, whose coefficients hold the waves that they send to one
# another. Run it from the folder of the clone, as a script or cell by cell as a notebook.

# %%
import numpy as np

import froude

scene = froude.read("examples/pontoon5.toml")
rao = froude.rao(scene)
print(rao.signals)

# %% [markdown]
# One line a module: the largest heave a metre of wave amplitude, and the period at which it comes.

# %%
for name in (s for s in rao.signals if s.endswith(".heave")):
    size = np.abs(rao[name])
    at = size.argmax()
    print(f"{name}: {size[at]:.3f} {rao.unit(name)} at {2 * np.pi / rao.omega[at]:.2f} s, error {rao.error(name):.1g}")

# %% [markdown]
# Another heading is a value written over that of the scene; what was computed for the first serves again.

# %%
beam = froude.rao(scene.with_values({"waves.heading": 90.0}))
connectors = [s for s in rao.signals if s.endswith(".force")]
print(f"largest force between modules: {max(np.abs(rao[s]).max() for s in connectors):.0f} N/m in head seas, "
      f"{max(np.abs(beam[s]).max() for s in connectors):.0f} N/m in beam seas")
