#include "hydro/potential/body_drift.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"

namespace hydro::potential {
namespace {

double largest_force(const Eigen::MatrixX3d& load) { return load.leftCols<2>().rowwise().norm().maxCoeff(); }

double over(double difference, double size) { return size > 0 ? difference / size : 0; }

}  // namespace

// A moment that symmetry leaves nearly zero is measured by what the largest force does at the length.
double difference(const BodyDrift& coarser, const BodyDrift& finer) {
  ensure(coarser.load.rows() == finer.load.rows(), "drifts of the same bodies are compared");
  const Eigen::MatrixX3d changed = coarser.load - finer.load;
  const double force = largest_force(finer.load);
  const double moment = std::max(finer.load.col(2).cwiseAbs().maxCoeff(), finer.length * force);
  return std::max(over(largest_force(changed), force), over(changed.col(2).cwiseAbs().maxCoeff(), moment));
}

double missed(const BodyDrift& drift, const MeanDrift& together) {
  const Eigen::Vector2d sum = drift.load.leftCols<2>().colwise().sum().transpose();
  const double largest = std::max(largest_force(drift.load), together.force.norm());
  return largest > 0 ? (sum - together.force).norm() / largest : 0;
}

}  // namespace hydro::potential
