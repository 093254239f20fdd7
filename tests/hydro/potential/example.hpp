#pragma once
// Coefficients of examples/data.
#include <filesystem>
#include <string>

#include "hydro/potential/coefficients.hpp"

namespace froude_test {

inline hydro::potential::Coefficients example(const std::string& name) {
  return hydro::potential::read(std::filesystem::path(FROUDE_SOURCE_DIR) / "examples/data" / name);
}

}  // namespace froude_test
