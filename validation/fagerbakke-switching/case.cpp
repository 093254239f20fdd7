#include <cmath>

#include "answers/simulate.hpp"
#include "harness/case.hpp"

namespace froude::validation::fagerbakke_switching {
namespace {

constexpr double change = 600;  // s, the middle of the fade

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
  const scene::Scene with = scene::read(folders.own() / "scene.toml");
  scene::Scene without = with;
  for (auto& c : without.connectors) std::get<scene::AxialConnector>(c.kind).switching.reset();
  const Run switched = simulate(with), fixed = simulate(without);
  const auto &t = switched.time, &k = switched.signal("spring1.stiffness");
  double switches = 0, at = 0;
  for (std::size_t i = 1; i < k.size(); ++i)
    if (k[i] != k[i - 1]) ++switches, at = t[i];
  std::size_t settled = 0;
  while (settled + 1 < t.size() && t[settled] < at + 60) ++settled;
  const auto &m2 = switched.signal("m2.surge"), &m2_fixed = fixed.signal("m2.surge");
  Outcome out;
  out.numbers = {{"switches", switches, ""},
                 {"time from the change of waves to the switch", at - change, "s"},
                 {"surge of module 2 after the switch, standard deviation over that without a switch",
                  deviation(m2, settled) / deviation(m2_fixed, settled), ""},
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
