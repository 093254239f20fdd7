#pragma once
/// \file  Private to the commands that tell spectra: units of what is made of two signals' units.
#include <string>

namespace froude {

/// Of a density: "m" → "m^2/Hz"; the SI base units where the signal's unit is composed.
std::string density_unit(const std::string& unit);

/// Of an output by an input; empty where both have the same.
std::string gain_unit(const std::string& output, const std::string& input);

}  // namespace froude
