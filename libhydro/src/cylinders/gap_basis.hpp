#pragma once
/// \file  The radial velocity in the gap under a cylinder, in functions that share its singularity at the edge.
///
/// With τ = (z+h)/b from 0 at the sea bed to 1 at the edge, b = h − d, the velocity behaves there as (1 − τ)^{−1/3},
/// (1 − τ)^{1/3} (flow round a corner of 270°) and 1 (the velocity of the wall), each times a power series. Three
/// families of Gegenbauer functions, λ = 1/6, 1/2 and 5/6, hold them:
///   v_{λp}(τ) ∝ (1 − τ²)^{λ−½} C^{(λ)}_{2p}(τ),   ∫₀¹ v_{λp} cos xτ dτ = x^{−λ} J_{λ+2p}(x)      (C5)
/// Not installed.
#include <array>
#include <complex>
#include <span>

namespace hydro::cylinders {

class GapBasis {
 public:
  explicit GapBasis(int per_family) : per_family_(per_family) {}

  int size() const { return static_cast<int>(families.size()) * per_family_; }
  /// ∫₀¹ v_p cos xτ dτ for all p, x > 0.
  void cosine(double x, std::span<double> out) const;
  /// e^{−x} ∫₀¹ v_p cosh xτ dτ for all p, x > 0.
  void cosh_scaled(double x, std::span<double> out) const;
  double mean(int p) const;           ///< ∫₀¹ v_p dτ
  double second_moment(int p) const;  ///< ∫₀¹ v_p τ² dτ
  /// α_p(x) of the cosine transform for large x: Re α_p(x) e^{ix}.
  std::complex<double> cosine_amplitude(int p, double x) const;
  double decay(int p) const { return lambda(p) + 0.5; }  ///< the transform falls as x^{−decay}
  double highest_order() const { return 2.0 * per_family_; }

 private:
  static constexpr std::array<double, 3> families{1.0 / 6, 1.0 / 2, 5.0 / 6};
  double lambda(int p) const { return families[static_cast<std::size_t>(p / per_family_)]; }
  int degree(int p) const { return p % per_family_; }
  template <class Sequence, class Sign>
  void transform(double x, std::span<double> out, Sequence sequence, Sign sign) const;

  int per_family_;
};

}  // namespace hydro::cylinders
