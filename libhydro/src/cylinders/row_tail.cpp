#include "row_tail.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>

#include "tails.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

bool is_smooth(double angle) { return std::abs(1.0 - std::polar(1.0, angle)) < 1e-9; }

}  // namespace

// (C20): Σ_{n>N} f = ∫_{N+½}^∞ f dn + f′(N+½)/24 + …; with n = (N+½)/y³ the integrand is a power series in y.
RowTail::RowTail(int last, const std::vector<double>& angle, const Amplitudes& amplitudes) : last_(last) {
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  const double from = last + 0.5;
  for (std::size_t j = 0; j < Gauss::abscissa().size(); ++j)
    for (const double sign : {-1.0, 1.0}) {
      const double y = 0.5 + sign * Gauss::abscissa()[j] / 2;
      points_.push_back(from / (y * y * y));
      weight_.push_back(Gauss::weights()[j] / 2 * 3 * from / std::pow(y, 4));
    }
  for (const double sign : {-1.0, 1.0}) {
    points_.push_back(from + sign);
    weight_.push_back(sign / 48);
  }
  for (int i = 1; i <= 3; ++i) points_.push_back(last + i);
  std::vector<std::vector<Eigen::VectorXcd>> F;
  for (const double n : points_) F.push_back(amplitudes(n));
  const Index rows = F[0][0].size();
  smooth_.assign(weight_.size(), MatrixXd::Zero(rows, rows));
  for (std::size_t k = 0; k < angle.size(); ++k)
    for (std::size_t l = 0; l < angle.size(); ++l)
      for (const bool differ : {false, true}) {
        const double turn = differ ? angle[k] - angle[l] : angle[k] + angle[l];
        const auto product = [&](std::size_t i) {
          return differ ? MatrixXcd(0.5 * F[i][k] * F[i][l].adjoint()) : MatrixXcd(0.5 * F[i][k] * F[i][l].transpose());
        };
        if (is_smooth(turn)) {
          for (std::size_t i = 0; i < weight_.size(); ++i) smooth_[i] += product(i).real();
        } else {
          Swing s{turn, {}};
          for (std::size_t i = weight_.size(); i < points_.size(); ++i) s.product.push_back(product(i));
          swinging_.push_back(std::move(s));
        }
      }
}

MatrixXd RowTail::sum(const std::vector<double>& f) const {
  MatrixXd total = MatrixXd::Zero(smooth_[0].rows(), smooth_[0].cols());
  for (std::size_t i = 0; i < weight_.size(); ++i) total += weight_[i] * f[i] * smooth_[i];
  const double* g = f.data() + weight_.size();
  for (const Swing& s : swinging_)
    for (Index r = 0; r < total.rows(); ++r)
      for (Index c = 0; c < total.cols(); ++c)
        total(r, c) +=
            oscillating_tail(last_, s.angle,
                             {g[0] * s.product[0](r, c), g[1] * s.product[1](r, c), g[2] * s.product[2](r, c)})
                .real();
  return total;
}

}  // namespace hydro::cylinders
