#pragma once
/// \file  What `froude bem info` says of files of motions, mean drift and quadratic loads.
#include <nlohmann/json.hpp>

#include <string>

#include "froude/commands.hpp"
#include "hydro/potential/responses.hpp"

namespace froude {

/// Frequencies, headings and the largest value of each mode. \throws InputError as the readers do
nlohmann::json response_info(const Path& file, const hydro::potential::ReadOptions& options);
std::string response_text(const Path& file, const hydro::potential::ReadOptions& options);

}  // namespace froude
