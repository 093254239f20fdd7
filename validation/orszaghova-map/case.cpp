#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "compile/compile.hpp"
#include "dynamics/frequency/modes.hpp"
#include "froude/simulate.hpp"
#include "harness/case.hpp"
#include "hydro/signal/harmonics.hpp"

namespace froude::validation::orszaghova_map {
namespace {

constexpr double pi = std::numbers::pi;

scene::Scene buoy() { return scene::read(std::filesystem::path(FROUDE_VALIDATION_SOURCE) / "../examples/buoy.toml"); }

/// The last third of a run in one regular wave.
struct Response {
  double pivot, rack;  ///< standard deviations, rad and m
  bool doubled;        ///< more at half the wave's frequency than at it
};

double deviation(std::span<const double> x) {
  double mean = 0, square = 0;
  const double n = static_cast<double>(x.size());
  for (const double v : x) mean += v / n;
  for (const double v : x) square += (v - mean) * (v - mean) / n;
  return std::sqrt(square);
}

Response respond(scene::Scene scene, double period, double height) {
  scene.waves->kind = scene::RegularWave{height / 2, period};
  const Record run = simulate(scene);
  const std::size_t from = run.time.size() * 2 / 3;
  const std::span<const double> t(run.time.begin() + static_cast<std::ptrdiff_t>(from), run.time.end());
  const auto last = [&](const char* name) {
    const auto& x = run.signal(name);
    return std::span<const double>(x.begin() + static_cast<std::ptrdiff_t>(from), x.end());
  };
  const std::vector<double> omega{pi / period, 2 * pi / period};
  const auto tones = hydro::signal::fit_harmonics(t, last("pivot.angle"), omega);
  return {deviation(last("pivot.angle")), deviation(last("rack.travel")),
          std::abs(tones.amplitude[0]) > std::abs(tones.amplitude[1])};
}

/// The slowest oscillation about rest: the pivot's.
double natural_period(const scene::Scene& scene) {
  const compile::Prepared prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  return 2 * pi / dynamics::frequency::free_motions(model, prepared.groups).modes.front().omega;
}

}  // namespace

Outcome outcome(const Folders&) {
  const scene::Scene scene = buoy();
  const double natural = natural_period(scene), half = natural / 2;
  std::vector<double> periods{5, 6, 6.5, 9, 10, 12, natural, 17};
  for (const double of_half : {0.93, 0.96, 1.0, 1.04, 1.08, 1.12, 1.16}) periods.push_back(of_half * half);
  std::sort(periods.begin(), periods.end());
  const std::vector<double> heights{1, 2, 4};
  std::vector<std::vector<Response>> map;
  std::vector<int> doubled;
  for (const double H : heights) {
    map.emplace_back();
    for (const double T : periods) map.back().push_back(respond(scene, T, H));
    doubled.push_back(static_cast<int>(
        std::count_if(map.back().begin(), map.back().end(), [](const Response& r) { return r.doubled; })));
  }
  const auto at = [&](double period) -> const Response& {
    return map[1][static_cast<std::size_t>(std::find(periods.begin(), periods.end(), period) - periods.begin())];
  };
  const Response& branch = at(half);
  const double linear_rack = 20 * respond(scene, half, 0.1).rack;  // too low for the pivot to grow
  Outcome out;
  out.numbers = {
      {"natural period of the pivot, with the added mass of its own frequency", natural, "s"},
      {"period doubling at H = 2 m: at half the natural period", branch.doubled ? 1.0 : 0.0, ""},
      {"period doubling at H = 2 m: at 6.5 s", at(6.5).doubled ? 1.0 : 0.0, ""},
      {"period doubling at H = 2 m: at 9 s", at(9).doubled ? 1.0 : 0.0, ""},
      {"standard deviation of the pivot at H = 2 m and half its natural period", branch.pivot * 180 / pi, "deg"},
      {"rack at H = 2 m and half the natural period, over that of the linear response", branch.rack / linear_rack, ""},
      {"periods of doubling at H = 4 m less those at H = 1 m, of those run",
       static_cast<double>(doubled[2] - doubled[0]), ""}};
  plot::Figure f{.title = "The moored buoy in regular waves",
                 .panels = {{.x = {"wave period", "s"}, .y = {"pivot, standard deviation", "deg"}, .series = {}},
                            {.x = {"wave period", "s"}, .y = {"rack, standard deviation", "m"}, .series = {}}}};
  for (std::size_t h = 0; h < heights.size(); ++h) {
    plot::Series pivot{.name = fmt::format("H = {} m", heights[h]), .x = periods, .y = {}}, rack = pivot;
    for (const Response& r : map[h]) {
      pivot.y.push_back(r.pivot * 180 / pi);
      rack.y.push_back(r.rack);
    }
    f.panels[0].series.push_back(std::move(pivot));
    f.panels[1].series.push_back(std::move(rack));
  }
  out.pictures.push_back(
      {"map", "The pivot grows by itself about half its natural period, and there the rack moves less.", f});
  return out;
}

}  // namespace froude::validation::orszaghova_map
