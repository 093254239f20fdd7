#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/potential/operations/transformations.hpp"
#include "potential/modes.hpp"

namespace hydro::potential {
namespace {

[[noreturn]] void refuse(const Coefficients& a, const Coefficients& b, const std::string& what) {
  throw InputError(fmt::format("{} and {} differ in {}", a.source, b.source, what), {},
                   "only runs of the same bodies in the same water, with the same headings, are parts of one table");
}

bool is_near(double a, double b) {  // either may be an infinite depth
  return a == b || (std::isfinite(a - b) && std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)));
}

bool is_near(const std::optional<Eigen::Vector3d>& a, const std::optional<Eigen::Vector3d>& b) {
  return !a || !b || (*a - *b).norm() <= 1e-6 * (1 + a->norm());  // m
}

void require_same_bodies(const Coefficients& a, const Coefficients& b) {
  if (a.bodies() != b.bodies()) refuse(a, b, fmt::format("the number of bodies: {} and {}", a.bodies(), b.bodies()));
  for (std::size_t i = 0; i < a.body.size(); ++i) {
    const BodyData &p = a.body[i], &q = b.body[i];
    if (!is_near(p.reference_point, q.reference_point)) refuse(a, b, "the reference point of \"" + p.name + "\"");
    if (!is_near(p.centre_of_gravity, q.centre_of_gravity)) refuse(a, b, "the centre of gravity of \"" + p.name + "\"");
  }
}

void require_same_sea(const Coefficients& a, const Coefficients& b) {
  if (!is_near(a.water.density, b.water.density)) refuse(a, b, "density");
  if (!is_near(a.water.gravity, b.water.gravity)) refuse(a, b, "gravity");
  if (!is_near(a.water.depth.metres(), b.water.depth.metres())) refuse(a, b, "the depth of the water");
  constexpr double same = 1e-6;  // rad
  const bool is_same =
      a.heading.size() == b.heading.size() && std::equal(a.heading.begin(), a.heading.end(), b.heading.begin(),
                                                         [](double x, double y) { return std::abs(x - y) < same; });
  if (!is_same) refuse(a, b, "their headings");
}

void require_agreement(const Coefficients& a, const Coefficients& b, const Eigen::MatrixXd& first,
                       const Eigen::MatrixXd& second, const Eigen::VectorXd& size, double tolerance,
                       const std::string& what) {
  if (const double off = relative_size(first - second, size); off > tolerance)
    refuse(a, b, fmt::format("{}, by {:.3g} of its size", what, off));
}

/// One limit or C: the first that is there, and every other must agree with it.
template <class Member>
void take(Coefficients& out, const Coefficients& run, Member member, double tolerance, const char* what) {
  if (!(run.*member)) return;
  if (!(out.*member)) {
    out.*member = run.*member;
    return;
  }
  require_agreement(out, run, *(out.*member), *(run.*member), mode_sizes({*(out.*member)}), tolerance, what);
}

void add_frequencies(Coefficients& out, const Coefficients& run, double tolerance) {
  const Eigen::VectorXd A_size = mode_sizes(out.A), B_size = mode_sizes(out.B);
  for (std::size_t k = 0; k < run.omega.size(); ++k) {
    const double omega = run.omega[k];
    const auto at = std::find_if(out.omega.begin(), out.omega.end(), [&](double w) { return is_near(w, omega); });
    if (at != out.omega.end()) {
      const auto i = static_cast<std::size_t>(at - out.omega.begin());
      require_agreement(out, run, out.A[i], run.A[k], A_size, tolerance, fmt::format("A at {:.6g} rad/s", omega));
      require_agreement(out, run, out.B[i], run.B[k], B_size, tolerance, fmt::format("B at {:.6g} rad/s", omega));
      continue;
    }
    const auto above = std::upper_bound(out.omega.begin(), out.omega.end(), omega) - out.omega.begin();
    out.omega.insert(out.omega.begin() + above, omega);
    out.A.insert(out.A.begin() + above, run.A[k]);
    out.B.insert(out.B.begin() + above, run.B[k]);
    for (std::size_t h = 0; h < out.X.size(); ++h) {
      Eigen::MatrixXcd X(out.X[h].rows(), out.X[h].cols() + 1);
      X << out.X[h].leftCols(above), run.X[h].col(static_cast<Eigen::Index>(k)),
          out.X[h].rightCols(out.X[h].cols() - above);
      out.X[h] = X;
    }
  }
}

}  // namespace

Coefficients merged(std::span<const Coefficients> run, double tolerance) {
  require(!run.empty(), "there is no run to merge");
  for (const Coefficients& c : run) c.validate();
  Coefficients out = run.front();
  for (const Coefficients& c : run.subspan(1)) {
    require_same_bodies(out, c);
    require_same_sea(out, c);
    take(out, c, &Coefficients::C, tolerance, "C");
    take(out, c, &Coefficients::A_zero, tolerance, "A at zero frequency");
    take(out, c, &Coefficients::A_inf, tolerance, "A at infinite frequency");
    add_frequencies(out, c, tolerance);
    out.notes.push_back("frequencies are merged from " + c.source);
  }
  return out;
}

}  // namespace hydro::potential
