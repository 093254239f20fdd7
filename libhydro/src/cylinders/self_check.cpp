#include "self_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hydro::cylinders {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Sizes of the modes, (P11): the largest on record, but at least 1 % of the largest of the kind.
void raise_to_floor(VectorXd& size) {
  double largest[2] = {0, 0};
  for (Index i = 0; i < size.size(); ++i) largest[i % 6 / 3] = std::max(largest[i % 6 / 3], size(i));
  for (Index i = 0; i < size.size(); ++i) size(i) = std::max(size(i), 0.01 * largest[i % 6 / 3]);
}

struct Sizes {
  VectorXd A, B, X;  ///< of one load mode
};

Sizes sizes(const std::vector<OneFrequency>& results) {
  const Index modes = results.front().A.rows();
  Sizes s{VectorXd::Zero(modes), VectorXd::Zero(modes), VectorXd::Zero(modes)};
  for (const OneFrequency& r : results) {
    s.A = s.A.cwiseMax(r.A.diagonal().cwiseAbs());
    s.B = s.B.cwiseMax(r.B.diagonal().cwiseAbs());
    for (Index h = 0; h < r.X.cols(); ++h) s.X = s.X.cwiseMax(r.X.col(h).cwiseAbs());
  }
  raise_to_floor(s.A);
  raise_to_floor(s.B);
  raise_to_floor(s.X);
  return s;
}

double relative(const MatrixXd& difference, const VectorXd& size) {
  const VectorXd scale = size.cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * difference * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

double relative(const MatrixXcd& difference, const VectorXd& size) {
  if (difference.size() == 0) return 0;
  return (size.cwiseInverse().asDiagonal() * difference).cwiseAbs().maxCoeff();
}

}  // namespace

SelfCheck self_check(const std::vector<OneFrequency>& results, const std::vector<OneFrequency>& finer,
                     const std::vector<std::size_t>& doubled) {
  const Sizes s = sizes(results);
  SelfCheck check;
  for (const OneFrequency& r : results) {
    check.energy = std::max(check.energy, relative(MatrixXd(r.B - r.B_far), s.B));
    check.haskind = std::max(check.haskind, relative(MatrixXcd(r.X - r.X_far), s.X));
    check.reciprocity = std::max({check.reciprocity, relative(MatrixXd(r.A - r.A.transpose()), s.A),
                                  relative(MatrixXd(r.B - r.B.transpose()), s.B)});
    check.partial_waves = std::max(check.partial_waves, r.partial_waves);
    check.left_out = std::max(check.left_out, r.left_out);
    check.steps = std::max(check.steps, r.steps);
    check.lattice = check.lattice || r.lattice;
  }
  if (finer.empty()) check.doubling = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < finer.size(); ++i) {
    const OneFrequency& r = results[doubled[i]];
    check.doubling = std::max({check.doubling, relative(MatrixXd(finer[i].A - r.A), s.A),
                               relative(MatrixXd(finer[i].B - r.B), s.B), relative(MatrixXcd(finer[i].X - r.X), s.X)});
  }
  return check;
}

}  // namespace hydro::cylinders
