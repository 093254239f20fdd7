#include "harmonic_series.hpp"

#include <algorithm>
#include <numbers>
#include <span>

#include "fit/correlated.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"
#include "morison_columns.hpp"

namespace fit {
namespace {

/// 1, then cos kωt and −sin kωt for k = 1 …: Re a e^{ikωt} has the parts of a as its coefficients.
Eigen::MatrixXd harmonic_columns(const Eigen::VectorXd& time, double omega, int highest) {
  Eigen::MatrixXd columns(time.size(), 1 + 2 * highest);
  columns.col(0).setOnes();
  for (int k = 1; k <= highest; ++k) {
    columns.col(2 * k - 1) = (k * omega * time.array()).cos();
    columns.col(2 * k) = -(k * omega * time.array()).sin();
  }
  return columns;
}

}  // namespace

HarmonicSeries fit_series(const Eigen::VectorXd& time, const Eigen::VectorXd& values, double omega, int highest,
                          double step) {
  const Eigen::MatrixXd columns = harmonic_columns(time, omega, highest);
  HarmonicSeries fit;
  fit.x = hydro::dense::PivotedQr(columns).solve(values);
  fit.fitted = columns * fit.x;
  const Eigen::VectorXd left = values - fit.fitted;
  const auto n = static_cast<double>(values.size());
  fit.rms = std::sqrt(left.squaredNorm() / n);
  fit.covariance = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  fit.dof = n - static_cast<double>(columns.cols());
  if (left.squaredNorm() <= 1e-24 * values.squaredNorm()) return fit;  // made by the model itself
  // A fortieth of the shortest period among the columns, as correlated_covariance() has it.
  const int block = std::max(1, static_cast<int>(2 * std::numbers::pi / (highest * omega * step) / 40));
  const auto u = correlated_covariance(columns, left, block, LongMemory::widen);
  fit.covariance = u.covariance;
  fit.dof = u.dof;
  fit.repeats = u.dof_raised;
  return fit;
}

double frequency_of(const Eigen::VectorXd& motion, double step) {
  const std::span<const double> values(motion.data(), static_cast<std::size_t>(motion.size()));
  const auto w = hydro::signal::welch(values, step, {.segment = values.size() / 2 * 2, .overlap = 0});
  const double rough = hydro::signal::peak(w.spectrum, hydro::signal::whole(w.spectrum)).period_s();
  hydro::require(rough * 3 <= step * static_cast<double>(values.size()),
                 "a steady oscillation needs three cycles at least; the record holds {:.2g} of {:.4g} s",
                 step * static_cast<double>(values.size()) / rough, rough);
  return 2 * std::numbers::pi * peak_frequency(values, step, rough);
}

}  // namespace fit
