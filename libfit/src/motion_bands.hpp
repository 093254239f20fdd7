#pragma once
/// \file  Bands of a fitted motion; (F46), docs/theory/fit.md. Private to libfit.
#include <Eigen/Core>

#include <vector>

namespace fit {

/// Half widths at each sample, one matrix a window as its samples, of the fitted motion and of a sample measured anew.
struct MotionBands {
  std::vector<Eigen::MatrixXd> of_fit, of_sample;
  double inside;  ///< share of the samples within those of a sample
};
/// `left` is what is measured less what is fitted, the rows of the Jacobian are its samples over the channels'
/// deviations: window after window, in each one channel after the other. `rms` is that of each channel.
MotionBands motion_bands(const std::vector<Eigen::MatrixXd>& left, const Eigen::MatrixXd& jacobian,
                         const Eigen::MatrixXd& covariance, const std::vector<double>& deviations,
                         const std::vector<double>& rms, double quantile);

}  // namespace fit
