#pragma once
/// \file  How large quadratic drag would be beside the wave loads of a linear response that leaves it out. (D144)
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/frequency/small_motions.hpp"
#include "hydro/base/types.hpp"

namespace dynamics::frequency {

/// Where drag is largest beside the wave load.
struct DragSize {
  int mode;      ///< 6 body + 0 … 5
  double omega;  ///< at which drag in this mode is largest, rad/s
  double
      per_metre;  ///< amplitude of drag over that of the largest wave load, both in this mode, per metre of amplitude
};

/// (D144): drag of members, left out, by the relative velocities of responses that were found without it. It goes with
/// the square of the waves' amplitude and the wave load with the amplitude, so one number tells both for all waves.
class DragLeftOut {
 public:
  /// `pieces` without current, bodies as `about` has them; must live as long.
  DragLeftOut(const SmallMotions& about, const std::vector<DragPiece>& pieces, const hydro::Water& water);

  /// Takes responses `xi`, (6N), per metre of wave, to the wave loads `X`, (6N), N and N m per metre, of one frequency,
  /// rad/s, and heading, rad.
  void take(double omega, double heading, const Eigen::VectorXcd& xi, const Eigen::VectorXcd& X);

  /// Of all that was taken; none where waves move nothing, or no piece meets water that moves past it.
  std::optional<DragSize> largest() const;

 private:
  const SmallMotions& about_;
  const std::vector<DragPiece>& pieces_;
  std::vector<DragPiece> turned_;
  hydro::Water water_;
  Eigen::VectorXd drag_, load_, work_, omega_;  // largest of each mode, and where drag is
};

}  // namespace dynamics::frequency
