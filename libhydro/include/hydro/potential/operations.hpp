#pragma once
/// \file  Moving coefficients about: another reference point, another place of the whole array, fewer bodies, other
/// frequencies.
#include <span>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// The bodies `which` (from 0), in that order, with their mutual interaction. \throws InputError if there is no such
/// body
Coefficients select(const Coefficients& all, std::span<const int> which);

/// A, B, A(0), A(∞) with the blocks between different bodies set to zero: each radiates as if alone.
Coefficients without_interaction(Coefficients c);

/// The same bodies with motions and loads about other points. `from` and `to`: one point a body, global. (P4)
Coefficients about(Coefficients c, std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

/// The whole array carried `shift` (x, y) along the water: only the phase of the excitation changes. (P5)
Coefficients carried(Coefficients c, const Eigen::Vector2d& shift);

/// A, B and X at any frequency inside the table.
///
/// Cubic between neighbouring frequencies (slopes from three points, (P6)). The excitation of each body is interpolated
/// without the phase of the wave's way to it, and each matrix entry by itself; headings are interpolated linearly.
class FrequencyTable {
 public:
  /// `origin`: the place of each body whose phase is taken out, one a body, global.
  FrequencyTable(Coefficients c, std::vector<Eigen::Vector3d> origin);

  const Coefficients& coefficients() const { return c_; }
  double lowest() const { return c_.omega.front(); }
  double highest() const { return c_.omega.back(); }
  /// \throws InputError naming the range if omega is outside it
  Eigen::MatrixXd added_mass(double omega) const;
  Eigen::MatrixXd damping(double omega) const;
  Eigen::VectorXcd excitation(double omega,
                              double heading) const;  ///< also \throws if heading is outside the table or there is none
  /// Largest difference between cubic and straight interpolation of A, B, X half way between the frequencies, relative
  /// to the largest entry of the same mode: how much the table leaves open.
  struct Openness {
    double added_mass, damping, excitation;
  };
  Openness openness() const;

 private:
  Coefficients c_;
  std::vector<Eigen::Vector3d> origin_;
  std::vector<Eigen::MatrixXcd> X_;  // per heading (6N, Nω), phase of the way taken out
};

}  // namespace hydro::potential
