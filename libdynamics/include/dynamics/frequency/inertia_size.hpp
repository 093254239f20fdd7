#pragma once
/// \file  How large Morison's inertia would be beside the wave loads of a linear response that leaves it out. (D148)
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/frequency/small_motions.hpp"
#include "hydro/base/types.hpp"

namespace dynamics::frequency {

/// One piece of a member, small enough for one acceleration.
struct InertiaPiece {
  DragPiece at;             ///< where it is; its factor does not count
  double displaced, added;  ///< ρ¼πD²ℓ and C_A times that, kg
};

/// Where the inertia load is largest beside the wave load.
struct InertiaSize {
  int mode;      ///< 6 body + 0 … 5
  double omega;  ///< at which the inertia load in this mode is largest, rad/s
  double share;  ///< its amplitude over that of the largest wave load, both in this mode
};

/// (D148): Froude–Krylov load and added mass of members, left out, by responses that were found without them. Both go
/// with the amplitude of the waves, so the share is that of all waves.
class InertiaLeftOut {
 public:
  /// `pieces` on bodies as `about` has them; must live as long.
  InertiaLeftOut(const SmallMotions& about, const std::vector<InertiaPiece>& pieces, const hydro::Water& water);

  /// Takes responses `xi`, (6N), per metre of wave, to the wave loads `X`, (6N), N and N m per metre, of one frequency,
  /// rad/s, and heading, rad.
  void take(double omega, double heading, const Eigen::VectorXcd& xi, const Eigen::VectorXcd& X);

  /// Of all that was taken; none where waves move nothing.
  std::optional<InertiaSize> largest() const;

 private:
  const SmallMotions& about_;
  std::vector<DragPiece> at_, turned_;
  std::vector<double> displaced_, added_;
  hydro::Water water_;
  Eigen::VectorXd inertia_, load_, work_, omega_;  // largest of each mode, and where inertia is
};

}  // namespace dynamics::frequency
