#include "report/spectra_of_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"

namespace froude::html {
namespace {

namespace hs = hydro::signal;

constexpr double confidence = 0.95, share_shown = 0.9999;
constexpr std::size_t most_densities = 300'000, most_of_phase = 3000;

/// The first index by which that share of the sum lies.
std::size_t end_of_variance(const std::vector<double>& density) {
  double sum = 0, so_far = 0;
  for (const double s : density) sum += s;
  for (std::size_t i = 0; i < density.size(); ++i)
    if ((so_far += density[i]) >= share_shown * sum) return i + 1;
  return density.size();
}

/// True where more than a fifth of the variance lies below 1.5 divisions: periods that hardly fit into a segment.
bool is_unresolved(const std::vector<double>& density) {
  constexpr double share_too_slow = 0.2;
  double sum = 0;
  for (const double s : density) sum += s;
  return density.size() < 3 || density[0] + density[1] > share_too_slow * sum;
}

struct NamedDensity {
  std::string name;
  std::vector<double> density;
};

Json densities_told(const std::vector<double>& frequency, const std::vector<NamedDensity>& all) {
  std::size_t end = 2;
  for (const NamedDensity& one : all) end = std::max(end, end_of_variance(one.density));
  end = std::min(end + end / 5, frequency.size());
  const Thinning thinning(end, std::max<std::size_t>(200, most_densities / std::max<std::size_t>(all.size(), 1)));
  Json signals = Json::object();
  for (const NamedDensity& one : all)
    signals[one.name] = single_array(thinning.values(std::span(one.density).first(end)));
  return {{"frequency", double_array(thinning.times(std::span(frequency).first(end)))},
          {"signals", signals},
          {"end", frequency[end - 1]},
          {"piece", thinning.piece()}};
}

}  // namespace

Json spectra_of(const RunResult& run, std::size_t first) {
  try {
    const std::span<const double> time = std::span(run.time).subspan(first);
    const double step = hs::even_step(time);
    const hs::WelchOptions options = hs::fifteen_segments(time.size());
    std::vector<NamedDensity> all;
    std::vector<double> frequency;
    double dof = 0, resolution = 0;
    Json unresolved = Json::array();
    for (const Signal& s : run.signals) {
      const auto values = std::span(s.values).subspan(first);
      const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
      if (is_of_energy(s.name) || !finite) continue;
      hs::WelchSpectrum w = hs::welch(values, step, options);
      if (w.variance <= 1e-24 * w.mean * w.mean) continue;  // rounding of a constant is no motion
      if (is_unresolved(w.spectrum.density)) unresolved.push_back(s.name);
      frequency = std::move(w.spectrum.frequency_hz);
      dof = w.dof, resolution = w.resolution_hz;
      all.push_back({s.name, std::move(w.spectrum.density)});
    }
    if (all.empty()) return {{"missing", "No signal of this run varies, so there is no spectrum."}};
    Json out = densities_told(frequency, all);
    const hs::BandFactors band = hs::confidence_band(dof, confidence);
    out.update({{"low", band.lower},
                {"high", band.upper},
                {"confidence", confidence},
                {"dof", dof},
                {"unresolved", unresolved},
                {"segment", static_cast<double>(options.segment) * step},
                {"resolution", resolution}});
    return out;
  } catch (const hydro::InputError& e) {
    return {{"missing", fmt::format("There are no spectra: {}.", e.rule())}};
  }
}

Json phase_of(const RunResult& run, std::size_t first) {
  const std::size_t n = run.time.size();
  const std::size_t begin = n - first > most_of_phase ? n - most_of_phase : first;
  const auto& t = run.time;
  Json signals = Json::object();
  for (const Signal& s : run.signals) {
    if (is_of_energy(s.name)) continue;
    std::vector<double> rate;
    for (std::size_t i = begin; i < n; ++i) {
      const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, n - 1);
      rate.push_back((s.values[after] - s.values[before]) / (t[after] - t[before]));
    }
    signals[s.name] = {{"x", single_array(std::span(s.values).subspan(begin))}, {"v", single_array(rate)}};
  }
  return {{"from", t[begin]}, {"to", t.back()}, {"whole", begin == first}, {"signals", signals}};
}

}  // namespace froude::html
