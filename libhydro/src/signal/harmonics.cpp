#include "hydro/signal/harmonics.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

// Amplitudes lose about this factor times the rounding error; beyond it they would be noise with many digits.
constexpr double max_condition = 1e8;

void check(std::span<const double> time_s, std::span<const double> values, std::span<const double> omega) {
  require(time_s.size() == values.size(), "{} times but {} values", time_s.size(), values.size());
  const auto is_finite = [](double x) { return std::isfinite(x); };
  require(std::all_of(time_s.begin(), time_s.end(), is_finite), "a time is not a finite number");
  require(std::all_of(values.begin(), values.end(), is_finite), "a value is not a finite number");
  for (std::size_t k = 0; k < omega.size(); ++k) {
    require(std::isfinite(omega[k]) && omega[k] > 0, "a frequency must be positive, got {} rad/s", omega[k]);
    require(std::find(omega.begin(), omega.begin() + static_cast<std::ptrdiff_t>(k), omega[k]) ==
                omega.begin() + static_cast<std::ptrdiff_t>(k),
            "the frequency {} rad/s is given twice", omega[k]);
  }
  require(values.size() >= 2 * omega.size() + 1,
          "{} samples cannot give a mean and {} complex amplitudes: {} are needed", values.size(), omega.size(),
          2 * omega.size() + 1);
}

}  // namespace

Harmonics fit_harmonics(std::span<const double> time_s, std::span<const double> values, std::span<const double> omega) {
  check(time_s, values, omega);
  const auto n = static_cast<Eigen::Index>(values.size());
  const auto m = static_cast<Eigen::Index>(omega.size());
  // Time from the middle of the record keeps cosine and sine columns nearly orthogonal for short records.
  const double middle = n > 0 ? (time_s.front() + time_s.back()) / 2 : 0;
  Eigen::MatrixXd basis(n, 2 * m + 1);  // (S2): 1, cos ωt, −sin ωt
  for (Eigen::Index j = 0; j < n; ++j) {
    basis(j, 0) = 1;
    for (Eigen::Index k = 0; k < m; ++k) {
      const double phase = omega[static_cast<std::size_t>(k)] * (time_s[static_cast<std::size_t>(j)] - middle);
      basis(j, 2 * k + 1) = std::cos(phase);
      basis(j, 2 * k + 2) = -std::sin(phase);
    }
  }
  const Eigen::Map<const Eigen::VectorXd> x(values.data(), n);
  const dense::PivotedQr qr(basis);
  const Eigen::VectorXd singular = dense::singular_values(qr.R());
  require(singular.minCoeff() * max_condition > singular.maxCoeff(),
          "a record of {:.6g} s with {} samples cannot tell the {} frequencies and the mean apart",
          n > 0 ? time_s.back() - time_s.front() : 0.0, values.size(), omega.size());
  const Eigen::VectorXd c = qr.solve(x);
  Harmonics result{c[0], {}, (x - basis * c).norm() / std::sqrt(static_cast<double>(n))};
  for (Eigen::Index k = 0; k < m; ++k)
    result.amplitude.push_back(std::complex<double>(c[2 * k + 1], c[2 * k + 2]) *
                               std::polar(1.0, -omega[static_cast<std::size_t>(k)] * middle));
  return result;
}

}  // namespace hydro::signal
