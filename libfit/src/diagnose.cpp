#include "fit/diagnose.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "block_means.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/harmonics.hpp"
#include "hydro/signal/welch.hpp"
#include "morison_columns.hpp"

namespace fit {
namespace {

/// The force less what is carried whatever the coefficients are.
Eigen::VectorXd target_of(const Cylinder& c, const ForceRecord& r) { return as_vector(r.force) - carried_force(c, r); }

std::vector<double> harmonics_of(double period_s, int highest) {
  std::vector<double> omega;
  for (int k = 1; k <= highest; ++k) omega.push_back(2 * std::numbers::pi * k / period_s);
  return omega;
}

}  // namespace

std::vector<CycleFit> fit_cycles(const Cylinder& cylinder, const ForceRecord& record, std::span<const double> starts) {
  const Eigen::MatrixXd columns = morison_columns(cylinder, record);
  const Eigen::VectorXd target = target_of(cylinder, record);
  std::vector<CycleFit> out;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const auto at = [&](double t) {
      return std::lower_bound(record.time.begin(), record.time.end(), t) - record.time.begin();
    };
    const Eigen::Index from = at(starts[i]), rows = at(starts[i + 1]) - from;
    hydro::require(rows >= 8, "the cycle from {:.4g} s to {:.4g} s has {} samples; eight are needed", starts[i],
                   starts[i + 1], rows);
    const Eigen::Vector2d x =
        hydro::dense::HouseholderQr(columns.middleRows(from, rows)).solve(target.segment(from, rows));
    out.push_back({starts[i], starts[i + 1], x[0], x[1]});
  }
  return out;
}

FourierAverages fourier_averages(const Cylinder& c, const ForceRecord& r, double period_s) {  // (F29)
  const double step = hydro::signal::even_step(r.time), omega = 2 * std::numbers::pi / period_s;
  hydro::require(period_s <= step * static_cast<double>(r.time.size() + 1),
                 "the record is shorter than its period of {:.4g} s", period_s);
  const Eigen::MatrixXd columns = morison_columns(c, r);
  const Eigen::VectorXd target = target_of(c, r);
  const std::vector<double> all = harmonics_of(period_s, 7);
  const auto series = [&](const double* first) { return std::span(first, r.time.size()); };
  const auto fits = hydro::signal::fit_harmonics(
      r.time, std::array{series(target.data()), series(columns.col(0).data()), series(columns.col(1).data())}, all);
  // F₁ = C_D D₁ + C I₁ with complex D₁, I₁: two real equations.
  const auto force = fits[0].amplitude[0], drag = fits[1].amplitude[0], inertia = fits[2].amplitude[0];
  Eigen::Matrix2d a;
  a << drag.real(), inertia.real(), drag.imag(), inertia.imag();
  const Eigen::Vector2d x = a.inverse() * Eigen::Vector2d(force.real(), force.imag());
  hydro::require(x.allFinite() && omega > 0, "drag and inertia have the same phase: they cannot be told apart");
  return {x[0], x[1]};
}

ResidualReport look_at_residuals(const Eigen::VectorXd& residuals, double force_rms, double step_s,
                                 double period_s) {  // (F30)
  hydro::require(residuals.size() >= 64, "residuals of {} samples are too few to look at", residuals.size());
  ResidualReport report{};
  std::vector<double> time(static_cast<std::size_t>(residuals.size()));
  for (std::size_t j = 0; j < time.size(); ++j) time[j] = step_s * static_cast<double>(j);
  const int highest = std::min(7, static_cast<int>(0.4 * period_s / step_s));
  const auto fit = hydro::signal::fit_harmonics(time, {residuals.data(), time.size()}, harmonics_of(period_s, highest));
  double harmonic = 0;
  for (int k = 1; k <= highest; ++k) {
    const double a = std::abs(fit.amplitude[static_cast<std::size_t>(k) - 1]);
    report.harmonics.push_back({k, a, a / (std::numbers::sqrt2 * force_rms)});
    harmonic += a * a / 2;
  }
  const double variance = (residuals.array() - residuals.mean()).square().mean();
  report.harmonic_share = variance > 0 ? std::min(1.0, harmonic / variance) : 0;
  // Ljung & Box on block means: n(n + 2) Σ ρ_k²/(n − k) is χ² of as many degrees of freedom as lags.
  const Eigen::VectorXd e = block_means(residuals, std::max(1, static_cast<int>(period_s / 40 / step_s)));
  const auto n = static_cast<double>(e.size());
  const Eigen::Index lags = std::min<Eigen::Index>(20, e.size() / 4);
  double q = 0;
  for (Eigen::Index k = 1; k <= lags && variance > 0; ++k) {
    const double rho = e.head(e.size() - k).dot(e.tail(e.size() - k)) / e.squaredNorm();
    if (k == 1) report.lag_one = rho;
    q += n * (n + 2) * rho * rho / (n - static_cast<double>(k));
  }
  report.ljung_box_p = 1 - hydro::signal::incomplete_gamma(static_cast<double>(lags) / 2, q / 2);
  return report;
}

}  // namespace fit
