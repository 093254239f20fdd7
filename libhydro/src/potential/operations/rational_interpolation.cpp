#include "potential/operations/rational_interpolation.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <limits>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace hydro::potential {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;

/// So many random sums of entries stand for all of them where weights are sought: weights that serve all entries serve
/// these, and others hardly do.
constexpr Index mixtures = 40;

MatrixXcd mixed_entries(const MatrixXcd& value) {
  if (value.cols() <= mixtures) return value;
  const RandomStream random(0, 0);
  Eigen::MatrixXd mix(value.cols(), mixtures);
  for (Index i = 0; i < mix.size(); ++i) mix.data()[i] = random.normal(static_cast<std::uint64_t>(i));
  return value * mix.cast<std::complex<double>>();
}

/// Entries that are independent to `tolerance` give each place that is no support so many conditions on the weights, of
/// which there are as many as supports, but for a factor. Five are enough of them, so that a sixth of the places is
/// left.
std::size_t most_supports(const MatrixXcd& mixed, double tolerance) {
  constexpr Index enough = 5;
  Eigen::ColPivHouseholderQR<MatrixXcd> qr(mixed.rows(), mixed.cols());
  qr.setThreshold(std::max(tolerance, 1e-12));
  qr.compute(mixed);
  const Index independent = std::clamp<Index>(qr.rank(), 1, enough), places = mixed.rows();
  return static_cast<std::size_t>(std::clamp<Index>((places * independent + 1) / (independent + 1), 1, places - 2));
}

}  // namespace

Eigen::VectorXcd least_stretched(const MatrixXcd& A) {
  const Eigen::HouseholderQR<MatrixXcd> qr(A);
  MatrixXcd R = qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
  const double rounding = std::numeric_limits<double>::epsilon() * R.cwiseAbs().maxCoeff();
  for (Index i = 0; i < R.rows(); ++i)
    if (std::abs(R(i, i)) < rounding) R(i, i) = rounding > 0 ? rounding : 1;
  Eigen::VectorXcd x = Eigen::VectorXcd::Ones(A.cols()).normalized();
  constexpr int steps = 8;  // a vector that is stretched twice as much is 4⁻⁸ of what is left
  for (int i = 0; i < steps; ++i) {
    x = R.adjoint().triangularView<Eigen::Lower>().solve(x);
    x = R.triangularView<Eigen::Upper>().solve(x.normalized()).normalized();
  }
  return x;
}

RationalInterpolation::RationalInterpolation(const std::vector<double>& place, const MatrixXcd& value, double tolerance)
    : place_(place), mixed_(mixed_entries(value)) {
  ensure(place.size() >= 3, "an interpolation takes three places");
  const std::size_t most = most_supports(mixed_, tolerance);
  const Eigen::RowVectorXcd mean = value.colwise().mean();
  while (support_.size() < most) {
    Index worst = -1;
    double largest = support_.empty() ? -1 : tolerance;
    for (const Index i : others()) {
      const Eigen::RowVectorXcd known =
          support_.empty() ? mean : Eigen::RowVectorXcd(shares(place_[static_cast<std::size_t>(i)]) * value);
      const double miss = (value.row(i) - known).cwiseAbs().maxCoeff();
      if (miss <= largest) continue;
      largest = miss;
      worst = i;
    }
    if (worst < 0) return;
    support_.push_back(worst);
    find_weights();
  }
}

std::vector<Index> RationalInterpolation::others() const {
  std::vector<Index> out;
  for (Index i = 0; i < static_cast<Index>(place_.size()); ++i)
    if (std::find(support_.begin(), support_.end(), i) == support_.end()) out.push_back(i);
  return out;
}

// At every other place Σ w_j (f − f_j)/(x − x_j) = 0 of each mixture, by least squares over |w| = 1: the matrix is
// Loewner's.
void RationalInterpolation::find_weights() {
  const std::vector<Index> other = others();
  const Index each = mixed_.cols(), rows = each * static_cast<Index>(other.size());
  const auto columns = static_cast<Index>(support_.size());
  MatrixXcd loewner = MatrixXcd::Zero(std::max(rows, columns), columns);
  for (Index j = 0; j < columns; ++j) {
    const Index s = support_[static_cast<std::size_t>(j)];
    for (std::size_t i = 0; i < other.size(); ++i)
      loewner.col(j).segment(each * static_cast<Index>(i), each) =
          (mixed_.row(other[i]) - mixed_.row(s)).transpose() /
          (place_[static_cast<std::size_t>(other[i])] - place_[static_cast<std::size_t>(s)]);
  }
  weight_ = least_stretched(loewner);
}

Eigen::RowVectorXcd RationalInterpolation::shares(double x) const {
  Eigen::RowVectorXcd out = Eigen::RowVectorXcd::Zero(static_cast<Index>(place_.size()));
  for (std::size_t j = 0; j < support_.size(); ++j) {
    const Index s = support_[j];
    const double away = x - place_[static_cast<std::size_t>(s)];
    if (away == 0) {
      out.setZero();
      out[s] = 1;
      return out;
    }
    out[s] = weight_[static_cast<Index>(j)] / away;
  }
  return out / out.sum();
}

std::vector<double> RationalInterpolation::supports() const {
  std::vector<double> out;
  for (const Index s : support_) out.push_back(place_[static_cast<std::size_t>(s)]);
  return out;
}

}  // namespace hydro::potential
