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

/// A scene that finds the files of examples/data beside it. It takes the step that is chosen first, and whatever error
/// that and the data leave: tests say themselves how near to the truth their numbers must come.
inline froude::scene::Scene parse(const std::string& text) {
  froude::scene::Scene out = froude::scene::parse(text, examples / "data/test.toml");
  out.solve.accept_error = true;
  return out;
}

}  // namespace froude_test
