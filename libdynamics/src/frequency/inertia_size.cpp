#include "dynamics/frequency/inertia_size.hpp"

#include <algorithm>
#include <cmath>

#include "drag_motion.hpp"

namespace dynamics::frequency {

using Eigen::Index, Eigen::VectorXcd, Eigen::VectorXd;

InertiaLeftOut::InertiaLeftOut(const SmallMotions& about, const std::vector<InertiaPiece>& pieces,
                               const hydro::Water& water)
    : about_(about), water_(water) {
  for (const InertiaPiece& p : pieces) {
    at_.push_back(p.at);
    displaced_.push_back(p.displaced);
    added_.push_back(p.added);
  }
  turned_ = turned(at_, about.still);
  for (VectorXd* of : {&inertia_, &load_, &work_, &omega_}) *of = VectorXd::Zero(about.model.modes());
}

// Per length ρ¼πD² P(u̇ + C_A(u̇ − ẇ)), with u̇ = iωu of linear waves and ẇ = −ω²Jξ. (D43)
void InertiaLeftOut::take(double omega, double heading, const VectorXcd& xi, const VectorXcd& X) {
  const VectorXcd u = water_velocity(at_, about_.model.bodies(), water_, omega, heading);
  VectorXcd F = VectorXcd::Zero(xi.size());
  for (std::size_t i = 0; i < turned_.size(); ++i) {
    const DragPiece& piece = turned_[i];
    const Eigen::Matrix<double, 3, 6> J = velocity_across(piece);
    const Eigen::Vector3cd water =
        std::complex<double>(0, omega) * (across(piece) * u.segment<3>(3 * static_cast<Index>(i)));
    const Eigen::Vector3cd own = -omega * omega * (J * xi.segment<6>(6 * piece.body));
    F.segment<6>(6 * piece.body) += J.transpose() * ((displaced_[i] + added_[i]) * water - added_[i] * own);
  }
  for (Index m = 0; m < F.size(); ++m) {
    if (std::abs(F[m]) > inertia_[m]) omega_[m] = omega;
    inertia_[m] = std::max(inertia_[m], std::abs(F[m]));
    load_[m] = std::max(load_[m], std::abs(X[m]));
    work_[m] = std::max(work_[m], std::abs(X[m] * xi[m]));
  }
}

std::optional<InertiaSize> InertiaLeftOut::largest() const {
  constexpr double moves = 1e-3;  // of the work in the foremost mode, as (D144)
  std::optional<InertiaSize> out;
  for (Index m = 0; m < inertia_.size(); ++m) {
    if (inertia_[m] == 0 || work_[m] == 0 || work_[m] < moves * work_.maxCoeff()) continue;
    const double share = inertia_[m] / load_[m];
    if (!out || share > out->share) out = InertiaSize{static_cast<int>(m), omega_[m], share};
  }
  return out;
}

}  // namespace dynamics::frequency
