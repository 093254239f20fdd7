"""Parts of scenes that are run for tests of how runs begin, end and go on."""

OPEN_WATER = 'schema = 1\n[water]\ndensity = "1000 kg/m^3"\ndepth = "14 m"\n'
# A pendulum.
DISC = """[[body]]
name = "disc"
position = "(0, 0, 2) m"
centre_of_gravity = "(0, 0, 0) m"
mass = "20 kg"
radii_of_gyration = "(0.3, 0.3, 0.4) m"
weight = true
[[joint]]
name = "pivot"
kind = "hinge"
between = ["ground", "disc"]
at = "(0, 1, 2.6) m"
axis = "x"
"""

# A block on a spring, and what is asked of forty masses of it.
SCENE_OF_SWEEPS = """\
schema = 1
[water]
density = "1025 kg/m^3"
depth = "infinite"
[[body]]
name = "block"
mass = "100 kg"
free = "surge"
initial = { surge = "20 cm" }
[[mooring]]
on = "block"
kind = "linear"
stiffness = { surge = "400 N/m" }
[ask]
run = { duration = "60 s", every = "0.1 s", of = ["block.surge"] }
accuracy = 1e-3
"""
STUDY_OF_SWEEPS = """\
schema = 1
scene = "block.toml"
[[axis]]
name = "mass"
key = "body.block.mass"
range = "100 kg .. 400 kg, 40 values"
[[output]]
kind = "run"
of = "block.surge"
statistic = ["deviation", "maximum", "range"]
"""
