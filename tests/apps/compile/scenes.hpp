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

/// A scene that finds the files of examples/data beside it.
inline froude::scene::Scene parse(const std::string& text) {
  return froude::scene::parse(text, examples / "data/test.toml");
}

}  // namespace froude_test
