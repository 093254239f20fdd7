#include "motion_bands.hpp"

#include <cmath>
#include <limits>

namespace fit {

MotionBands motion_bands(const std::vector<Eigen::MatrixXd>& left, const Eigen::MatrixXd& jacobian,
                         const Eigen::MatrixXd& covariance, const std::vector<double>& deviations,
                         const std::vector<double>& rms, double quantile) {  // (F46)
  const Eigen::VectorXd variance = (jacobian * covariance).cwiseProduct(jacobian).rowwise().sum().cwiseMax(0);
  MotionBands out{};
  double inside = 0, measured = 0;
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& window : left) {
    Eigen::MatrixXd of_fit = variance.segment(at, window.size()).reshaped(window.rows(), window.cols()),
                    of_sample = of_fit;
    for (Eigen::Index c = 0; c < window.cols(); ++c) {
      const auto channel = static_cast<std::size_t>(c);
      of_fit.col(c) *= std::pow(deviations[channel], 2);
      of_sample.col(c) = of_fit.col(c).array() + std::pow(rms[channel], 2);
    }
    out.of_fit.emplace_back(quantile * of_fit.cwiseSqrt());
    out.of_sample.emplace_back(quantile * of_sample.cwiseSqrt());
    const auto unmeasured = window.array().isNaN().eval();
    for (auto* band : {&out.of_fit.back(), &out.of_sample.back()})
      *band = unmeasured.select(std::numeric_limits<double>::quiet_NaN(), band->array());
    inside += static_cast<double>((window.cwiseAbs().array() <= out.of_sample.back().array()).count());
    measured += static_cast<double>((!unmeasured).count());
    at += window.size();
  }
  out.inside = inside / measured;
  return out;
}

}  // namespace fit
