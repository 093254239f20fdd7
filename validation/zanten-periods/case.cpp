#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::zanten_periods {

Outcome outcome(const Folders& folders) {
  constexpr double g = 9.81;  // m/s²: reproduces the printed restoring coefficients m g c
  const auto table = hydro::io::CsvTable::read(folders.reference("pendulums.csv"));
  const std::vector<std::string>& properties = table.text_column("property");
  Outcome outcome;
  for (const std::string name : {"long", "medium", "short"}) {
    const auto of = [&](const std::string& property) {
      const auto at = std::find(properties.begin(), properties.end(), property);
      hydro::require(at != properties.end(), "pendulums.csv has no row \"{}\"", property);
      return table.column(name)[static_cast<std::size_t>(at - properties.begin())];
    };
    const double lever = of("length_1") + of("cog_2");  // of the lower part's centre of gravity
    const double inertia = of("inertia_1_about_cog") + of("mass_1") * std::pow(of("cog_1"), 2) +
                           of("inertia_2_about_cog") + of("mass_2") * lever * lever;
    const double restoring = of("restoring_1") + of("restoring_2") + of("mass_2") * g * of("length_1");
    outcome.numbers.push_back(
        {"period of the " + name + " pendulum", 2 * std::numbers::pi * std::sqrt(inertia / restoring), "s"});
  }
  return outcome;
}

}  // namespace froude::validation::zanten_periods
