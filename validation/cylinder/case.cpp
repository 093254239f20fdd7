#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/bottom_mounted_cylinders.hpp"

namespace froude::validation::cylinder {
namespace {

using hydro::cylinders::CylinderBody;
using hydro::cylinders::Solution;

const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(14)};

CylinderBody floating(double radius, double draught, double x) {
  return {"cylinder", {x, 0, 0}, Eigen::Vector3d(x, 0, -draught / 2), {{{x, 0}, radius, draught}}};
}

CylinderBody pile(const Eigen::Vector2d& centre, double radius) {
  return {"pile", {centre.x(), centre.y(), 0}, {}, {{centre, radius, {}}}};
}

std::vector<double> frequencies() {
  std::vector<double> omega;
  for (int i = 2; i <= 20; ++i) omega.push_back(0.2 * i);
  return omega;
}

double maccamy_fuchs_error() {
  const double a = 2, beta = 0;
  const auto c = hydro::cylinders::solve({pile({0, 0}, a)}, water, frequencies(), {beta}).coefficients;
  double largest = 0;
  for (std::size_t i = 0; i < c.omega.size(); ++i) {
    const double k = hydro::waves::wavenumber(c.omega[i], water);
    const double force = 4 * water.density * water.gravity * std::tanh(k * water.depth.metres()) /
                         (k * k * std::abs(froude_test::slope_H2(1, k * a)));
    largest = std::max(largest, std::abs(std::abs(c.X[0](0, static_cast<Eigen::Index>(i))) / force - 1));
  }
  return largest;
}

double linton_evans_error() {
  const std::vector<Eigen::Vector2d> centre{{-2, -2}, {2, -2}, {-2, 2}, {2, 2}};
  std::vector<CylinderBody> bodies;
  for (const auto& p : centre) bodies.push_back(pile(p, 1));
  const double beta = std::numbers::pi / 4;
  const std::vector<double> omega{1.5, 2.5, 3.5, 4.2};
  const auto c =
      hydro::cylinders::solve(bodies, water, omega, {beta}, {.tolerance = 1e-6, .doubled_frequencies = 0}).coefficients;
  double largest = 0;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const auto expected = froude_test::forces_on_bottom_mounted(
        centre, 1, hydro::waves::wavenumber(omega[i], water), water.depth.metres(), beta, water.density, water.gravity);
    for (std::size_t b = 0; b < centre.size(); ++b) {
      const Eigen::Vector2cd ours = c.X[0].block<2, 1>(6 * static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(i));
      largest = std::max(largest, (ours - expected[b]).norm() / expected[b].norm());
    }
  }
  return largest;
}

}  // namespace

Outcome outcome(const Folders&) {
  const Solution one =
      hydro::cylinders::solve({floating(0.8, 1.13, 0)}, water, frequencies(), {0.3}, {.tolerance = 1e-6});
  const Solution two = hydro::cylinders::solve({floating(1, 2, 0), floating(0.7, 1.2, 6)}, water, {0.8, 1.6, 2.4},
                                               {0.3}, {.tolerance = 1e-8, .doubled_frequencies = 0});
  plot::Panel A{.x = {.label = "ω", .unit = "rad/s"}, .y = {.label = "A / ρV"}, .series = {}};
  const double displaced = water.density * *one.coefficients.body[0].displaced_volume;
  for (const auto& [name, mode] : {std::pair{"surge", 0}, {"heave", 2}}) {
    plot::Series series{.name = name, .x = one.coefficients.omega, .y = {}};
    for (const auto& matrix : one.coefficients.A) series.y.push_back(matrix(mode, mode) / displaced);
    A.series.push_back(series);
  }
  return {.numbers = {{"one cylinder: change with doubled resolution", one.check.doubling, ""},
                      {"one cylinder: energy", one.check.energy, ""},
                      {"one cylinder: Haskind", one.check.haskind, ""},
                      {"one cylinder: reciprocity", one.check.reciprocity, ""},
                      {"two cylinders: energy", two.check.energy, ""},
                      {"two cylinders: Haskind", two.check.haskind, ""},
                      {"two cylinders: reciprocity", two.check.reciprocity, ""},
                      {"on the sea bed: force against MacCamy and Fuchs", maccamy_fuchs_error(), ""},
                      {"four on the sea bed: forces against Linton and Evans", linton_evans_error(), ""}},
          .pictures = {{"added-mass",
                        "Added mass of one floating cylinder over its displaced mass.",
                        {.title = "Truncated cylinder", .panels = {A}}}}};
}

}  // namespace froude::validation::cylinder
