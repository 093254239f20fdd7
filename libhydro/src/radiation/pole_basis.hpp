#pragma once
/// \file  Private: the real functions of a set of poles in which every pair of modes is written, (R12).
#include <Eigen/Core>

#include <complex>
#include <vector>

#include "hydro/radiation/rational.hpp"

namespace hydro::radiation::detail {

/// Columns of poles: one for a real pole (the cosine), two for a pair (cosine, sine).
inline Eigen::Index columns(const std::vector<Pole>& poles) {
  Eigen::Index n = 0;
  for (const Pole& p : poles) n += p.omega > 0 ? 2 : 1;
  return n;
}

/// Transforms of e^{−at} cos bt and e^{−at} sin bt at iω, one column a function, (1, columns).
inline Eigen::RowVectorXcd basis_at(const std::vector<Pole>& poles, double omega) {
  Eigen::RowVectorXcd row(columns(poles));
  Eigen::Index column = 0;
  for (const Pole& p : poles) {
    const std::complex<double> s(p.decay, omega);
    if (p.omega > 0) {
      const auto D = s * s + p.omega * p.omega;
      row[column++] = s / D;
      row[column++] = p.omega / D;
    } else {
      row[column++] = 1.0 / s;
    }
  }
  return row;
}

/// Their values at time t.
inline Eigen::RowVectorXd kernels_at(const std::vector<Pole>& poles, double t) {
  Eigen::RowVectorXd row(columns(poles));
  Eigen::Index column = 0;
  for (const Pole& p : poles) {
    const double e = std::exp(-p.decay * t);
    row[column++] = e * std::cos(p.omega * t);
    if (p.omega > 0) row[column++] = e * std::sin(p.omega * t);
  }
  return row;
}

/// −K'(0) of each function: a for a cosine, −b for a sine.
inline Eigen::RowVectorXd falling_at_zero(const std::vector<Pole>& poles) {
  Eigen::RowVectorXd row(columns(poles));
  Eigen::Index column = 0;
  for (const Pole& p : poles) {
    row[column++] = p.decay;
    if (p.omega > 0) row[column++] = -p.omega;
  }
  return row;
}

/// Real parts above imaginary parts.
inline Eigen::MatrixXd stacked(const Eigen::MatrixXcd& m) {
  Eigen::MatrixXd out(2 * m.rows(), m.cols());
  out << m.real(), m.imag();
  return out;
}

}  // namespace hydro::radiation::detail
