// Hulls by panels with partial waves between them, against exact cylinders and against all panels together.
#include <cmath>

#include "harness/case.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"

namespace froude::validation::hull_array {
namespace {

using Eigen::Vector3d;
using hydro::hydrostatics::Hull;
using hydro::panels::HullBody;
using hydro::panels::Interaction;
using hydro::panels::Solution;

const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(5)};
const std::vector<double> heading{0, 0.6};

Solution solved(const std::vector<HullBody>& hulls, const std::vector<double>& omega, Interaction interaction,
                std::optional<double> tolerance) {
  hydro::panels::Options options{.tolerance = tolerance, .threads = 1};
  options.interaction = interaction;
  return hydro::panels::solve(hulls, water, omega, heading, options);
}

struct OfCylinders {
  Solution panels;
  hydro::potential::Coefficients exact;
};

OfCylinders nine_cylinders(const std::vector<double>& omega) {
  constexpr double radius = 1, draught = 0.8, apart = 4;
  std::vector<HullBody> hulls;
  std::vector<hydro::cylinders::CylinderBody> exact;
  for (const double x : {-apart, 0.0, apart})
    for (const double y : {-apart, 0.0, apart}) {
      const Vector3d at(x, y, 0), G(x, y, -draught / 2);
      const std::string name = fmt::format("at {} {}", x, y);
      hulls.push_back({name, at, G, Hull(hydro::hydrostatics::cylinder_mesh(radius, draught, 2, 2, 24, {x, y}))});
      exact.push_back({name, at, G, {{{x, y}, radius, draught}}});
    }
  return {
      solved(hulls, omega, Interaction::partial_waves, 0.03),
      hydro::cylinders::solve(exact, water, omega, heading, {.tolerance = 1e-5, .threads = 1, .doubled_frequencies = 0})
          .coefficients};
}

double four_boxes() {
  std::vector<HullBody> hulls;
  for (const double x : {-1.75, 1.75})
    for (const double y : {-1.75, 1.75}) {
      const Vector3d half = x * y > 0 ? Vector3d(1, 0.6, 0) : Vector3d(0.6, 1, 0), at(x, y, 0);
      const std::array<int, 3> panels = x * y > 0 ? std::array{12, 8, 3} : std::array{8, 12, 3};
      hulls.push_back({fmt::format("at {} {}", x, y), at, at - Vector3d(0, 0, 0.3),
                       Hull(hydro::hydrostatics::box_mesh(at - half - Vector3d(0, 0, 0.6), at + half, panels))});
    }
  const std::vector<double> omega{1.2, 2.0, 2.8};
  const Solution one = solved(hulls, omega, Interaction::panels, {}),
                 each = solved(hulls, omega, Interaction::partial_waves, {});
  return hydro::panels::difference(each.coefficients, one.coefficients, one.check.length);
}

/// |X| of heave of one cylinder in waves of the first heading, over the weight of a metre of its waterplane.
plot::Series heave(const char* name, const hydro::potential::Coefficients& c, Eigen::Index body, bool marks) {
  plot::Series s{.name = name, .x = c.omega, .y = {}, .line = !marks, .marks = marks};
  const double stiffness = water.density * water.gravity * std::numbers::pi;
  for (std::size_t w = 0; w < c.omega.size(); ++w)
    s.y.push_back(std::abs(c.X[0](6 * body + 2, static_cast<Eigen::Index>(w))) / stiffness);
  return s;
}

}  // namespace

Outcome outcome(const Folders&) {
  std::vector<double> omega;
  for (int i = 0; i < 12; ++i) omega.push_back(1 + 0.2 * i);
  const OfCylinders nine = nine_cylinders(omega);
  const double error = hydro::panels::difference(nine.panels.coefficients, nine.exact, nine.panels.check.length),
               estimate = nine.panels.check.estimate;
  const plot::Panel panel{.x = {.label = "frequency", .unit = "rad/s"},
                          .y = {.label = "heave excitation over rho g S", .unit = "m/m"},
                          .series = {heave("middle, exact", nine.exact, 4, false),
                                     heave("middle, panels", nine.panels.coefficients, 4, true),
                                     heave("behind it, exact", nine.exact, 7, false),
                                     heave("behind it, panels", nine.panels.coefficients, 7, true)}};
  return {.numbers = {{"nine cylinders: largest error of A, B, X", error, ""},
                      {"nine cylinders: estimate", estimate, ""},
                      {"nine cylinders: error over estimate", error / estimate, ""},
                      {"four boxes: partial waves against all panels together", four_boxes(), ""}},
          .pictures = {{"heave",
                        "Heave excitation of two of nine cylinders, by panels with partial waves and exact.",
                        {.title = "Nine cylinders, waves along a row", .panels = {panel}}}}};
}

}  // namespace froude::validation::hull_array
