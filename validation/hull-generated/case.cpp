// Extrapolated panels against finer panels of another code, at its frequencies.
#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"

namespace froude::validation::hull_generated {
namespace {

using hydro::hydrostatics::TriangleMesh;
using hydro::potential::Coefficients;

/// Largest differences of one mode over frequencies, over its largest value.
struct Difference {
  double A = 0, B = 0, X = 0;
};

Difference difference(const Coefficients& theirs, const std::vector<std::size_t>& at, const Coefficients& ours,
                      hydro::Mode mode) {
  const auto i = static_cast<Eigen::Index>(mode);
  Difference d, size;
  for (std::size_t n = 0; n < at.size(); ++n) {
    const std::size_t w = at[n];
    d.A = std::max(d.A, std::abs(theirs.A[w](i, i) - ours.A[n](i, i)));
    d.B = std::max(d.B, std::abs(theirs.B[w](i, i) - ours.B[n](i, i)));
    size.A = std::max(size.A, std::abs(ours.A[n](i, i)));
    size.B = std::max(size.B, std::abs(ours.B[n](i, i)));
    for (std::size_t h = 0; h < theirs.heading.size(); ++h) {
      const auto a = static_cast<Eigen::Index>(w), b = static_cast<Eigen::Index>(n);
      d.X = std::max(d.X, std::abs(theirs.X[h](i, a) - ours.X[h](i, b)));
      size.X = std::max(size.X, std::abs(ours.X[h](i, b)));
    }
  }
  return {d.A / size.A, d.B / size.B, d.X / size.X};
}

struct Compared {
  Difference translations, rotations;  ///< the largest of surge and heave; of pitch
  double estimate = 0;
};

/// `count` of their frequencies from `low` to `high`, rad/s. Where their file names no reference point it is the
/// origin, as the README of the data tells.
Compared compare(const Coefficients& theirs, TriangleMesh mesh, double low, double high, std::size_t count,
                 double tolerance) {
  std::vector<std::size_t> inside, at;
  for (std::size_t w = 0; w < theirs.omega.size(); ++w)
    if (theirs.omega[w] >= low - 1e-9 && theirs.omega[w] <= high + 1e-9) inside.push_back(w);
  for (std::size_t n = 0; n < count; ++n) at.push_back(inside[n * (inside.size() - 1) / (count - 1)]);
  std::vector<double> omega;
  for (const std::size_t w : at) omega.push_back(theirs.omega[w]);
  const hydro::panels::HullBody body{"hull",
                                     theirs.body[0].reference_point.value_or(Eigen::Vector3d::Zero()),
                                     {},
                                     hydro::hydrostatics::Hull(std::move(mesh))};
  const auto s =
      hydro::panels::solve({body}, theirs.water, omega, theirs.heading, {.tolerance = tolerance, .threads = 1});
  const Difference surge = difference(theirs, at, s.coefficients, hydro::Mode::surge),
                   heave = difference(theirs, at, s.coefficients, hydro::Mode::heave);
  return {{std::max(surge.A, heave.A), std::max(surge.B, heave.B), std::max(surge.X, heave.X)},
          difference(theirs, at, s.coefficients, hydro::Mode::pitch),
          s.check.estimate};
}

/// Four cylinders, D = 1.6 m, draught 1.13 m, at (±5.2, ±5.2) m.
TriangleMesh pontoon() {
  TriangleMesh all{.source = "pontoon", .vertices = {}, .triangles = {}};
  for (const double x : {-5.2, 5.2})
    for (const double y : {-5.2, 5.2}) {
      const TriangleMesh one = hydro::hydrostatics::cylinder_mesh(0.8, 1.13, 2, 2, 12, {x, y});
      const int first = static_cast<int>(all.vertices.size());
      all.vertices.insert(all.vertices.end(), one.vertices.begin(), one.vertices.end());
      for (const auto& t : one.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  return all;
}

void add(const std::string& name, const Compared& c, bool pitch, std::vector<Number>& out) {
  out.push_back({name + ", surge and heave: largest difference of A", c.translations.A, ""});
  out.push_back({name + ", surge and heave: largest difference of B", c.translations.B, ""});
  out.push_back({name + ", surge and heave: largest difference of X", c.translations.X, ""});
  if (pitch) {
    out.push_back({name + ", pitch: largest difference of A", c.rotations.A, ""});
    out.push_back({name + ", pitch: largest difference of B", c.rotations.B, ""});
    out.push_back({name + ", pitch: largest difference of X", c.rotations.X, ""});
  }
  out.push_back({name + ": estimate", c.estimate, ""});
}

}  // namespace

Outcome outcome(const Folders& folders) {
  using hydro::hydrostatics::Spacing;
  const auto theirs = [&](const std::string& name) {
    return hydro::potential::read(folders.shared("generated-bem/" + name + "/" + name + ".nc"));
  };
  const TriangleMesh box = hydro::hydrostatics::box_mesh({-1, -1, -0.3}, {1, 1, 0}, {6, 6, 2}, Spacing::equal);
  Outcome out;
  add("box", compare(theirs("box1"), box, 0.5, 4.5, 9, 0.02), true, out.numbers);
  add("pontoon", compare(theirs("pontoon1"), pontoon(), 0.4, 2, 5, 0.02), true, out.numbers);
  add("hemisphere",
      compare(theirs("hemisphere_r5"), hydro::hydrostatics::hemisphere_mesh(5, 12, 48), 0.4, 2.4, 6, 0.02), false,
      out.numbers);
  return out;
}

}  // namespace froude::validation::hull_generated
