#include "dynamics/line/path.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"

namespace dynamics::line {

SplinePath::SplinePath(std::vector<double> time, const std::vector<Eigen::Vector3d>& places) : time_(std::move(time)) {
  const auto n = static_cast<Eigen::Index>(time_.size());
  hydro::require(time_.size() >= 2 && places.size() == time_.size(), "a path needs two places or more, got {}",
                 places.size());
  place_.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    place_.col(i) = places[k];
    hydro::require(places[k].allFinite() && (i == 0 || time_[k] > time_[k - 1]),
                   "places of a path must be finite and their times increase; look at place {}", i + 1);
  }
  // Three-term recurrence for the second derivatives, zero at both ends; elimination downwards and back.
  bend_ = Places::Zero(3, n);
  Eigen::VectorXd upper = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double left = time_[k] - time_[k - 1], right = time_[k + 1] - time_[k];
    const Eigen::Vector3d turn =
        (place_.col(i + 1) - place_.col(i)) / right - (place_.col(i) - place_.col(i - 1)) / left;
    const double pivot = 2 * (left + right) - left * upper[i - 1];
    upper[i] = right / pivot;
    bend_.col(i) = (6 * turn - left * bend_.col(i - 1)) / pivot;
  }
  for (Eigen::Index i = n - 2; i > 0; --i) bend_.col(i) -= upper[i] * bend_.col(i + 1);
}

Path::Place SplinePath::at(double t_s) const {
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  if (t_s < time_.front()) return {place_.leftCols<1>(), still, still};
  if (t_s > time_.back()) return {place_.rightCols<1>(), still, still};
  const auto above = std::upper_bound(time_.begin() + 1, time_.end() - 1, t_s) - time_.begin();
  const auto k = static_cast<std::size_t>(above) - 1;
  const auto i = static_cast<Eigen::Index>(k);
  const double h = time_[k + 1] - time_[k], b = (t_s - time_[k]) / h, a = 1 - b;
  const auto x0 = place_.col(i), x1 = place_.col(i + 1), c0 = bend_.col(i), c1 = bend_.col(i + 1);
  return {a * x0 + b * x1 + h * h / 6 * ((a * a * a - a) * c0 + (b * b * b - b) * c1),
          (x1 - x0) / h + h / 6 * ((1 - 3 * a * a) * c0 + (3 * b * b - 1) * c1), a * c0 + b * c1};
}

}  // namespace dynamics::line
