#include "answers/sea_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "hydro/waves/spectra/spreading.hpp"

namespace froude {

using hydro::Angle, hydro::InputError;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// The number of a heading, a new one if none is the same but for rounding.
std::size_t number_of(double heading, std::vector<double>& headings) {
  const auto at =
      std::find_if(headings.begin(), headings.end(), [&](double h) { return std::abs(h - heading) < 1e-9; });
  if (at == headings.end()) {
    headings.push_back(heading);
    return headings.size() - 1;
  }
  return static_cast<std::size_t>(at - headings.begin());
}

}  // namespace

const scene::RandomSea& random_sea(const scene::Scene& scene) {
  if (!scene.waves)
    throw InputError("spectra of responses need a sea, but the scene has no waves", {.file = scene.file.string()},
                     "add a [waves] table with a spectrum, such as kind = \"jonswap\"");
  const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind);
  if (!sea)
    throw InputError("spectra of responses need a random sea, which these waves are not", scene.waves->place,
                     "choose a kind with a spectrum, such as \"jonswap\"");
  if (sea->crest)
    throw InputError("a sea with a crest put in has no spectrum that tells its responses", scene.waves->place,
                     "leave the crest out, or step a run");
  return *sea;
}

double System::share(const Direction& d, double omega) const {
  if (!waves->spreading) return 1;
  const auto below = [&](double angle) { return waves->spreading->share_below(Angle::from_radians(angle), omega); };
  return below(d.to) - below(d.from);
}

System system_of(const scene::WaveSystem& waves, int sectors, std::vector<double>& headings) {
  System out{&waves, {}};
  if (!waves.spreading) {
    out.directions.push_back({number_of(waves.heading.radians(), headings), 0, 0});
    return out;
  }
  const auto quantile = [&](double share) {
    return waves.spreading->quantile(share, waves.spectrum->peak_omega()).radians();
  };
  for (int i = 0; i < sectors; ++i) {
    const double middle = std::remainder(waves.heading.radians() + quantile((i + 0.5) / sectors), two_pi);
    out.directions.push_back({number_of(middle, headings), i == 0 ? -std::numbers::pi : quantile(1.0 * i / sectors),
                              i + 1 == sectors ? std::numbers::pi : quantile((i + 1.0) / sectors)});
  }
  return out;
}

bool has_spreading(const scene::RandomSea& sea) {
  return std::any_of(sea.systems.begin(), sea.systems.end(), [](const auto& s) { return s.spreading != nullptr; });
}

SeaBand band_of(const scene::RandomSea& sea) {
  return {sea.lowest.value_or(0), sea.highest.value_or(std::numeric_limits<double>::infinity())};
}

double share_outside(const scene::RandomSea& sea, double low, double high) {
  const SeaBand band = band_of(sea);
  const bool cut = sea.lowest || sea.highest;
  double all = 0, inside = 0;
  for (const auto& system : sea.systems) {
    all += cut ? system.spectrum->energy(band.low, band.high) : system.spectrum->moment(0);
    const double from = std::max(low, band.low), to = std::min(high, band.high);
    if (to > from) inside += system.spectrum->energy(from, to);
  }
  return std::max(0.0, 1 - inside / all);
}

}  // namespace froude
