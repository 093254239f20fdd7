#pragma once
/// \file  What remains of Σ_n f_n x_n x_nᵀ beyond its last term, for rows x_n that swing in several ways. Not
/// installed.
#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace hydro::cylinders {

/// Rows x(n) = Σ_k Re[F_k(n) e^{iθ_k n}], F_k(n) and f(n) smooth series in n^{−1/3}, f F F falling faster than 1/n
/// (C20).
class RowTail {
 public:
  using Amplitudes = std::function<std::vector<Eigen::VectorXcd>(double n)>;
  /// `angle`: the θ_k. Products whose angles differ by a multiple of 2π are smooth; the others must turn by much more
  /// than 1/last a term.
  RowTail(int last, const std::vector<double>& angle, const Amplitudes& amplitudes);

  /// Where f is needed.
  const std::vector<double>& points() const { return points_; }
  /// Σ_{n > last} f(n) x(n) x(n)ᵀ from f at the points.
  Eigen::MatrixXd sum(const std::vector<double>& f) const;

 private:
  struct Swing {
    double angle;
    std::vector<Eigen::MatrixXcd> product;  // at the last three points
  };
  int last_;
  std::vector<double> points_, weight_;  // the last three points are those of what swings
  std::vector<Eigen::MatrixXd> smooth_;
  std::vector<Swing> swinging_;
};

}  // namespace hydro::cylinders
