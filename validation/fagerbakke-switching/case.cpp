#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "harness/case.hpp"
#include "hydro/signal/fft.hpp"

namespace froude::validation::fagerbakke_switching {
namespace {

constexpr double duration = 1200, change = 600, fade = 40, amplitude = 0.3, before = 7.5, after = 3.5,
                 pi = std::numbers::pi;

/// Share of the later waves: grows over the fade about the change, and back at the end, where the sea repeats.
double later(double t) {
  const auto grown = [](double s) { return s <= -0.5 ? 0 : s >= 0.5 ? 1 : (1 + std::sin(pi * s)) / 2; };
  return grown((t - change) / fade) - grown((t - duration + fade / 2) / fade);
}

/// The elevation at the origin as a sum of linear waves towards +x, what is below 1e-5 m left out.
scene::WaveList sea() {
  constexpr std::size_t samples = 1 << 14;
  std::vector<double> elevation(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = duration * static_cast<double>(i) / samples, s = later(t);
    elevation[i] = amplitude * ((1 - s) * std::cos(2 * pi * t / before) + s * std::cos(2 * pi * t / after));
  }
  const auto spectrum = hydro::signal::real_fft(elevation);
  scene::WaveList list;
  for (std::size_t k = 1; k + 1 < spectrum.size(); ++k) {
    const std::complex<double> a = 2.0 / samples * spectrum[k];
    if (std::abs(a) < 1e-5) continue;
    list.waves.push_back({hydro::AngularFrequency::from_rad_per_s(2 * pi * static_cast<double>(k) / duration),
                          hydro::WaveAmplitude::from_metres(std::abs(a)), std::arg(a), hydro::Angle::from_radians(0)});
  }
  return list;
}

double deviation(const std::vector<double>& x, std::size_t from) {
  double mean = 0, square = 0;
  const double n = static_cast<double>(x.size() - from);
  for (std::size_t i = from; i < x.size(); ++i) mean += x[i] / n;
  for (std::size_t i = from; i < x.size(); ++i) square += (x[i] - mean) * (x[i] - mean) / n;
  return std::sqrt(square);
}

double entry(const Run& record, const std::string& name) {
  for (const auto& [what, joules] : record.energy)
    if (what == name) return joules;
  return std::nan("");
}

}  // namespace

Outcome outcome(const Folders& folders) {
  scene::Scene with = scene::read(folders.own() / "scene.toml");
  with.waves->kind = sea();
  scene::Scene without = with;
  for (auto& c : without.connectors) std::get<scene::AxialConnector>(c.kind).switching.reset();
  const Run switched = simulate(with), fixed = simulate(without);
  const auto &t = switched.time, &k = switched.signal("spring1.stiffness");
  double switches = 0, at = 0;
  for (std::size_t i = 1; i < k.size(); ++i)
    if (k[i] != k[i - 1]) ++switches, at = t[i];
  std::size_t settled = 0;
  while (settled + 1 < t.size() && t[settled] < at + 60) ++settled;
  // The sea fades back to the longer waves over its last 40 s.
  const auto cut = [&](const std::vector<double>& x) {
    return std::vector<double>(x.begin(), x.end() - static_cast<std::ptrdiff_t>(std::lround(2 * fade / (t[1] - t[0]))));
  };
  const auto &m2 = switched.signal("m2.surge"), &m2_fixed = fixed.signal("m2.surge");
  Outcome out;
  out.numbers = {{"switches", switches, ""},
                 {"time from the change of waves to the switch", at - change, "s"},
                 {"surge of module 2 after the switch, standard deviation over that without a switch",
                  deviation(cut(m2), settled) / deviation(cut(m2_fixed), settled), ""},
                 {"energy residual, over that turned over",
                  std::abs(entry(switched, "residual")) / entry(switched, "turnover"), ""}};
  plot::Figure f{.title = "Two modules when waves of 7.5 s become waves of 3.5 s",
                 .panels = {{.x = {"time", "s"}, .y = {"surge of module 2", "m"}, .series = {}},
                            {.x = {"time", "s"}, .y = {"stiffness", "N/m"}, .series = {}}}};
  f.panels[0].series = {{.name = "without switch", .x = fixed.time, .y = m2_fixed},
                        {.name = "with switch", .x = t, .y = m2}};
  f.panels[1].series = {{.name = "of each spring", .x = t, .y = k}};
  out.pictures.push_back({"surge", "The controller waits until two checks in turn agree on the new period.", f});
  return out;
}

}  // namespace froude::validation::fagerbakke_switching
