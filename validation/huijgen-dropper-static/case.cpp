#include <cmath>

#include "dynamics/line/equilibrium.hpp"
#include "harness/case.hpp"
#include "support/line_models.hpp"

namespace froude::validation::huijgen_dropper_static {
namespace {

namespace dl = dynamics::line;
using Eigen::Vector3d;
constexpr int links = 18;
constexpr double length = 17, width = 2.5, weight = 238 * 9.81 / links, link = length / links;

/// Pull V of link j up from the loop's middle, in link weights.
double uphill(int j) { return (links - 1) / 2.0 - j; }

/// H at which the links span the width, by bisection.
double horizontal_pull() {
  double low = 1e-6, high = 1e6;
  for (int i = 0; i < 200; ++i) {
    const double H = (low + high) / 2;
    double span = 0;
    for (int j = 0; j < links; ++j) span += link * H / std::hypot(H, uphill(j) * weight);
    (span < width ? low : high) = H;
  }
  return (low + high) / 2;
}

double left_over(const dl::Line& line, const dl::State& s) {
  dl::Places sum = line.constant_load();
  for (int j = 0; j < links; ++j) {
    const Vector3d pull = s.tension[j] * (s.position.col(j + 1) - s.position.col(j)).normalized();
    sum.col(j) += pull;
    sum.col(j + 1) -= pull;
  }
  return sum.middleCols(1, links - 1).colwise().norm().maxCoeff();
}

}  // namespace

Outcome outcome(const Folders&) {
  const dl::Line line(support::loop(links));
  const dl::State ours = dl::hanging_shape(line, support::ends_at(line, {width, 0, 0}));
  const double H = horizontal_pull();
  double place = 0, tension = 0;
  Vector3d at = Vector3d::Zero();
  plot::Series shape{.name = "links", .x = {0}, .y = {0}, .marks = true};
  for (int j = 0; j < links; ++j) {
    const double T = std::hypot(H, uphill(j) * weight);
    at += link * Vector3d(H, 0, -uphill(j) * weight) / T;
    place = std::max(place, (ours.position.col(j + 1) - at).norm());
    tension = std::max(tension, std::abs(ours.tension[j] / T - 1));
    shape.x.push_back(ours.position(0, j + 1));
    shape.y.push_back(ours.position(2, j + 1));
  }
  dl::State legs = support::ends_at(line, {width, 0, 0});
  const double down = std::sqrt(length * length - width * width) / links;
  for (int i = 1; i < links; ++i) legs.position.col(i) = Vector3d(width * i / links, 0, -down * std::min(i, links - i));
  const dl::State found = dl::equilibrium(line, legs);
  const dl::State sloped = dl::equilibrium(line, dl::hanging_shape(line, support::ends_at(line, {width, 1, 3})));
  return {.numbers = {{"places, largest difference from the closed form, of the length", place / length, ""},
                      {"tensions, largest difference from the closed form, relative", tension, ""},
                      {"rest found from a V of two straight legs, largest difference, of the length",
                       (found.position - ours.position).cwiseAbs().maxCoeff() / length, ""},
                      {"ends 3 m apart in height: force left over at any node, of the weight",
                       left_over(line, sloped) / (links * weight), ""},
                      {"horizontal pull", H, "N"},
                      {"largest tension", ours.tension.maxCoeff(), "N"}},
          .pictures = {
              {"shape",
               "The dropper of table 8.5 at rest.",
               {.title = "Looped dropper",
                .panels = {{.x = {.label = "x", .unit = "m"}, .y = {.label = "z", .unit = "m"}, .series = {shape}}},
                .width = 520,
                .panel_height = 560}}}};
}

}  // namespace froude::validation::huijgen_dropper_static
