#include "iterate.hpp"

#include <Eigen/QR>

#include <cmath>
#include <vector>

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::RowVectorXcd;
using Eigen::RowVectorXd;
using Eigen::VectorXcd;

RowVectorXcd products(const Amplitudes& a, const Amplitudes& b) {
  return a.conjugate().cwiseProduct(b).colwise().sum();
}

/// Takes the basis out of w, twice for the sake of rounding; the coefficients of each column go into `H[column]`.
void orthogonalise(const std::vector<Amplitudes>& basis, Amplitudes& w, std::vector<MatrixXcd>& H) {
  const auto step = static_cast<Index>(basis.size()) - 1;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t i = 0; i < basis.size(); ++i) {
      const RowVectorXcd part = products(basis[i], w);
      w -= basis[i] * part.asDiagonal();
      for (Index c = 0; c < w.cols(); ++c) H[static_cast<std::size_t>(c)](static_cast<Index>(i), step) += part(c);
    }
}

/// Scales each column to one; a column of zeros stays.
RowVectorXd normalise(Amplitudes& w) {
  const RowVectorXd norm = w.colwise().norm();
  w *= norm.unaryExpr([](double n) { return n > 0 ? 1 / n : 0.0; }).cast<Complex>().asDiagonal();
  return norm;
}

}  // namespace

std::optional<Iterated> iterate(const std::function<Amplitudes(const Amplitudes&)>& M, const Amplitudes& y,
                                double precision, int most) {
  Amplitudes first = y;
  const RowVectorXd size = normalise(first);
  std::vector<Amplitudes> basis{std::move(first)};
  std::vector<MatrixXcd> H(static_cast<std::size_t>(y.cols()), MatrixXcd::Zero(most + 1, most));
  MatrixXcd weight = MatrixXcd::Zero(most, y.cols());
  std::vector<bool> done(static_cast<std::size_t>(y.cols()));
  for (Index c = 0; c < y.cols(); ++c) done[static_cast<std::size_t>(c)] = size(c) == 0;
  for (int step = 1; step <= most; ++step) {
    Amplitudes w = M(basis.back());
    orthogonalise(basis, w, H);
    const RowVectorXd beyond = normalise(w);
    bool all_done = true;
    for (Index c = 0; c < y.cols(); ++c) {
      const auto at = static_cast<std::size_t>(c);
      if (done[at]) continue;
      H[at](step, step - 1) = beyond(c);
      const MatrixXcd part = H[at].topLeftCorner(step + 1, step);
      const VectorXcd unit = VectorXcd::Unit(step + 1, 0);
      weight.col(c).head(step) = part.householderQr().solve(unit);
      done[at] = (unit - part * weight.col(c).head(step)).norm() <= precision;
      all_done = all_done && done[at];
    }
    if (all_done) {
      Amplitudes x = Amplitudes::Zero(y.rows(), y.cols());
      for (int i = 0; i < step; ++i)
        x += basis[static_cast<std::size_t>(i)] * weight.row(i).cwiseProduct(size.cast<Complex>()).asDiagonal();
      return Iterated{std::move(x), step};
    }
    basis.push_back(std::move(w));
  }
  return {};
}

}  // namespace hydro::cylinders
