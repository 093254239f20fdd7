#include "dynamics/frequency/drag_size.hpp"

#include <algorithm>
#include <cmath>

#include "drag_motion.hpp"
#include "dynamics/frequency/linear_drag.hpp"

namespace dynamics::frequency {

using Eigen::Index, Eigen::VectorXcd, Eigen::VectorXd;

DragLeftOut::DragLeftOut(const SmallMotions& about, const std::vector<DragPiece>& pieces, const hydro::Water& water)
    : about_(about), pieces_(pieces), turned_(turned(pieces, about.still)), water_(water) {
  const Index modes = 6 * static_cast<Index>(about.model.bodies().size());
  for (VectorXd* of : {&drag_, &load_, &work_, &omega_}) *of = VectorXd::Zero(modes);
}

void DragLeftOut::take(double omega, double heading, const VectorXcd& xi, const VectorXcd& X) {
  const VectorXcd u = water_velocity(pieces_, about_.model.bodies(), water_, omega, heading);
  VectorXcd Q = VectorXcd::Zero(xi.size());
  for (std::size_t i = 0; i < turned_.size(); ++i) {
    const DragPiece& piece = turned_[i];
    const Eigen::Matrix<double, 3, 6> J = projected_velocity(piece);
    const Eigen::Vector3cd relative = projection(piece) * u.segment<3>(3 * static_cast<Index>(i)) -
                                      std::complex<double>(0, omega) * J * xi.segment<6>(6 * piece.body);
    Q.segment<6>(6 * piece.body) += piece.factor * energy_equivalent_speed(relative) * J.transpose() * relative;
  }
  for (Index m = 0; m < Q.size(); ++m) {
    if (std::abs(Q[m]) > drag_[m]) omega_[m] = omega;
    drag_[m] = std::max(drag_[m], std::abs(Q[m]));
    load_[m] = std::max(load_[m], std::abs(X[m]));
    work_[m] = std::max(work_[m], std::abs(X[m] * xi[m]));
  }
}

std::optional<DragSize> DragLeftOut::largest() const {
  // Where symmetry leaves a mode without a load, rounding is all there is: a quotient of two such is no size.
  constexpr double moves = 1e-3;  // of the work in the foremost mode
  std::optional<DragSize> out;
  for (Index m = 0; m < drag_.size(); ++m) {
    if (drag_[m] == 0 || work_[m] == 0 || work_[m] < moves * work_.maxCoeff()) continue;
    const double per_metre = drag_[m] / load_[m];
    if (!out || per_metre > out->per_metre) out = DragSize{static_cast<int>(m), omega_[m], per_metre};
  }
  return out;
}

}  // namespace dynamics::frequency
