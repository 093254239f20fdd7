#include "hydro/potential/body_drift.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"

namespace hydro::potential {
namespace {

/// Forces, and moments over the length.
Eigen::MatrixX3d measured(Eigen::MatrixX3d load, double length) {
  if (length > 0) load.col(2) /= length;
  return load;
}

}  // namespace

double difference(const BodyDrift& coarser, const BodyDrift& finer) {
  ensure(coarser.load.rows() == finer.load.rows(), "drifts of the same bodies are compared");
  const Eigen::MatrixX3d a = measured(coarser.load, finer.length), b = measured(finer.load, finer.length);
  const double largest = b.cwiseAbs().maxCoeff();
  return largest > 0 ? (a - b).cwiseAbs().maxCoeff() / largest : 0;
}

double missed(const BodyDrift& drift, const MeanDrift& together) {
  const Eigen::Vector2d sum = drift.load.leftCols<2>().colwise().sum().transpose();
  const double largest = std::max(drift.load.leftCols<2>().rowwise().norm().maxCoeff(), together.force.norm());
  return largest > 0 ? (sum - together.force).norm() / largest : 0;
}

}  // namespace hydro::potential
