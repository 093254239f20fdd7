#include "dynamics/frequency/friction_size.hpp"

#include <complex>
#include <numbers>
#include <set>

#include "dynamics/frequency/amplitudes.hpp"

namespace dynamics::frequency {

using Eigen::Index, Eigen::VectorXcd, Eigen::VectorXd;

double FrictionSize::is_share_from(const Friction& joint, double share) const {
  return 4 / std::numbers::pi * joint.sliding / (share * holding);
}

FrictionLeftOut::FrictionLeftOut(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                 const std::vector<Friction>& joints)
    : about_(about), groups_(groups), joints_(joints) {
  const auto count = static_cast<Index>(joints.size());
  gradients_ = Eigen::MatrixXd::Zero(count, about.model.modes());
  holding_ = omega_ = VectorXd::Zero(count);
  std::set<int> modes;
  for (Index i = 0; i < count; ++i) {
    const JointCoordinate& c = joints[static_cast<std::size_t>(i)].coordinate;
    const Gradient g = c.gradient(about.still);
    gradients_.row(i).segment<6>(6 * c.first()) = g.first.transpose();
    if (c.second()) gradients_.row(i).segment<6>(6 * *c.second()) = g.second.transpose();
  }
  for (Index m = 0; m < gradients_.cols(); ++m)
    if (!gradients_.col(m).isZero(0)) modes.insert(static_cast<int>(m));
  modes_.assign(modes.begin(), modes.end());
}

// A load r at the joint moves its coordinate by g Z⁻¹gᵀ r, and waves by g ξ: both together hold it still.
void FrictionLeftOut::take(double omega, const std::vector<VectorXcd>& xi) {
  const Amplitudes by_unit = answers_to_loads(about_, groups_, {omega}, modes_);
  for (Index i = 0; i < gradients_.rows(); ++i) {
    std::complex<double> yields = 0;
    for (std::size_t m = 0; m < modes_.size(); ++m)
      yields += gradients_(i, modes_[m]) * (gradients_.row(i) * by_unit.xi[m].col(0)).value();
    if (yields == 0.0) continue;  // others hold the joint
    for (const VectorXcd& motion : xi) {
      const double holding = std::abs((gradients_.row(i) * motion).value() / yields);
      if (holding > holding_[i]) holding_[i] = holding, omega_[i] = omega;
    }
  }
}

std::optional<FrictionSize> FrictionLeftOut::largest() const {
  std::optional<FrictionSize> out;
  for (Index i = 0; i < holding_.size(); ++i) {
    if (!(holding_[i] > 0)) continue;
    const FrictionSize size{static_cast<std::size_t>(i), omega_[i], holding_[i]};
    if (!out || size.sticks_below(joints_[size.element]) > out->sticks_below(joints_[out->element])) out = size;
  }
  return out;
}

}  // namespace dynamics::frequency
