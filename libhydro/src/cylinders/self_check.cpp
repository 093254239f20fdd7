#include "self_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "potential/modes.hpp"

namespace hydro::cylinders {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
  return {potential::with_floor(s.A), potential::with_floor(s.B), potential::with_floor(s.X)};
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
    check.energy = std::max(check.energy, potential::relative_size(r.B - r.B_far, s.B));
    check.haskind = std::max(check.haskind, relative(MatrixXcd(r.X - r.X_far), s.X));
    check.reciprocity = std::max({check.reciprocity, potential::relative_size(r.A - r.A.transpose(), s.A),
                                  potential::relative_size(r.B - r.B.transpose(), s.B)});
    check.partial_waves = std::max(check.partial_waves, r.partial_waves);
    check.left_out = std::max(check.left_out, r.left_out);
    check.steps = std::max(check.steps, r.steps);
    check.lattice = check.lattice || r.lattice;
  }
  if (finer.empty()) check.doubling = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < finer.size(); ++i) {
    const OneFrequency& r = results[doubled[i]];
    check.doubling =
        std::max({check.doubling, potential::relative_size(finer[i].A - r.A, s.A),
                  potential::relative_size(finer[i].B - r.B, s.B), relative(MatrixXcd(finer[i].X - r.X), s.X)});
  }
  return check;
}

}  // namespace hydro::cylinders
