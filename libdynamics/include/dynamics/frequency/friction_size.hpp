#pragma once
/// \file  In which waves friction holds joints that a linear response lets move freely. (D146)
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "dynamics/force/friction.hpp"
#include "dynamics/frequency/rao.hpp"

namespace dynamics::frequency {

/// One joint beside the waves.
struct FrictionSize {
  std::size_t element;  ///< among those given
  double omega;         ///< at which the load that would hold the joint is largest, rad/s
  double holding;       ///< amplitude of that load, N m or N per metre of wave amplitude

  /// Below this amplitude of waves, m, the joint never slips.
  double sticks_below(const Friction& joint) const { return joint.breakaway / holding; }
  /// Above this amplitude, m, the friction of a joint that slips is less than that share of the load: the first
  /// harmonic of a force that changes its sign with the motion is 4/π of it.
  double is_share_from(const Friction& joint, double share) const;
};

/// (D146): by responses that were found without friction, and the motion that a load at the joint makes, the others
/// moving freely. Cost: one factorisation a frequency, with twelve right-hand sides a joint.
class FrictionLeftOut {
 public:
  /// `joints`: with levels that are finite. All must live as long.
  FrictionLeftOut(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                  const std::vector<Friction>& joints);

  /// Takes responses `xi`, (6N), one a heading, per metre of wave, of one frequency, rad/s.
  void take(double omega, const std::vector<Eigen::VectorXcd>& xi);

  /// The joint that sticks in the highest waves; none where waves load no joint.
  std::optional<FrictionSize> largest() const;

 private:
  const SmallMotions& about_;
  const std::vector<PotentialGroup>& groups_;
  const std::vector<Friction>& joints_;
  std::vector<int> modes_;     // of the bodies of all joints, increasing
  Eigen::MatrixXd gradients_;  // of the coordinates, (joints, 6N)
  Eigen::VectorXd holding_, omega_;
};

}  // namespace dynamics::frequency
