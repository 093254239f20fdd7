#pragma once
/// \file  Private: whether a pole model can give energy to a motion, and making it unable to. (R15)-(R17)
#include <Eigen/Core>

#include <complex>
#include <vector>

#include "hydro/radiation/rational.hpp"

namespace hydro::radiation::detail {

/// A symmetric matrix as its upper triangle in one row, off-diagonal entries times √2 so that lengths agree.
Eigen::RowVectorXd packed(const Eigen::MatrixXd& symmetric);
Eigen::MatrixXd unpacked(const Eigen::RowVectorXd& row, Eigen::Index n);
/// Place of the pair i <= j in that row.
inline Eigen::Index packed_place(Eigen::Index i, Eigen::Index j) { return j * (j + 1) / 2 + i; }

/// Q(θ) = B(ω)/sin² 2θ with ω = c tan θ, 0 <= θ <= π/2: finite at both ends, where B itself goes to zero. (R15)
/// Everything is linear in the coefficients, so this class only makes rows that multiply them.
class WeightedDamping {
 public:
  WeightedDamping(std::vector<Pole> poles, double centre);

  double centre() const { return c_; }
  const std::vector<Pole>& poles() const { return poles_; }
  /// Rows of the derivatives 0, 1 and 2 of Q by θ, (3, columns).
  Eigen::MatrixXd rows(double theta) const;
  /// Bound on |Q‴| of each pole's share within `radius` of θ, per unit of √(C² + S²)/2, one a pole.
  Eigen::VectorXd third_derivative(double theta, double radius) const;

 private:
  /// Of the pole p above the axis, on the circle of z = e^{2iθ}: constant + k/(z − place), what W/(s − p) is there.
  struct Share {
    std::complex<double> constant, k, place;
  };
  std::vector<Pole> poles_;
  double c_;
  Eigen::RowVectorXd falling_;
  std::vector<Share> shares_;
};

struct Certificate {
  bool passive = false;      ///< Q(θ) − margin ⪰ 0 for every θ
  std::vector<double> open;  ///< θ at which that fails or could not be decided
};

/// Covers 0 … π/2 with intervals on which Q − margin is shown to be positive definite: the quadratic of Q at the middle
/// by its Bernstein matrices, the rest by a bound of the third derivative. (R16)
Certificate certify(const WeightedDamping& weighted, const Eigen::MatrixXd& coefficients, Eigen::Index n,
                    double margin);

/// Least-squares problem of the coefficients: ‖design · x − right‖, x (columns + extra, pairs). The last `extra`
/// columns have no damping.
struct Fitting {
  Eigen::MatrixXd design, right;
  Eigen::Index extra = 0;
};

/// x with least ‖design · x − right‖, columns scaled.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& design, const Eigen::MatrixXd& right);

struct Margins {
  double kept;    ///< by which Q shall be positive at every angle
  double lifted;  ///< what B may be short of that before damping on all modes alike makes it good; 0: nothing
};

struct Approached {
  Eigen::MatrixXd x;
  bool near = false;         ///< Q is short of its margins at no angle looked at
  double most_negative = 0;  ///< eigenvalue of Q at those angles before
};

/// From the least-squares solution towards those that are passive with margins. (R17)
/// `null` spans coefficients that vanish at rest: coefficients = null · x.
Approached approach(const WeightedDamping& weighted, const Eigen::MatrixXd& null, const Fitting& fitting,
                    Eigen::Index n, const Margins& margins);

struct Covered {
  Eigen::MatrixXd x;
  bool passive = false;  ///< by a certificate
  double lift = 0;       ///< largest Q added to all modes alike
};

/// What x is short of `margin` covered by damping that acts on all modes alike, as little of it as does.
Covered cover(const WeightedDamping& weighted, const Eigen::MatrixXd& null, const Fitting& fitting, Eigen::Index n,
              double margin, const Eigen::MatrixXd& x);

}  // namespace hydro::radiation::detail
