#include "hydro/signal/harmonics.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

// Amplitudes lose about this factor times the rounding error; beyond it they would be noise with many digits.
constexpr double max_condition = 1e8;

using Series = std::span<const std::span<const double>>;

void check(std::span<const double> time_s, Series series, std::span<const double> omega) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  require(std::all_of(time_s.begin(), time_s.end(), is_finite), "a time is not a finite number");
  for (const auto& values : series) {
    require(time_s.size() == values.size(), "{} times but {} values", time_s.size(), values.size());
    require(std::all_of(values.begin(), values.end(), is_finite), "a value is not a finite number");
  }
  for (std::size_t k = 0; k < omega.size(); ++k) {
    require(std::isfinite(omega[k]) && omega[k] > 0, "a frequency must be positive, got {} rad/s", omega[k]);
    require(std::find(omega.begin(), omega.begin() + static_cast<std::ptrdiff_t>(k), omega[k]) ==
                omega.begin() + static_cast<std::ptrdiff_t>(k),
            "the frequency {} rad/s is given twice", omega[k]);
  }
  require(time_s.size() >= 2 * omega.size() + 1,
          "{} samples cannot give a mean and {} complex amplitudes: {} are needed", time_s.size(), omega.size(),
          2 * omega.size() + 1);
}

/// A row of the basis: 1, cos ωt, −sin ωt. (S2)
void put_row(double t, std::span<const double> omega, Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row) {
  row[0] = 1;
  for (std::size_t k = 0; k < omega.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(2 * k + 1);
    row[column] = std::cos(omega[k] * t);
    row[column + 1] = -std::sin(omega[k] * t);
  }
}

/// R of [basis, series], times counted from `middle`. Rows are taken a block at a time, each below the triangle of
/// those before: the basis of a long record would be many times the record.
Eigen::MatrixXd triangle_of(std::span<const double> time_s, double middle, Series series,
                            std::span<const double> omega) {
  constexpr std::size_t block = 512;
  const auto unknowns = static_cast<Eigen::Index>(2 * omega.size() + 1),
             columns = unknowns + static_cast<Eigen::Index>(series.size());
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(columns, columns);
  for (std::size_t first = 0; first < time_s.size(); first += block) {
    const std::size_t rows = std::min(block, time_s.size() - first);
    Eigen::MatrixXd stacked(columns + static_cast<Eigen::Index>(rows), columns);
    stacked.topRows(columns) = triangle;
    for (std::size_t j = 0; j < rows; ++j) {
      const auto row = columns + static_cast<Eigen::Index>(j);
      put_row(time_s[first + j] - middle, omega, stacked.row(row).head(unknowns));
      for (std::size_t i = 0; i < series.size(); ++i)
        stacked(row, unknowns + static_cast<Eigen::Index>(i)) = series[i][first + j];
    }
    triangle = dense::HouseholderQr(stacked).R();
  }
  return triangle;
}

}  // namespace

std::vector<Harmonics> fit_harmonics(std::span<const double> time_s, std::span<const std::span<const double>> series,
                                     std::span<const double> omega) {
  check(time_s, series, omega);
  // Time from the middle of the record keeps cosine and sine columns nearly orthogonal for short records.
  const double middle = (time_s.front() + time_s.back()) / 2;
  const Eigen::MatrixXd triangle = triangle_of(time_s, middle, series, omega);
  const auto unknowns = static_cast<Eigen::Index>(2 * omega.size() + 1);
  const auto R = triangle.topLeftCorner(unknowns, unknowns);
  const Eigen::VectorXd singular = dense::singular_values(R);
  require(singular.minCoeff() * max_condition > singular.maxCoeff(),
          "a record of {:.6g} s with {} samples cannot tell the {} frequencies and the mean apart",
          time_s.back() - time_s.front(), time_s.size(), omega.size());
  std::vector<Harmonics> out;
  for (Eigen::Index i = unknowns; i < triangle.cols(); ++i) {
    const Eigen::VectorXd c = R.triangularView<Eigen::Upper>().solve(triangle.col(i).head(unknowns)),
                          left = triangle.col(i).tail(triangle.rows() - unknowns);
    out.push_back({c[0], {}, left.norm() / std::sqrt(static_cast<double>(time_s.size()))});
    for (std::size_t k = 0; k < omega.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(2 * k + 1);
      out.back().amplitude.push_back(std::complex<double>(c[at], c[at + 1]) * std::polar(1.0, -omega[k] * middle));
    }
  }
  return out;
}

Harmonics fit_harmonics(std::span<const double> time_s, std::span<const double> values, std::span<const double> omega) {
  return std::move(fit_harmonics(time_s, std::array{values}, omega).front());
}

}  // namespace hydro::signal
