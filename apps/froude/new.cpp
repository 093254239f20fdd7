// froude new: a scene to begin with, and the reference of all keys.
#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "hydro/io/atomic_file.hpp"
#include "sweep/study.hpp"

namespace froude {
namespace {

constexpr const char* motion_scene =
    R"(# A floating body in waves. Every key is explained by `froude new --keys`; try `froude plan` on this file first.
# A scene names effects; what it does not name does not act. A value with a dimension is text with its unit, any unit.
schema = 1
title = "A moored pontoon"

[water]
density = "1000 kg/m^3"
depth = "14 m"                              # or "infinite"

[waves]
kind = "jonswap"                            # or "regular" with height and period, "pierson-moskowitz" with hs and tp
hs = "1.2 m"
tp = "6 s"
heading = "0 deg"                           # where the waves go: 0 deg is towards +x, 90 deg towards +y (port)
seed = 1                                    # another number is another sea of the same spectrum
ramp = "30 s"                               # wave loads grow from nothing over this time

[[body]]                                    # axes: x forward, y port, z up; origin in the still waterplane
name = "pontoon"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"     # or inertia = "(Ixx, Iyy, Izz) kg m^2"
# free = ["surge", "heave", "pitch"]        # all six modes are free unless this says otherwise
# initial = { heave = "0.5 m" }             # for a decay test: begin away from rest

[body.hydrodynamics]
file = "pontoon1.nc"                        # your coefficients, beside this file: WAMIT .1, Capytaine .nc, BEMIO .h5
                                            # (to try it out, copy examples/data/pontoon1.nc of the sources here)
excitation = true                           # loads of the incoming waves
radiation = {}                              # waves that the motion makes, with their memory
hydrostatics = true                         # buoyancy and weight

[[member]]                                  # drag on four cylinders: each ± stands for both signs
on = "pontoon"
from = "(±5.2, ±5.2, -1.13) m"
to = "(±5.2, ±5.2, 0) m"
diameter = "1.6 m"
drag = { cd = 1.0 }

[[mooring]]
on = "pontoon"
kind = "linear"
stiffness = { surge = "4.3 kN/m", sway = "4.3 kN/m", yaw = "16 kN m/rad" }

[ask]
rao = { periods = "2 s .. 8 s, 61 values", of = ["pontoon.*"] }
run = { duration = "600 s", every = "0.1 s", of = ["pontoon.*", "wave.elevation", "energy.*"] }
accuracy = 1e-2                             # relative; the program chooses how
)";

constexpr const char* fit_scene =
    R"(# Drag and inertia coefficients of a cylinder from measurements. Every key is explained by `froude new --keys`.
schema = 1
title = "Forced oscillation of a cylinder"

[data]
files = "runs/*.csv"                        # relative to this file
channels = { time = "t", force = "F", velocity = "u" }   # part = column; or position instead of velocity

[model]
kind = "morison"                            # or "towing": speed and mean force, coefficient cd alone
motion = "body moves"                       # forced oscillation in still water; or "water moves": waves on a fixed body
diameter = "0.12 m"
length = "0.5 m"
mass_beyond_load_cells = "5.9 kg"           # all that the load cells accelerate, contained water included
water = { density = "997 kg/m^3", viscosity = "1.05e-6 m^2/s" }

[ask]
coefficients = ["cd", "ca"]                 # cm = 1 + ca
intervals = { level = 0.95 }
)";

constexpr const char* waves_scene =
    R"(# A sea and what its water does at fixed points. Every key is explained by `froude new --keys`.
# `froude waves info` on this file tells what the sea is; `froude waves make` writes the series.
schema = 1
title = "A sea"

[water]
density = "1025 kg/m^3"
depth = "60 m"                              # or "infinite"

[waves]
kind = "jonswap"                            # or regular, sum, components, focused_packets, tank, and other spectra
hs = "3 m"
tp = "9 s"
heading = "0 deg"                           # where the waves go: 0 deg is towards +x, 90 deg towards +y (port)
seed = 1                                    # another number is another sea of the same spectrum
spreading = { kind = "cos2s", s = 10 }      # leave it out for long crests
components = { repetition = "30 min", highest = "0.5 Hz" }

[[probe]]
name = "gauge"
at = "(0, 0, 0) m"
[[probe]]
name = "below"
at = "(0, 0, -5) m"
gives = ["velocity", "acceleration", "pressure"]

[ask]
waves = { duration = "600 s", every = "0.25 s" }
)";

std::string starter(const std::string& kind) {
  if (kind.empty() || kind == "motion") return motion_scene;
  if (kind == "fit") return fit_scene;
  if (kind == "waves") return waves_scene;
  const std::string near = hydro::nearest(kind, std::vector<std::string>{"motion", "waves", "fit"});
  throw hydro::InputError(fmt::format("\"{}\" is not a kind of scene", kind), {},
                          near.empty() ? "kinds are motion, waves and fit" : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace

void new_scene(const std::string& kind, const std::optional<Path>& output, bool keys, const Console& console) {
  const std::string text = keys ? sweep::key_reference() : starter(kind);
  Report report;
  if (output) {
    if (std::filesystem::is_regular_file(*output))
      throw hydro::InputError(fmt::format("\"{}\" is there already", output->string()), {},
                              "choose another name; nothing was written");
    hydro::io::write_atomically(*output, text);
    report.say("wrote {}", fact("file", output->string())).keep("text", text);
  } else {
    report.say("{}", fact("text", text, text.substr(0, text.size() - 1)));  // a line has its end
  }
  tell(report, console);
}

}  // namespace froude
