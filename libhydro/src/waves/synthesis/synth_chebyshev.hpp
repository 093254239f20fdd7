#pragma once
/// \file  Vertical profiles as Chebyshev polynomials on an interval of heights (W96).
#include <span>
#include <vector>

#include "synth_simd.hpp"

namespace hydro::waves {

/// Heights [bottom, top], mapped onto [−1, 1], with polynomials T_0 … T_{count−1}.
class VerticalBasis {
 public:
  /// The fewest polynomials with which cosh κ(z+h)/cosh κh of every κ up to `kappa` and its slope
  /// over κ are off by at most `tolerance` of the profile's largest value; with `curvature` its second derivative over
  /// κ² as well. \throws InputError if 128 are not enough
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
  void bend_at(double z, std::span<const double> slope, std::span<double> bend) const;

 private:
  double error_of(double kappa, double depth, bool curvature) const;
  double bottom_, top_, error_ = 0;
  std::size_t count_ = 0;
};

}  // namespace hydro::waves
