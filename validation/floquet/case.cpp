#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dynamics/frequency/floquet.hpp"
#include "harness/case.hpp"
#include "support/hill_determinant.hpp"

namespace froude::validation::floquet {
namespace {

/// The least ε at which a multiplier of damped Mathieu is larger than 1.
double boundary(double delta, double c) {
  return support::first_zero([&](double epsilon) {
    const auto a = [&](double t) {
      return Eigen::MatrixXd(Eigen::Matrix2d{{0, 1}, {-(delta + epsilon * std::cos(t)), -2 * c}});
    };
    return std::abs(dynamics::frequency::floquet_multipliers(a, 2 * std::numbers::pi)(0)) - 1;
  });
}

}  // namespace

Outcome outcome(const Folders&) {
  double worst = 0;
  plot::Panel panel{
      .x = {.label = "stiffness delta", .unit = ""}, .y = {.label = "drive epsilon", .unit = ""}, .series = {}};
  for (const double c : {0.02, 0.05, 0.1}) {
    plot::Series ours{.name = fmt::format("multipliers, c = {}", c), .x = {}, .y = {}, .line = false, .marks = true},
        hills{.name = fmt::format("determinants, c = {}", c), .x = {}, .y = {}};
    for (int i = 1; i <= 28; ++i) {
      const double delta = 0.05 * i, found = boundary(delta, c), expected = support::hill_boundary(delta, c);
      worst = std::max(worst, std::abs(found - expected));
      ours.x.push_back(delta), ours.y.push_back(found);
      hills.x.push_back(delta), hills.y.push_back(expected);
    }
    panel.series.push_back(std::move(hills));
    panel.series.push_back(std::move(ours));
  }
  return {.numbers = {{"largest difference of a boundary", worst, ""}},
          .pictures = {
              {"boundaries",
               "Least drive at which motions of a damped Mathieu equation grow: Floquet multipliers (marks) and Hill's "
               "determinants (lines).",
               {.title = "Boundaries of damped Mathieu", .panels = {panel}}}}};
}

}  // namespace froude::validation::floquet
