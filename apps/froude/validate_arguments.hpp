#pragma once
/// \file  What `froude validate` is told. The cases are elsewhere, in froude-validate.
#include <optional>
#include <string>
#include <vector>

#include "froude/commands.hpp"

namespace froude {

struct ValidateArguments {
  std::vector<std::string> names;  ///< empty: all cases
  std::optional<Path> folder;      ///< of the cases; default: installed or source
  std::optional<Path> data;        ///< reference data; default FROUDE_REFERENCE_DATA, then ../shared/data
  std::optional<Path> page;        ///< writes the page with pictures here
  bool list = false;               ///< runs nothing
  bool reference_curves = false;   ///< also the pictures that show curves of others
};

}  // namespace froude
