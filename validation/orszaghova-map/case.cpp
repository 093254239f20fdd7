#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "answers/answers.hpp"
#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "dynamics/frequency/modes.hpp"
#include "harness/case.hpp"
#include "hydro/signal/harmonics.hpp"

namespace froude::validation::orszaghova_map {
namespace {

constexpr double pi = std::numbers::pi;

/// Runs that are long enough for a disturbance to show that grows by a per cent a period.
scene::Scene buoy() {
  scene::Scene out = scene::read(source_folder() / "../examples/buoy.toml");
  out.run->duration = 2400;
  return out;
}

/// The last third of a run in one regular wave.
struct Response {
  double pivot, rack;  ///< standard deviations, rad and m
  bool doubled;        ///< at half the wave's frequency a tenth and more of what there is at it
};

double deviation(std::span<const double> x) {
  double mean = 0, square = 0;
  const double n = static_cast<double>(x.size());
  for (const double v : x) mean += v / n;
  for (const double v : x) square += (v - mean) * (v - mean) / n;
  return std::sqrt(square);
}

Response respond(scene::Scene scene, const compile::Prepared& prepared, double period, double height) {
  scene.waves->kind = scene::RegularWave{height / 2, period};
  const Run run = run_model(scene, compile::time_model(scene, prepared));  // comparisons tell its error
  const std::size_t from = run.time.size() * 2 / 3;
  const std::span<const double> t(run.time.begin() + static_cast<std::ptrdiff_t>(from), run.time.end());
  const auto last = [&](const char* name) {
    const auto& x = run.signal(name);
    return std::span<const double>(x.begin() + static_cast<std::ptrdiff_t>(from), x.end());
  };
  const std::vector<double> omega{pi / period, 2 * pi / period};
  const auto tones = hydro::signal::fit_harmonics(t, last("pivot.angle"), omega);
  return {deviation(last("pivot.angle")), deviation(last("rack.stroke")),
          std::abs(tones.amplitude[0]) > 0.1 * std::abs(tones.amplitude[1])};
}

/// The slowest oscillation about rest: the pivot's.
double natural_period(const scene::Scene& scene) {
  const compile::Prepared prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  return 2 * pi / dynamics::frequency::free_motions(model, prepared.groups).modes.front().omega;
}

/// Waves push the buoy up and down alone: what the pivot does then, its own instability does.
scene::Scene without_pivot_excitation(scene::Scene scene) {
  scene.bodies.front().hydrodynamics->excited = {false, false, true, false, false, false};
  return scene;
}

/// Standard deviation of the rack in waves of this height by the linear response, in which the pivot plays no part.
std::vector<double> one_degree_of_freedom(scene::Scene scene, const std::vector<double>& periods, double height) {
  scene.rao.emplace();
  for (auto T = periods.rbegin(); T != periods.rend(); ++T) scene.rao->omega.push_back(2 * pi / *T);
  scene.rao->headings = {0};  // as the waves of the runs
  scene.rao->of = {"rack.stroke"};
  const Responses responses = froude::respond(scene);
  std::vector<double> out;
  for (const auto& per_metre : responses.signal("rack.stroke").values)
    out.insert(out.begin(), std::abs(per_metre) * height / 2 / std::numbers::sqrt2);
  return out;
}

std::size_t index_of(const std::vector<double>& all, double one) {
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), one) - all.begin());
}

/// All periods in waves of each height.
struct Map {
  std::vector<double> heights, periods;
  std::vector<std::vector<Response>> rows;
  StabilityMap floquet;

  Map(scene::Scene scene, std::vector<double> of_heights, const std::vector<double>& of_periods)
      : heights(std::move(of_heights)), periods(of_periods) {
    const compile::Prepared prepared = compile::prepare(scene);
    for (const double H : heights) {
      rows.emplace_back();
      for (const double T : periods) rows.back().push_back(respond(scene, prepared, T, H));
    }
    scene.stability->periods = periods, scene.stability->heights = heights;
    floquet = stability(scene);
  }
  /// Share of the cells whose run doubles its period if, and only if, the multipliers say so.
  double agreement() const {
    double agree = 0;
    for (std::size_t c = 0; c < floquet.cells.size(); ++c) {
      const bool doubles = floquet.cells[c].fate == dynamics::frequency::Fate::doubled;
      agree += doubles == rows[c / periods.size()][c % periods.size()].doubled ? 1 : 0;
    }
    return agree / static_cast<double>(floquet.cells.size());
  }
  /// Cells in which no periodic motion is found, or it ends as the runs cannot tell by doubling.
  double other_fates() const {
    return static_cast<double>(std::count_if(floquet.cells.begin(), floquet.cells.end(), [](const auto& c) {
      using dynamics::frequency::Fate;
      return c.fate != Fate::stable && c.fate != Fate::doubled;
    }));
  }
  const Response& at(double height, double period) const {
    return rows[index_of(heights, height)][index_of(periods, period)];
  }
  double doubled(double height) const {
    const auto& row = rows[index_of(heights, height)];
    return static_cast<double>(std::count_if(row.begin(), row.end(), [](const Response& r) { return r.doubled; }));
  }
  /// Panels of the pivot and of the rack.
  std::vector<plot::Panel> panels(const std::string& what) const {
    std::vector<plot::Panel> out{{.x = {"wave period", "s"}, .y = {"pivot, " + what, "deg"}, .series = {}},
                                 {.x = {"wave period", "s"}, .y = {"rack, " + what, "m"}, .series = {}}};
    for (std::size_t h = 0; h < heights.size(); ++h) {
      plot::Series pivot{.name = fmt::format("H = {} m", heights[h]), .x = periods, .y = {}}, rack = pivot;
      for (const Response& r : rows[h]) {
        pivot.y.push_back(r.pivot * 180 / pi);
        rack.y.push_back(r.rack);
      }
      out[0].series.push_back(std::move(pivot));
      out[1].series.push_back(std::move(rack));
    }
    return out;
  }
};

}  // namespace

Outcome outcome(const Folders&) {
  const scene::Scene scene = buoy();
  const double natural = natural_period(scene), half = natural / 2;
  std::vector<double> periods{4.5, 5, 6, 6.5, 9, 10, 12, 0.95 * natural, natural, 1.05 * natural, 17, 20};
  for (const double of_half : {0.93, 0.96, 1.0, 1.04, 1.08, 1.12, 1.16}) periods.push_back(of_half * half);
  std::sort(periods.begin(), periods.end());
  const Map map(scene, {0.5, 1, 2, 4}, periods), own(without_pivot_excitation(scene), {4}, periods);
  const std::vector<double> linear = one_degree_of_freedom(scene, periods, 2);
  const auto linear_rack = [&](double H, double T) { return linear[index_of(periods, T)] * H / 2; };
  Outcome out;
  out.numbers = {
      {"natural period of the pivot, with the added mass of its own frequency", natural, "s"},
      {"period doubling at H = 2 m: at half the natural period", map.at(2, half).doubled ? 1.0 : 0.0, ""},
      {"period doubling at H = 2 m: at 6.5 s", map.at(2, 6.5).doubled ? 1.0 : 0.0, ""},
      {"period doubling at H = 2 m: at 9 s", map.at(2, 9).doubled ? 1.0 : 0.0, ""},
      {"standard deviation of the pivot at H = 2 m and half its natural period", map.at(2, half).pivot * 180 / pi,
       "deg"},
      {"rack at H = 2 m and half the natural period, over that of one degree of freedom",
       map.at(2, half).rack / linear_rack(2, half), ""},
      {"periods of doubling at H = 4 m less those at H = 1 m, of those run", map.doubled(4) - map.doubled(1), ""},
      {"share of cells in which runs double their period where the multipliers say so, and there alone",
       map.agreement(), ""},
      {"cells with another fate than to last or to double, or with none", map.other_fates(), ""},
      {"excitation of the pivot suppressed, H = 4 m: share of such cells", own.agreement(), ""},
      {"excitation of the pivot suppressed, H = 4 m: pivot at half its natural period over that at 9 s",
       own.at(4, half).pivot / own.at(4, 9).pivot, ""},
      {"excitation of the pivot suppressed, H = 4 m: period doubling at half its natural period",
       own.at(4, half).doubled ? 1.0 : 0.0, ""},
      {"excitation of the pivot suppressed, H = 4 m: pivot at its natural period over that at 12 s",
       own.at(4, natural).pivot / own.at(4, 12).pivot, ""},
      {"excitation of the pivot suppressed, H = 4 m: period doubling at its natural period",
       own.at(4, natural).doubled ? 1.0 : 0.0, ""},
      {"rack at H = 0.5 m and 5 s, over that of one degree of freedom", map.at(0.5, 5).rack / linear_rack(0.5, 5), ""}};
  plot::Figure all{.title = "The moored buoy in regular waves", .panels = map.panels("standard deviation")};
  all.panels[1].series.push_back({.name = "H = 2 m, one degree of freedom", .x = periods, .y = linear});
  out.pictures.push_back({"map",
                          "The pivot grows by itself about half its natural period, and there the rack moves less.",
                          std::move(all)});
  out.pictures.push_back(
      {"own",
       "With waves that push in heave alone the two branches stand by themselves: at half the natural period and at "
       "it.",
       {.title = "The moored buoy, excitation of the pivot suppressed", .panels = own.panels("standard deviation")}});
  return out;
}

}  // namespace froude::validation::orszaghova_map
