// Panels of truncated cylinders, extrapolated, against eigenfunctions: two cylinders, and the estimate in many.
#include <algorithm>
#include <cmath>
#include <random>

#include "harness/case.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"

namespace froude::validation::hull_cylinder {
namespace {

using Eigen::Vector3d;

struct Cylinder {
  double radius, draught;  // m
  double depth;            // m
  bool deep = false;       // panels take the water as infinitely deep
};

struct Mesh {
  int rows, columns;
};

struct Compared {
  double error, estimate;
};

/// Largest difference of A, B and X, each over its two modes, and what was estimated.
Compared compare(const Cylinder& c, const Mesh& mesh, const std::vector<double>& omega, double tolerance) {
  hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(c.depth)};
  const Vector3d G(0, 0, -c.draught / 2);
  const std::vector<double> heading{0.3};
  const auto exact =
      hydro::cylinders::solve({{"cylinder", {0, 0, 0}, G, {{{0, 0}, c.radius, c.draught}}}}, water, omega, heading,
                              {.tolerance = 1e-5, .threads = 1, .doubled_frequencies = 0})
          .coefficients;
  if (c.deep) water.depth = hydro::WaterDepth::infinite();
  const hydro::panels::HullBody body{"cylinder",
                                     {0, 0, 0},
                                     G,
                                     hydro::hydrostatics::Hull(hydro::hydrostatics::cylinder_mesh(
                                         c.radius, c.draught, mesh.rows, mesh.rows, mesh.columns))};
  const auto s = hydro::panels::solve({body}, water, omega, heading, {.tolerance = tolerance, .threads = 1});
  return {hydro::panels::difference(s.coefficients, exact, s.check.length), s.check.estimate};
}

struct Coverage {
  int cases = 0, above = 0;
  double largest_error = 0;
  std::vector<double> error, estimate;
};

/// Draught, depth and frequency of a cylinder of unit radius, drawn evenly in their logarithms; coarse meshes.
Coverage coverage(int cases) {
  std::mt19937 random(20);
  const auto draw = [&](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(random()) / 4294967296.0);
  };
  Coverage out;
  for (int i = 0; i < cases; ++i) {
    const double draught = draw(0.3, 2), depth = draught * draw(1.3, 8), Ka = draw(0.05, 1.2);
    constexpr double any = 0.5;  // the first estimate is what is tested
    const Compared c = compare({1, draught, depth}, {2, 12}, {std::sqrt(Ka * 9.81)}, any);
    ++out.cases;
    out.above += c.estimate > c.error ? 1 : 0;
    out.largest_error = std::max(out.largest_error, c.error);
    out.error.push_back(c.error);
    out.estimate.push_back(c.estimate);
  }
  return out;
}

}  // namespace

Outcome outcome(const Folders&) {
  const Mesh mesh{2, 24};
  const std::vector<double> omega{1.3, 2.3};
  constexpr double tolerance = 0.003;  // three meshes
  const Compared bed = compare({1, 0.8, 3}, mesh, omega, tolerance),
                 deep = compare({1, 0.8, 40, true}, mesh, omega, tolerance);
  const Coverage many = coverage(100);
  const double largest = *std::max_element(many.estimate.begin(), many.estimate.end());
  const plot::Panel panel{
      .x = {.label = "estimate"},
      .y = {.label = "error against eigenfunctions"},
      .series = {{.name = "draws", .x = many.estimate, .y = many.error, .line = false, .marks = true},
                 {.name = "error = estimate", .x = {0, largest}, .y = {0, largest}}}};
  return {.numbers = {{"over a bed: largest error of A, B, X", bed.error, ""},
                      {"over a bed: estimate", bed.estimate, ""},
                      {"deep: largest error of A, B, X", deep.error, ""},
                      {"deep: estimate", deep.estimate, ""},
                      {"draws whose estimate is above the error", 100.0 * many.above / many.cases, "%"},
                      {"draws: largest error", many.largest_error, ""}},
          .pictures = {
              {"estimates",
               "Error of A, B and X against eigenfunctions, and its estimate, for 100 drawn cylinders of 48 panels.",
               {.title = "Panels of cylinders", .panels = {panel}}}}};
}

}  // namespace froude::validation::hull_cylinder
