#pragma once
/// \file  One truncated cylinder by plain eigenfunction matching: cosines in both regions, the same potential and flux
/// at r = a. Converges slowly (three digits with a hundred cosines), but shares nothing with the solver.
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace froude_test {

/// Added mass A and damping B of heave or surge.
struct PlainRadiation {
  double A, B;
};

class PlainCylinder {
 public:
  /// `k`: wavenumber. Evanescent roots by bisection.
  PlainCylinder(double a, double d, double h, double omega, double k, double g, int cosines)
      : a_(a), d_(d), h_(h), omega_(omega), inner_(cosines), outer_(cosines * 5 / 4) {
    roots_.emplace_back(0, k);  // cos(ik z) = cosh kz
    for (int n = 1; n < outer_; ++n) roots_.emplace_back(bisected(n, omega * omega / g), 0);
  }

  PlainRadiation heave(double rho) const {
    const double b = h_ - d_;
    const auto solved = solve(
        0, [&](double y) { return (y * y - a_ * a_ / 2) / (2 * b); }, -a_ / (2 * b), false);
    Complex sum = solved.beta(0) * a_ * a_ / 2.0 + (b * b * a_ * a_ / 2 - std::pow(a_, 4) / 8) / (2 * b);
    for (int j = 1; j < inner_; ++j) {
      const double l = j * std::numbers::pi / b;
      sum += solved.beta(j) * (j % 2 == 0 ? a_ : -a_) * i_ratio(1, 0, l * a_) / l;
    }
    return radiation(-2 * std::numbers::pi * sum, rho);
  }

  PlainRadiation surge(double rho) const {
    const auto solved = solve(
        1, [](double) { return 0.0; }, 0, true);
    Complex sum = 0;
    for (int n = 0; n < outer_; ++n) sum += side(n) * ratio(1, n) * solved.V(n);
    return radiation(std::numbers::pi * a_ * h_ * sum, rho);
  }

 private:
  using Complex = std::complex<double>;
  struct Solved {
    Eigen::VectorXcd beta, V;
  };

  PlainRadiation radiation(Complex load, double rho) const { return {-rho * load.real(), rho * omega_ * load.imag()}; }

  double bisected(int n, double K) const {
    double low = (n - 0.5) * std::numbers::pi, high = n * std::numbers::pi;
    const auto f = [&](double y) { return y * std::sin(y) + K * h_ * std::cos(y); };
    const bool low_sign = f(low) > 0;
    for (int step = 0; step < 60; ++step) ((f((low + high) / 2) > 0) == low_sign ? low : high) = (low + high) / 2;
    return low / h_;
  }
  Complex root_norm(int n) const {
    const Complex x = 2.0 * roots_[static_cast<std::size_t>(n)] * h_;
    return std::sqrt(0.5 * (1.0 + std::sin(x) / x));
  }
  static double i_ratio(int m, int l, double x) {  // large arguments: both behave as e^x (1 − (4m² − 1)/(8x) …)
    if (x < 300) return std::cyl_bessel_i(m, x) / std::cyl_bessel_i(l, x);
    return (1 - (4 * m * m - 1) / (8 * x)) / (1 - (4 * l * l - 1) / (8 * x));
  }
  /// Q/Q′ of the outgoing function.
  Complex ratio(int m, int n) const {
    if (n == 0) {
      const double k = roots_[0].imag(), x = k * a_;
      const Complex H(std::cyl_bessel_j(m, x), -std::cyl_neumann(m, x));
      const Complex next(std::cyl_bessel_j(m + 1, x), -std::cyl_neumann(m + 1, x));
      return H / (k * (m / x * H - next));
    }
    const double kappa = roots_[static_cast<std::size_t>(n)].real(), x = kappa * a_;
    if (x > 300) return -1 / (kappa * (1 + 1 / (2 * x)));
    const double K = std::cyl_bessel_k(m, x);
    return K / (kappa * (m / x * K - std::cyl_bessel_k(m + 1, x)));
  }
  Complex side(int n) const {
    const Complex x = roots_[static_cast<std::size_t>(n)];
    return (std::sin(x * h_) - std::sin(x * (h_ - d_))) / (x * h_) / root_norm(n);
  }
  /// Potential of the interior Σ β_j P_j cos(jπy/b) + particular; V_n: radial velocity at r = a in the outer modes.
  template <class Particular>
  Solved solve(int m, Particular particular, double particular_slope, bool moving_side) const {
    const double b = h_ - d_;
    Eigen::MatrixXcd S(inner_, outer_);  // (1/b)∫ cos(jπy/b) cos(κ_n y) dy/√N_n
    Eigen::VectorXcd q(outer_), given(outer_);
    Eigen::VectorXd slope(inner_), p(inner_), inverse_eps = Eigen::VectorXd::Constant(inner_, 0.5);
    inverse_eps(0) = 1;
    for (int n = 0; n < outer_; ++n) {
      const Complex x = roots_[static_cast<std::size_t>(n)];
      for (int j = 0; j < inner_; ++j) {
        const double l = j * std::numbers::pi / b;
        S(j, n) = 0.5 * (std::sin((l + x) * b) / (l + x) + std::sin((l - x) * b) / (l - x)) / b / root_norm(n);
      }
      q(n) = ratio(m, n);
      given(n) = b / h_ * particular_slope * S(0, n) + (moving_side ? side(n) : Complex(0));
    }
    for (int j = 0; j < inner_; ++j) {
      const double l = j * std::numbers::pi / b;
      slope(j) = j == 0 ? m / a_ : l * (i_ratio(m + 1, m, l * a_) + m / (l * a_));
      constexpr int samples = 4000;
      p(j) = 0;
      for (int i = 0; i < samples; ++i) {
        const double y = (i + 0.5) * b / samples;
        p(j) += particular(y) * std::cos(l * y) / samples;
      }
    }
    const Eigen::MatrixXcd Sq = S * q.asDiagonal();
    Eigen::MatrixXcd M = -(b / h_) * (Sq * S.transpose()) * slope.cast<Complex>().asDiagonal();
    M += inverse_eps.cast<Complex>().asDiagonal();
    const Eigen::VectorXcd beta = M.partialPivLu().solve(Sq * given - p.cast<Complex>());
    return {beta, (b / h_) * (S.transpose() * slope.cast<Complex>().asDiagonal() * beta) + given};
  }

  double a_, d_, h_, omega_;
  int inner_, outer_;
  std::vector<Complex> roots_;
};

}  // namespace froude_test
