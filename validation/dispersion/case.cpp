#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "hydro/waves/dispersion.hpp"

namespace froude::validation::dispersion {
namespace {

constexpr double g = 9.81;

// |ω²/(gk tanh kh) − 1| in extended precision; tanh ∞ = 1.
double residual(double omega, const hydro::Water& water) {
  const long double w = omega, k = hydro::waves::wavenumber(omega, water);
  const long double h = water.depth.metres();
  return static_cast<double>(std::abs(w * w / (g * k * std::tanh(k * h)) - 1));
}

}  // namespace

Outcome outcome(const Folders&) {
  double worst = 0, worst_deep = 0;
  plot::Panel panel{.x = {.label = "kh", .scale = plot::Scale::logarithmic},
                    .y = {.label = "relative residual", .scale = plot::Scale::logarithmic},
                    .series = {}};
  for (const double h : {0.7, 14.0, 4000.0}) {
    const hydro::Water water{.gravity = g, .depth = hydro::WaterDepth::from_metres(h)};
    plot::Series series{.name = fmt::format("h = {} m", h), .x = {}, .y = {}, .line = false, .marks = true};
    for (int i = 0; i <= 900; ++i) {
      const double kh = std::pow(10.0, -6 + i / 100.0);
      const double r = residual(std::sqrt(g * kh / h * std::tanh(kh)), water);
      worst = std::max(worst, r);
      if (i % 10 == 0) series.x.push_back(kh), series.y.push_back(r);
    }
    panel.series.push_back(std::move(series));
  }
  for (double omega = 1e-3; omega < 100; omega *= 1.01)
    worst_deep = std::max(worst_deep, residual(omega, {.gravity = g}));
  return {.numbers = {{"worst residual, finite depth", worst, ""}, {"worst residual, infinite depth", worst_deep, ""}},
          .pictures = {{"residual",
                        "Residual of the dispersion relation; rounding of a double is 1.1e-16.",
                        {.title = "Dispersion relation", .panels = {panel}}}}};
}

}  // namespace froude::validation::dispersion
