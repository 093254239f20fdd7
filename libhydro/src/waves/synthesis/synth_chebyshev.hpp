#pragma once
/// \file  Vertical profiles as Chebyshev polynomials on an interval of heights (W96).
#include <span>
#include <vector>

#include "synth_simd.hpp"

namespace hydro::waves {

/// Heights [bottom, top], mapped onto [−1, 1] so that those near the top have more room, where short waves are, with
/// polynomials T_0 … T_{count−1}.
class VerticalBasis {
 public:
  /// The fewest polynomials with which cosh κ(z+h)/cosh κh of every κ up to `kappa` and its slope
  /// over `kappa` are off by at most `tolerance` of the profile's largest value; with `curvature` its second derivative
  /// over its square as well. \throws InputError if 128 are not enough
  VerticalBasis(double bottom, double top, double kappa, double depth, double tolerance, bool curvature);

  double bottom() const noexcept { return bottom_; }
  double top() const noexcept { return top_; }
  std::size_t count() const noexcept { return count_; }
  std::size_t padded() const noexcept { return simd::padded(count_); }  ///< room for them in whole packs
  double error() const noexcept { return error_; }  ///< found, relative to the profile's largest value

  /// Coefficients of the profile of κ, shape (count).
  std::vector<double> profile(double kappa, double depth) const;
  /// T_q and its derivative with respect to z, each of shape (padded), zero beyond count.
  void at(double z, std::span<double> value, std::span<double> slope) const;
  /// Its second derivative, from values and slopes at the same height.
  void bend_at(double z, std::span<const double> value, std::span<const double> slope, std::span<double> bend) const;

 private:
  /// Where a height is mapped to, and how that changes with it, 1/m.
  struct Mapped {
    double s, by_z;
  };
  Mapped mapped(double z) const;
  double height(double s) const;
  /// Of waves of up to κ, or of some of them that is above the tolerance.
  double largest_error(double kappa, double depth, double tolerance, bool curvature) const;
  /// Of the profile of κ, its slope over `unit` and its curvature over unit².
  double error_of(double kappa, double unit, double depth, bool curvature) const;
  double bottom_, top_;
  double spread_, range_;  // c of (W96), 1/m, and e^{c(top − bottom)} − 1
  double error_ = 0;
  std::size_t count_ = 0;
};

}  // namespace hydro::waves
