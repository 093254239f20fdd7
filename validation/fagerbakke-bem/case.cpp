#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/cylinders/solve.hpp"

namespace froude::validation::fagerbakke_bem {
namespace {

using hydro::cylinders::CylinderBody;
using hydro::potential::Coefficients;

CylinderBody module_at(double x) {
  CylinderBody body{"module", {x, 0, 0}, Eigen::Vector3d(x, 0, 1.31), {}};
  for (const double dx : {-5.2, 5.2})
    for (const double y : {-5.2, 5.2}) body.cylinders.push_back({{x + dx, y}, 0.8, 1.13});
  return body;
}

struct Difference {
  double A = 0, B = 0, X = 0;  ///< largest over frequencies up to 2 rad/s, over the largest entry of the mode
};

// Modes i of all bodies but yaw, on their own: coupling entries share the scale of the diagonal.
Difference difference(const Coefficients& panels, const Coefficients& ours) {
  Difference largest;
  for (Eigen::Index i = 0; i < panels.modes(); ++i) {
    if (i % 6 == 5) continue;
    Difference d, size;
    for (std::size_t w = 0; w < panels.omega.size() && panels.omega[w] < 2.05; ++w) {
      d.A = std::max(d.A, std::abs(panels.A[w](i, i) - ours.A[w](i, i)));
      d.B = std::max(d.B, std::abs(panels.B[w](i, i) - ours.B[w](i, i)));
      size.A = std::max(size.A, std::abs(ours.A[w](i, i)));
      size.B = std::max(size.B, std::abs(ours.B[w](i, i)));
      for (std::size_t h = 0; h < panels.heading.size(); ++h) {
        const auto at = static_cast<Eigen::Index>(w);
        d.X = std::max(d.X, std::abs(panels.X[h](i, at) - ours.X[h](i, at)));
        size.X = std::max(size.X, std::abs(ours.X[h](i, at)));
      }
    }
    largest.A = std::max(largest.A, d.A / size.A);
    largest.B = std::max(largest.B, d.B / size.B);
    largest.X = std::max(largest.X, d.X / size.X);
  }
  return largest;
}

Coefficients like(const Coefficients& panels, const std::vector<CylinderBody>& bodies) {
  return hydro::cylinders::solve(bodies, panels.water, panels.omega, panels.heading,
                                 {.tolerance = 1e-4, .doubled_frequencies = 0})
      .coefficients;
}

// Of |X₃| over periods from 3.5 to 3.8 s; the parabola through the squares of the least and its neighbours.
double least_heave_period() {
  hydro::Water deep{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::infinite()};
  std::vector<double> omega;
  for (int i = 0; i <= 30; ++i) omega.push_back(2 * std::numbers::pi / (3.8 - 0.01 * i));
  const auto c =
      hydro::cylinders::solve({module_at(0)}, deep, omega, {0}, {.tolerance = 1e-4, .doubled_frequencies = 0})
          .coefficients;
  const Eigen::VectorXd squares = c.X[0].row(2).cwiseAbs2().transpose();
  Eigen::Index least = 0;
  squares.segment(1, squares.size() - 2).minCoeff(&least);
  ++least;
  const double before = squares(least - 1), here = squares(least), after = squares(least + 1);
  return 3.8 - 0.01 * (static_cast<double>(least) + 0.5 * (before - after) / (before - 2 * here + after));
}

plot::Series heave_series(const std::string& name, const Coefficients& c, bool marks) {
  plot::Series s{.name = name, .x = c.omega, .y = {}, .line = !marks, .marks = marks};
  for (Eigen::Index w = 0; w < c.X[0].cols(); ++w) s.y.push_back(std::abs(c.X[0](2, w)) / 1000);
  return s;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto panels_1 = hydro::potential::read(folders.shared("generated-bem/pontoon1/pontoon1.nc"));
  const auto panels_2 = hydro::potential::read(folders.shared("generated-bem/pontoon2/pontoon2.nc"));
  const Coefficients ours_1 = like(panels_1, {module_at(0)}),
                     ours_2 = like(panels_2, {module_at(-6.5), module_at(6.5)});
  const Difference one = difference(panels_1, ours_1), two = difference(panels_2, ours_2);
  const plot::Panel heave{.x = {.label = "ω", .unit = "rad/s"},
                          .y = {.label = "heave excitation", .unit = "kN/m"},
                          .series = {heave_series("cylinders", ours_1, false), heave_series("panels", panels_1, true)}};
  return {.numbers = {{"one module: largest difference of A", one.A, ""},
                      {"one module: largest difference of B", one.B, ""},
                      {"one module: largest difference of X", one.X, ""},
                      {"two modules: largest difference of A", two.A, ""},
                      {"two modules: largest difference of B", two.B, ""},
                      {"two modules: largest difference of X", two.X, ""},
                      {"period of least heave excitation in deep water", least_heave_period(), "s"}},
          .pictures = {{"heave-excitation",
                        "Heave excitation of one module in head waves.",
                        {.title = "Module of four cylinders", .panels = {heave}}}}};
}

}  // namespace froude::validation::fagerbakke_bem
