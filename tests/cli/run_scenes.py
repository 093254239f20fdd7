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
