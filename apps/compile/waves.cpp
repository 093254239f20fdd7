#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "compile/compile.hpp"
#include "hydro/waves/spectrum.hpp"

namespace froude::compile {
namespace {

using hydro::waves::Jonswap;

Jonswap spectrum_of(const scene::Waves& waves) {
  if (const auto* j = std::get_if<scene::Jonswap>(&waves.kind)) return {j->hs, j->tp, j->gamma};
  const auto& p = std::get<scene::PiersonMoskowitz>(waves.kind);
  return hydro::waves::pierson_moskowitz(p.hs, p.tp);
}

/// The frequency with the given share of the energy above it.
double frequency_with_share_above(const Jonswap& spectrum, double share) {
  double low = 0.2 * 2 * std::numbers::pi / spectrum.tp(), high = 100 * low;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (spectrum.energy(middle, std::numeric_limits<double>::infinity()) > share * spectrum.moment(0) ? low : high) =
        middle;
  }
  return high;
}

/// The band where every group that feels the waves has coefficients.
std::pair<double, double> band_of_data(const Prepared& prepared) {
  std::pair<double, double> band{0, std::numeric_limits<double>::infinity()};
  for (const auto& g : prepared.groups)
    if (g.excitation) band = {std::max(band.first, g.table.lowest()), std::min(band.second, g.table.highest())};
  return band;
}

}  // namespace

double highest_relevant_frequency(const scene::Waves& waves) {
  if (const auto* regular = std::get_if<scene::RegularWave>(&waves.kind)) return 2 * std::numbers::pi / regular->period;
  constexpr double share = 0.05;  // what is above is followed less exactly, and weighs little
  return frequency_with_share_above(spectrum_of(waves), share);
}

hydro::waves::Sea make_sea(const scene::Scene& scene, const Prepared& prepared, double repetition_s) {
  const scene::Waves& waves = *scene.waves;
  if (const auto* regular = std::get_if<scene::RegularWave>(&waves.kind))
    return hydro::waves::Sea::regular(hydro::WaveAmplitude::from_metres(regular->amplitude),
                                      hydro::AngularFrequency::from_period_s(regular->period), waves.heading,
                                      scene.water);
  const Jonswap spectrum = spectrum_of(waves);
  // A millionth of the energy on either side is below anything asked; leaving it out keeps the number of components
  // small.
  constexpr double negligible = 1e-6;
  const auto [data_low, data_high] = band_of_data(prepared);
  const double low = std::max(data_low, frequency_with_share_above(spectrum, 1 - negligible));
  const double high = std::min(data_high, frequency_with_share_above(spectrum, negligible));
  const double outside = 1 - spectrum.energy(low, high) / spectrum.moment(0);
  if (outside > scene.accuracy)
    throw hydro::InputError(fmt::format("{:.2g} % of the sea's energy lies outside the frequencies of the data, {:.4g} "
                                        "to {:.4g} rad/s; the accuracy asked is {:.2g} %",
                                        100 * outside, data_low, data_high, 100 * scene.accuracy),
                            waves.place,
                            "compute the coefficients for a wider band, choose another sea, or ask for less accuracy");
  return hydro::waves::Sea::irregular(
      spectrum, {.repetition_s = repetition_s, .omega_min = low, .omega_max = high, .seed = waves.seed}, waves.heading,
      scene.water);
}

}  // namespace froude::compile
