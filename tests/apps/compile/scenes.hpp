#pragma once
// Scenes in text for tests of what they compile to.
#include <filesystem>
#include <string>

#include "scene/scene.hpp"
#include "support/source_dir.hpp"

namespace froude_test {

/// The water of the pontoons' coefficients.
inline const std::string water = R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
)";

inline const std::filesystem::path examples = froude_test::source_dir() / "examples";

/// A moored cylinder "b" that floats upright, its coefficients at these frequencies.
inline std::string floating_cylinder(const std::string& frequencies) {
  return R"([[body]]
name = "b"
centre_of_gravity = "(0, 0, -5) m"
mass = "402.1 t"
inertia = "(6e6, 6e6, 6e6) kg m^2"
free = ["surge", "heave", "pitch"]
[body.hydrodynamics]
excitation = true
radiation = { memory_tolerance = 1e-2 }
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "8 m"
draught = "8 m"
frequencies = ")" +
         frequencies + R"("
[[mooring]]
on = "b"
kind = "linear"
stiffness = { surge = "20 kN/m" }
)";
}

/// A scene that finds the files of examples/data beside it. It takes the step that is chosen first, and whatever error
/// that and the data leave: tests say themselves how near to the truth their numbers must come.
inline froude::scene::Scene parse(const std::string& text) {
  froude::scene::Scene out = froude::scene::parse(text, examples / "data/test.toml");
  out.solve.accept_error = true;
  return out;
}

}  // namespace froude_test
