#pragma once
/// \file  Private to apps: solved coefficients that outlive the program, in the folder of fits.
#include <filesystem>
#include <optional>
#include <string>

#include "hydro/potential/coefficients.hpp"

namespace froude::compile {

/// Where coefficients lie that were kept by this key, all that decides on every bit of them; none where they do not.
std::optional<std::filesystem::path> folder_of_kept(const std::string& key);

/// They, with a note that says so. `water`: that of the key.
std::optional<hydro::potential::Coefficients> kept_coefficients(const std::string& key, const hydro::Water& water);

/// Kept as they are, where this process has a folder.
void keep_coefficients(const std::string& key, const hydro::potential::Coefficients& coefficients);

}  // namespace froude::compile
