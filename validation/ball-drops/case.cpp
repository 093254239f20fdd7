#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fit/shooting.hpp"
#include "harness/case.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::ball_drops {
namespace {

struct Ball {
  const char* file;
  double ounces, circumference_cm;
  bool light;
  double drop_1, drop_2;  // C_D of an independent fit
};
constexpr Ball balls[] = {
    {"whiffle_ball_1", 1, 22.8, true, 0.524, 0.501},        {"whiffle_ball_2", 1, 22.8, true, 0.577, 0.462},
    {"yellow_whiffle_ball", 1.5, 29.0, true, 0.686, 0.538}, {"orange_whiffle_ball", 1.5, 29.0, true, 0.544, 0.560},
    {"golf_ball", 1.62, 13.8, false, 0.011, 0.211},         {"baseball", 5, 22.25, false, 0.033, 0.095},
    {"bowling_ball", 81, 67.0, false, -0.175, 0.067}};

/// One drop: heights from the start, evenly in time.
struct Drop {
  const Ball* ball;
  int number;
  fit::Window window;
};

struct Drag {
  double cd;
  fit::Interval interval;
  double start_height;
};

/// k = ρ C_D A/(2m) in air of 1.2 kg/m³; free height and speed at the start.
Drag drag(const Drop& drop, double scale) {
  const double radius = drop.ball->circumference_cm / 100 / (2 * std::numbers::pi);
  const double per_cd = 1.2 * std::numbers::pi * radius * radius / (2 * drop.ball->ounces * 0.028349523);
  fit::Window window = drop.window;
  window.values *= scale;
  const auto fit = fit::fit_motion({.law = fit::MotionLaw::fall,
                                    .windows = {window},
                                    .deviations = {0.1},
                                    .start = {0.3 * per_cd, 9.81},
                                    .fitted = {true, false}});
  const fit::Coefficient& k = fit.parameters[0];
  return {*k.value / per_cd, {k.interval.low / per_cd, k.interval.high / per_cd}, fit.initial[0][0]};
}

std::vector<Drop> all_drops(const Folders& folders) {
  std::vector<Drop> out;
  for (const Ball& ball : balls) {
    const auto table = hydro::io::CsvTable::read(folders.shared(fmt::format("drag_ball_drops/{}.csv", ball.file)));
    const auto &drop = table.column("drop"), &time = table.column("time_s"), &height = table.column("height_m");
    for (const int number : {1, 2}) {
      std::vector<double> t, h;
      for (std::size_t i = 0; i < drop.size(); ++i)
        if (drop[i] == number) t.push_back(time[i]), h.push_back(height[i]);
      out.push_back({&ball,
                     number,
                     {(t.back() - t.front()) / static_cast<double>(t.size() - 1),
                      Eigen::Map<const Eigen::VectorXd>(h.data(), static_cast<Eigen::Index>(h.size()))}});
    }
  }
  return out;
}

/// Relative deviation of the heights at which drops from one bridge seem to start: what the film's scale is worth.
double scale_error(const std::vector<Drop>& drops) {
  std::vector<double> start;
  double mean = 0, squares = 0;
  for (const Drop& d : drops) start.push_back(drag(d, 1).start_height);
  for (const double h : start) mean += h / static_cast<double>(start.size());
  for (const double h : start) squares += (h - mean) * (h - mean);
  return std::sqrt(squares / static_cast<double>(start.size() - 1)) / mean;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto drops = all_drops(folders);
  const double scale = scale_error(drops);
  double least = 9, most = -9, worst = 0, heavy = 0, heavy_unknown = 0, light_seen = 0, light = 0;
  plot::Series values{"C_D", {}, {}, false, true}, bars{"95 % interval", {}, {}};
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const Ball& ball = *drops[i].ball;
    const Drag d = drag(drops[i], 1);
    const double systematic = 1.96 * (drag(drops[i], 1 + scale).cd - d.cd);
    const double half = std::hypot((d.interval.high - d.interval.low) / 2, systematic);
    const bool unknown = d.cd - half <= 0 && d.cd + half >= 0;
    if (ball.light) {
      ++light;
      light_seen += !unknown;
      least = std::min(least, d.cd);
      most = std::max(most, d.cd);
      worst = std::max(worst, std::abs(d.cd - (drops[i].number == 1 ? ball.drop_1 : ball.drop_2)));
    } else {
      ++heavy;
      heavy_unknown += unknown;
    }
    values.x.push_back(static_cast<double>(i + 1)), values.y.push_back(d.cd);
    for (const double y : {d.cd - half, d.cd + half, std::nan("")})
      bars.x.push_back(static_cast<double>(i + 1)), bars.y.push_back(y);
  }
  return {.numbers = {{"deviation of the film's scale", scale, ""},
                      {"least C_D of a light ball", least, ""},
                      {"largest C_D of a light ball", most, ""},
                      {"largest difference of a light ball's C_D from an independent fit", worst, ""},
                      {"share of light drops whose interval leaves zero out", light_seen / light, ""},
                      {"share of heavy drops whose interval holds zero", heavy_unknown / heavy, ""}},
          .pictures = {{"cd",
                        "Drag of eight drops of light balls (left) and six of heavy ones.",
                        {.title = "Balls dropped from a bridge",
                         .panels = {{.x = {.label = "drop"}, .y = {.label = "C_D"}, .series = {values, bars}}}}}}};
}

}  // namespace froude::validation::ball_drops
