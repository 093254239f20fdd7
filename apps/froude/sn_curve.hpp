#pragma once
/// \file  Private to the commands that tell fatigue: an S–N curve from the command line.
#include <optional>
#include <string>

#include "froude/commands.hpp"
#include "hydro/signal/fatigue.hpp"

namespace froude {

/// The curve, for signals of its range's dimension.
struct SnOfUnit {
  hydro::signal::SnCurve curve;  ///< SI
  std::string range;             ///< as given

  /// True if the range is of the dimension of this unit.
  bool fits(const std::string& units) const;
};

/// None if no option is given. \throws hydro::InputError naming the option that is missing or wrong
std::optional<SnOfUnit> sn_curve(const SnArguments& arguments);

/// \throws hydro::InputError unless the curve fits one of these units at least
void require_one_fits(const SnOfUnit& curve, const std::vector<std::string>& units);

}  // namespace froude
