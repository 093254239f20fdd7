#pragma once
/// \file  A steady oscillation as a series of harmonics, with its errors. Private to libfit.
#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace fit {

/// mean + Σ_k Re a_k e^{ikωt}, by least squares.
struct HarmonicSeries {
  Eigen::VectorXd x, fitted;   ///< mean, then the parts of a_1, a_2 …; the series at the samples
  Eigen::MatrixXd covariance;  ///< of x, the memory of what is left counted (F4)
  double dof, rms;             ///< of Student's t with `covariance`; of what is left
  bool repeats = false;        ///< what is left hardly forgets within the record
  std::complex<double> amplitude(int k) const { return {x[2 * k - 1], x[2 * k]}; }
  /// Standard error of one part of amplitude k, the mean of both.
  double error(int k = 1) const { return std::sqrt((covariance(2 * k - 1, 2 * k - 1) + covariance(2 * k, 2 * k)) / 2); }
};
HarmonicSeries fit_series(const Eigen::VectorXd& time, const Eigen::VectorXd& values, double omega, int highest,
                          double step);

/// The frequency of a motion without mean, rad/s: the peak of its transform, (F50). \throws hydro::InputError for fewer
/// than three cycles
double frequency_of(const Eigen::VectorXd& motion, double step);

}  // namespace fit
