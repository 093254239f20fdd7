#include "self_check.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "extrapolate.hpp"
#include "potential/modes.hpp"

namespace hydro::panels {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the largest mode of the kind: what is smaller is measured against it, since panels know it no better.
constexpr double least = 0.1;

/// Sizes of the modes, (P11), but at least a tenth of the largest of the kind; rotations of what that of translations
/// does at the arm whose product with it is `arm`, for a sphere has none of its own.
void raise_to_floor(VectorXd& size, double arm) {
  double largest[2] = {0, 0};
  for (Index i = 0; i < size.size(); ++i) largest[i % 6 / 3] = std::max(largest[i % 6 / 3], size(i));
  largest[1] = std::max(largest[1], arm * largest[0]);
  for (Index i = 0; i < size.size(); ++i) size(i) = std::max(size(i), least * largest[i % 6 / 3]);
}

double relative(const MatrixXcd& difference, const VectorXd& size) {
  double largest = 0;
  for (Index i = 0; i < difference.rows(); ++i)
    for (Index j = 0; j < difference.cols(); ++j)
      if (size(i) > 0) largest = std::max(largest, std::abs(difference(i, j)) / size(i));
  return largest;
}

/// Errors that fall at least as the size of panels: half of that of the coarse mesh is left on the fine one (G15).
constexpr double coarse_over_change = 2;

/// Of the largest of A and X at the arm, what symmetry alone leaves as rounding and as what is not quite symmetric in a
/// mesh; damping goes with the square of X.
constexpr double next_to_nothing = 1e-3;

void leave_out_nothing(VectorXd& size, double arm, double share) {
  VectorXd raised = size;
  raise_to_floor(raised, arm);
  for (Index i = 0; i < size.size(); ++i) {
    double largest = 0;
    for (Index j = 0; j < size.size(); ++j)
      if (j % 6 / 3 == i % 6 / 3) largest = std::max(largest, raised(j));
    if (size(i) < share * largest) size(i) = 0;
  }
}

Sizes own_sizes(const std::vector<OneFrequency>& results) {
  const Index modes = results.front().A.rows();
  Sizes s{VectorXd::Zero(modes), VectorXd::Zero(modes), VectorXd::Zero(modes)};
  for (const OneFrequency& r : results) {
    s.A = s.A.cwiseMax(r.A.diagonal().cwiseAbs());
    s.B = s.B.cwiseMax(r.B.diagonal().cwiseAbs());
    for (Index h = 0; h < r.X.cols(); ++h) s.X = s.X.cwiseMax(r.X.col(h).cwiseAbs());
  }
  return s;
}

}  // namespace

Sizes sizes(const std::vector<OneFrequency>& results, double arm) {
  Sizes s = own_sizes(results);
  raise_to_floor(s.A, arm * arm);
  raise_to_floor(s.B, arm * arm);
  raise_to_floor(s.X, arm);
  return s;
}

double largest(const OneFrequency& difference, const Sizes& size) {
  return std::max({potential::relative_size(difference.A, size.A), potential::relative_size(difference.B, size.B),
                   relative(difference.X, size.X)});
}

OwnErrors::OwnErrors(const std::vector<OneFrequency>& results, double arm) : own_(own_sizes(results)) {
  leave_out_nothing(own_.A, arm * arm, next_to_nothing);
  leave_out_nothing(own_.B, arm * arm, next_to_nothing * next_to_nothing);
  leave_out_nothing(own_.X, arm, next_to_nothing);
  of_mode = VectorXd::Constant(own_.A.size(), std::numeric_limits<double>::quiet_NaN());
}

void OwnErrors::take(const OneFrequency& difference, double factor) {
  for (Index m = 0; m < of_mode.size(); ++m) {
    const auto count = [&](double changed, double size) {
      if (size > 0) of_mode(m) = std::fmax(of_mode(m), factor * std::abs(changed) / size);
    };
    count(difference.A(m, m), own_.A(m));
    count(difference.B(m, m), own_.B(m));
    for (Index h = 0; h < difference.X.cols(); ++h) count(std::abs(difference.X(m, h)), own_.X(m));
  }
}

std::string in_words(const VectorXd& own_errors, double told) {
  constexpr double much = 1.5;
  std::vector<std::string> all, worse;
  for (Index mode = 0; mode < 6; ++mode) {
    double error = std::numeric_limits<double>::quiet_NaN();
    for (Index m = mode; m < own_errors.size(); m += 6) error = std::fmax(error, own_errors(m));
    if (std::isnan(error)) continue;
    const std::string name(mode_names[static_cast<std::size_t>(mode)]);
    all.push_back(fmt::format("{} {:.1e}", name, error));
    if (error > much * told) worse.push_back(name);
  }
  if (all.empty()) return {};
  return fmt::format(
      "error by panels of each mode over the largest value of its own: {}{}", fmt::join(all, ", "),
      worse.empty() ? "" : fmt::format("; what depends on {} is known no better", fmt::join(worse, ", ")));
}

SelfCheck self_check(const std::vector<OneFrequency>& results, double arm) {
  const Sizes s = sizes(results, arm);
  SelfCheck check;
  for (const OneFrequency& r : results) {
    check.energy = std::max(check.energy, potential::relative_size(r.B - r.B_far, s.B));
    check.haskind = std::max(check.haskind, relative(MatrixXcd(r.X - r.X_far), s.X));
    check.reciprocity = std::max({check.reciprocity, potential::relative_size(r.A - r.A.transpose(), s.A),
                                  potential::relative_size(r.B - r.B.transpose(), s.B)});
  }
  for (const OneFrequency& r : results) check.partial_waves = std::max(check.partial_waves, r.partial_waves);
  check.estimate = std::numeric_limits<double>::quiet_NaN();
  check.length = arm;
  return check;
}

double estimate_of(const std::vector<OneFrequency>& results, const std::vector<OneFrequency>& finer,
                   const std::vector<std::size_t>& refined, double arm, Eigen::VectorXd& own) {
  const Sizes s = sizes(results, arm);
  OwnErrors of_own(results, arm);
  double change = 0;
  for (std::size_t i = 0; i < finer.size(); ++i) {
    const OneFrequency changed = sum(finer[i], -1, results[refined[i]]);
    change = std::max(change, largest(changed, s));
    of_own.take(changed, coarse_over_change);
  }
  own = of_own.of_mode;
  return coarse_over_change * change;
}

double truncation_of(const OneFrequency& fewer, const OneFrequency& more, const Sizes& size) {
  return largest(sum(more, -1, fewer), size) / (1 - 1 / more_partial_waves);
}

double difference(const potential::Coefficients& c, const potential::Coefficients& reference, double length) {
  require(c.omega == reference.omega && c.heading == reference.heading && c.modes() == reference.modes(),
          "coefficients are compared at the same frequencies and headings, of as many modes");
  const auto at = [](const potential::Coefficients& of, std::size_t w) {
    OneFrequency one{of.A[w], of.B[w], of.B[w], {}, {}};
    one.X.resize(of.modes(), static_cast<Index>(of.heading.size()));
    for (Index h = 0; h < one.X.cols(); ++h)
      one.X.col(h) = of.X[static_cast<std::size_t>(h)].col(static_cast<Index>(w));
    one.X_far = one.X;
    return one;
  };
  std::vector<OneFrequency> all;
  for (std::size_t w = 0; w < c.omega.size(); ++w) all.push_back(at(reference, w));
  const Sizes size = sizes(all, length);
  double out = 0;
  for (std::size_t w = 0; w < c.omega.size(); ++w) out = std::max(out, largest(sum(at(c, w), -1, all[w]), size));
  return out;
}

}  // namespace hydro::panels
