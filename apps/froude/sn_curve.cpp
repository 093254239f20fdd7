#include "froude/sn_curve.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

hydro::Dimension dimension_of(const std::string& units) {
  return hydro::parse_unit(units.empty() ? "1" : units).dimension;
}

}  // namespace

bool SnOfUnit::fits(const std::string& units) const {
  return hydro::compatible(hydro::parse_quantity(range).dimension, dimension_of(units));
}

std::optional<SnOfUnit> sn_curve(const SnArguments& a) {
  if (!a.range && !a.cycles && !a.slope && !a.slope_below) return std::nullopt;
  if (!a.range || !a.cycles || !a.slope)
    throw hydro::InputError("an S-N curve needs a range, the cycles that it may come and a slope",
                            {.file = "command line"},
                            "give --sn-range, --sn-cycles and --sn-slope, for example \"50 MPa\", 1e7 and 3");
  return scene::placed({.file = "--sn-range"}, [&] {
    const hydro::Quantity range = hydro::parse_quantity(*a.range);
    SnOfUnit out{{.knee_range = range.si, .knee_cycles = *a.cycles, .slope = *a.slope, .slope_below = a.slope_below},
                 *a.range};
    out.curve.check();
    return out;
  });
}

void require_one_fits(const SnOfUnit& curve, const std::vector<std::string>& units) {
  if (std::any_of(units.begin(), units.end(), [&](const auto& u) { return curve.fits(u); })) return;
  throw hydro::InputError(fmt::format("--sn-range \"{}\" is of the dimension of no signal", curve.range),
                          {.file = "command line"}, fmt::format("their units are: {}", fmt::join(units, ", ")));
}

}  // namespace froude
