#pragma once
/// \file  A cylinder that stands on the sea bed with its top under water, by plain eigenfunction matching: the modes of
/// the column above it and those of the depth, the same potential and flux at r = a. Converges slowly, but shares
/// nothing with the solver.
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace froude_test {

class PlainSubmerged {
 public:
  using Complex = std::complex<double>;

  PlainSubmerged(double a, double t, double h, double K, int modes) : a_(a), t_(t), h_(h), K_(K) {
    for (int j = 0; j < modes; ++j) above_.push_back(root(j, t));
    for (int n = 0; n < static_cast<int>(modes * h / t); ++n) outside_.push_back(root(n, h));
  }

  /// ∬ φ n dS of unit heave, and of unit surge.
  Complex heave() const {
    const Eigen::VectorXcd beta = solve(0, false);
    Complex sum = (1 / K_ - t_) * a_ * a_ / 2;
    for (int j = 0; j < beta.size(); ++j) {
      const Complex p = above_[static_cast<std::size_t>(j)], x = p * a_;
      const double over =
          j == 0 ? bessel_j(1, x.imag()) / bessel_j(0, x.imag()) / p.imag() : ratio_i(x.real()) / p.real();
      sum += beta(j) / norm(p, t_) * a_ * over;
    }
    return 2 * std::numbers::pi * sum;
  }
  Complex surge() const {
    const Eigen::VectorXcd beta = solve(1, true);
    Complex sum = 0;
    for (int n = 0; n < static_cast<int>(outside_.size()); ++n) sum += outer(1, n) * flux(1, beta, n, true) * side(n);
    return std::numbers::pi * a_ * h_ * sum;
  }

 private:
  /// Roots x of K = −x tan xh: the first is imaginary, ik.
  Complex root(int n, double depth) const {
    double low = n == 0 ? 0 : (n - 0.5) * std::numbers::pi / depth,
           high = n == 0 ? K_ + 10 / depth : n * std::numbers::pi / depth;
    const auto f = [&](double x) {
      return n == 0 ? x * std::tanh(x * depth) - K_
                    : -(x * std::sin(x * depth) + K_ * std::cos(x * depth)) * (n % 2 == 0 ? -1 : 1);
    };
    const bool rises = f(high) > 0;
    for (int step = 0; step < 60; ++step) ((f((low + high) / 2) > 0) == rises ? high : low) = (low + high) / 2;
    return n == 0 ? Complex(0, low) : Complex(low, 0);
  }
  static Complex norm(Complex x, double depth) {
    return std::sqrt(0.5 * (1.0 + std::sin(2.0 * x * depth) / (2.0 * x * depth)));
  }
  static double bessel_j(int m, double x) { return std::cyl_bessel_j(m, x); }
  static double ratio_i(double x) {  // I_1/I_0
    return x < 300 ? std::cyl_bessel_i(1, x) / std::cyl_bessel_i(0, x) : 1 - 0.5 / x;
  }
  /// P_j/P_j′ of the column at r = a.
  double inner(int m, int j) const {
    const Complex p = above_[static_cast<std::size_t>(j)];
    const double x = std::abs(p) * a_;
    if (j == 0) return bessel_j(m, x) / std::abs(p) / (m / x * bessel_j(m, x) - bessel_j(m + 1, x));
    const double slope = m == 0 ? ratio_i(x) : 1 / ratio_i(x) - 1 / x;
    return 1 / (std::abs(p) * slope);
  }
  /// Q_n/Q_n′ outside.
  Complex outer(int m, int n) const {
    const double k = std::abs(outside_[static_cast<std::size_t>(n)]), x = k * a_;
    if (n == 0) {
      const auto H = [&](int l) { return Complex(bessel_j(l, x), -std::cyl_neumann(l, x)); };
      return H(m) / k / (m / x * H(m) - H(m + 1));
    }
    if (x > 300) return -1 / (k * (1 + 1 / (2 * x)));
    return std::cyl_bessel_k(m, x) / k / (m / x * std::cyl_bessel_k(m, x) - std::cyl_bessel_k(m + 1, x));
  }
  /// (1/t)∫ Y_j Z_n dz over the column.
  Complex overlap(int j, int n) const {
    const Complex p = above_[static_cast<std::size_t>(j)], x = outside_[static_cast<std::size_t>(n)];
    const auto at = [&](double z) {
      const Complex u = p * (z + t_), v = x * (z + h_);
      return 0.5 * (std::sin(u + v) / (p + x) + std::sin(u - v) / (p - x));
    };
    return (at(0) - at(-t_)) / t_ / norm(p, t_) / norm(x, h_);
  }
  Complex side(int n) const {
    const Complex x = outside_[static_cast<std::size_t>(n)];
    return std::sin(x * (h_ - t_)) / (x * h_) / norm(x, h_);
  }
  /// V_n: the radial velocity at r = a in the modes outside.
  Complex flux(int m, const Eigen::VectorXcd& beta, int n, bool side_moves) const {
    Complex sum = side_moves ? side(n) : Complex(0);
    for (int j = 0; j < beta.size(); ++j) sum += t_ / h_ * beta(j) / inner(m, j) * overlap(j, n);
    return sum;
  }
  Eigen::VectorXcd solve(int m, bool side_moves) const {
    const auto J = static_cast<Eigen::Index>(above_.size()), N = static_cast<Eigen::Index>(outside_.size());
    Eigen::MatrixXcd O(J, N);
    Eigen::VectorXcd q(N), s = Eigen::VectorXcd::Zero(N), right = Eigen::VectorXcd::Zero(J), slope(J);
    for (int n = 0; n < N; ++n) {
      q(n) = outer(m, n);
      if (side_moves) s(n) = side(n);
      for (int j = 0; j < J; ++j) O(j, n) = overlap(j, n);
    }
    for (int j = 0; j < J; ++j) {
      const Complex p = above_[static_cast<std::size_t>(j)];
      slope(j) = 1 / inner(m, j);
      if (!side_moves) right(j) = 1.0 / (t_ * p * p * norm(p, t_));  // −(1/t)∫ (z + 1/K) Y_j dz
    }
    right += O * q.cwiseProduct(s);
    Eigen::MatrixXcd M = -(t_ / h_) * O * q.asDiagonal() * O.transpose() * slope.asDiagonal();
    M += Eigen::MatrixXcd::Identity(J, J);
    return M.partialPivLu().solve(right);
  }

  double a_, t_, h_, K_;
  std::vector<Complex> above_, outside_;
};

}  // namespace froude_test
