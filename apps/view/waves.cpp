// The surface of the waves of a run, held against the recorded elevation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/waves.hpp"
#include "hydro/base/error.hpp"
#include "view/parts.hpp"

namespace froude::view {
namespace {

constexpr std::size_t most_along_one_way = 1200, most_short_crested = 250;  // the page sums them at each frame
constexpr double share_of_variance = 0.999, largest_departure = 0.25;

double variance(const std::vector<hydro::waves::Component>& waves) {
  double sum = 0;
  for (const auto& w : waves) sum += w.amplitude * w.amplitude / 2;
  return sum;
}

/// The largest components that hold the share shown, or as many as may be.
std::vector<hydro::waves::Component> largest_of(std::vector<hydro::waves::Component> waves) {
  std::sort(waves.begin(), waves.end(), [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  const double all = variance(waves);
  double held = 0;
  const bool one_way =
      std::all_of(waves.begin(), waves.end(), [&](const auto& w) { return w.heading == waves[0].heading; });
  const std::size_t most = std::min(waves.size(), one_way ? most_along_one_way : most_short_crested);
  std::size_t count = 0;
  while (count < most && held < share_of_variance * all)
    held += waves[count].amplitude * waves[count].amplitude / 2, ++count;
  waves.resize(count);
  return waves;
}

/// Rms of what the components differ by from the recorded elevation at the origin, over the rms of that.
double departure(const std::vector<hydro::waves::Component>& waves, const RunResult& run,
                 const std::vector<double>& recorded, double ramp) {
  double off = 0, all = 0;
  const std::size_t stride = std::max<std::size_t>(1, run.time.size() / 2000);
  for (std::size_t i = 0; i < run.time.size(); i += stride) {
    double sum = 0;
    for (const auto& w : waves)
      sum += grown(run.time[i], ramp) * w.amplitude * std::cos(w.omega * run.time[i] + w.phase);
    off += (sum - recorded[i]) * (sum - recorded[i]), all += recorded[i] * recorded[i];
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

}  // namespace

double grown(double t, double ramp) { return t < ramp ? (1 - std::cos(std::numbers::pi * t / ramp)) / 2 : 1; }

std::optional<Surface> surface_of(const scene::Scene& scene, const RunResult& run, const Recorded& recorded,
                                  std::vector<std::string>& notes) {
  if (!scene.waves) return std::nullopt;
  std::vector<hydro::waves::Component> all;
  try {
    all = compile::free_waves(scene).components();
  } catch (const hydro::InputError& e) {
    notes.push_back(
        fmt::format("The surface is drawn flat: the waves of the scene are no sum of linear waves ({}).", e.rule()));
    return std::nullopt;
  }
  auto shown = largest_of(all);
  std::string told =
      shown.size() < all.size()
          ? fmt::format("The surface is the sum of the {} largest of {} waves, with {:.3g} % of their variance",
                        shown.size(), all.size(), 100 * variance(shown) / variance(all))
          : fmt::format("The surface is the sum of all waves of the scene, {}", all.size());
  if (const auto* elevation = recorded.find("wave.elevation")) {
    const double off = departure(shown, run, *elevation, scene.waves->ramp);
    if (off > largest_departure) {
      notes.push_back(
          fmt::format("The surface is drawn flat: a sum of linear waves would be {:.0f} % off the recorded "
                      "elevation.",
                      100 * off));
      return std::nullopt;
    }
    told += fmt::format("; at the origin it differs from the recorded elevation by {:.2g} % (rms)", 100 * off);
  } else {
    told += "; the result keeps no wave.elevation to hold it against";
  }
  notes.push_back(told + ". Waves that the bodies make or scatter are not drawn.");
  return Surface{scene.waves->ramp, std::move(shown)};
}

}  // namespace froude::view
