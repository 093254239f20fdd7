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

/// The whole array translated `shift` (x, y) along the water: only the phase of the excitation changes. (P5)
Coefficients translated(Coefficients c, const Eigen::Vector2d& shift);

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
  /// The same, and below the table down to ω = 0: the added mass straight to A(0), or constant where the data have no
  /// A(0); the damping straight to none, since a motion at ω = 0 makes no waves. \throws InputError naming the range
  /// above the table
  Eigen::MatrixXd added_mass_from_zero(double omega) const;
  Eigen::MatrixXd damping_from_zero(double omega) const;
  Eigen::VectorXcd excitation(double omega,
                              double heading) const;  ///< also \throws if heading is outside the table or there is none
  /// Largest difference between cubic and straight interpolation of A, B, X half way between the frequencies, relative
  /// to the largest entry of the same mode: the error of interpolation. Modes below a millionth of the largest force
  /// or moment have rounding alone and are left out.
  struct InterpolationError {
    double added_mass, damping, excitation;
  };
  InterpolationError interpolation_error() const;
  /// What interpolation misses at the frequencies of the table but its ends, each left out in turn, relative to the
  /// largest entry of the same mode, of the same modes: the error with twice the spacing (P32). Zero for fewer than
  /// three frequencies.
  InterpolationError error_with_twice_the_spacing() const;

 private:
  template <class Gap>
  InterpolationError largest(Gap gap) const;

  Coefficients c_;
  std::vector<Eigen::Vector3d> origin_;
  std::vector<Eigen::MatrixXcd> X_;  // per heading (6N, Nω), phase of the way taken out
};

/// Coefficients at other frequencies, and how far interpolation may be off.
struct Resampled {
  Coefficients coefficients;
  FrequencyTable::InterpolationError error;  ///< estimate, relative as in FrequencyTable::interpolation_error()
};

/// A, B and X at `omega` by FrequencyTable; limits and C stay. The phases of the waves' way are taken to the reference
/// points, or to the origin where they are unknown. The error is half of that with twice the spacing, anywhere in
/// the table (P32): an estimate, on the safe side where the coefficients are smooth from one frequency to the next, and
/// worth nothing where they are not. \throws InputError unless `omega` increases within the table
Resampled resampled(const Coefficients& c, std::span<const double> omega);

}  // namespace hydro::potential
