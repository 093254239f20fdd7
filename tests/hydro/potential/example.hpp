#pragma once
// Coefficients of examples/data.
#include <filesystem>
#include <string>

#include "hydro/potential/coefficients.hpp"
#include "support/source_dir.hpp"

namespace froude_test {

inline hydro::potential::Coefficients example(const std::string& name) {
  return hydro::potential::read(froude_test::source_dir() / "examples/data" / name);
}

}  // namespace froude_test
