#pragma once
// Scenes to read in tests, and what the reader says of wrong ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "scene/scene.hpp"

namespace froude::scene {

// Line 1 is `schema`; tests count on the lines as they stand here.
inline const std::string sphere = R"(schema = 1
title = "sphere"
[water]
density = "1000 kg/m^3"
depth = "infinite"
[waves]
kind = "regular"
height = "2 m"
period = "8 s"
heading = "0 deg"
[[body]]
name = "sphere"
mass = "261.8 t"
free = ["heave"]
[body.hydrodynamics]
file = "sphere.nc"
excitation = true
radiation = {}
hydrostatics = true
[ask]
run = { duration = "40 s", every = "0.02 s" }
)";

/// Five modules of four cylinders, moored at both ends.
inline const std::string pontoons = R"(schema = 1
title  = "Five modules, moored at both ends"
[water]
density = "1000 kg/m^3"
depth   = "14 m"
[waves]
kind = "jonswap"
hs = "1.2 m"
tp = "6 s"
heading = "30 deg"
[[body]]
name = "m"
copies = { count = 5, step = "(13, 0, 0) m" }
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
initial = { heave = "10 cm", pitch = "5 deg" }
[body.hydrodynamics]
file = "data/pontoon5.nc"
excitation = true
radiation = { memory_tolerance = 1e-3 }
hydrostatics = true
[[member]]
on = "m*"
from = "(±5.2, ±5.2, -1.13) m"
to = "(±5.2, ±5.2, 0) m"
diameter = "1.6 m"
drag = { cd = 1.0 }
[[mooring]]
on = ["m1", "m5"]
kind = "linear"
stiffness = { surge = "4280 N/m", sway = "10348 N/m", yaw = "15839 N m/rad" }
[[connector]]
between = "neighbours of m"
ends = ["(6, ±5, 0.5) m", "(-6, ±5, 0.5) m"]
kind = "axial"
stiffness = "29332 N/m"
rest_length = "as placed"
[ask]
rao = { periods = "2 s .. 8 s, 61 values", of = ["m*.surge", "m*.heave", "connector*.force"] }
run = { duration = "600 s", every = "0.05 s" }
accuracy = 1e-2
)";

/// `text` with the first `from` replaced; a test that finds nothing to replace is itself wrong.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "nothing to replace: " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// What the reader says, whole; fails if it says nothing.
inline std::string refusal(const std::string& text) {
  try {
    parse(text, "scene.toml");
  } catch (const hydro::InputError& error) {
    EXPECT_FALSE(error.where().text.empty()) << "the offending line is not shown: " << error.what();
    return error.what();
  }
  ADD_FAILURE() << "was accepted:\n" << text;
  return {};
}

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

}  // namespace froude::scene
