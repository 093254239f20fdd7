#pragma once
/// \file  Commands that are programs of their own, beside froude.
#include <functional>
#include <string>
#include <vector>

#include "hydro/base/error.hpp"

namespace froude {

/// Becomes the program of this name that stands beside the one that is running, with these arguments. \throws
/// hydro::InputError that `refusal` makes of the program's path and the reason, where it cannot be run
[[noreturn]] void become(
    const std::string& name, std::vector<std::string> arguments,
    const std::function<hydro::InputError(const std::string& path, const std::string& why)>& refusal);

}  // namespace froude
