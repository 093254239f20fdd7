#pragma once
/// \file  Interpolation of functions without high frequencies from even samples, by a Kaiser–Bessel window (W94).
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "synth_simd.hpp"

namespace hydro::waves {

/// ψ(x) = I₀(β√(1 − (2x/w)²))/I₀(β) for |x| <= w/2, x in steps of the grid. Samples of e^{iθn}, divided by
/// transform(θ), weighted by ψ and summed give e^{iθx} for |θ| <= π/σ; the error is error(θ).
class Window {
 public:
  static constexpr std::size_t largest_width = 20, stride = 24;

  /// `width` points (even, 4 … 20), on samples `oversampling` σ > 1 times as dense as the highest frequency needs.
  Window(std::size_t width, double oversampling);
  /// The narrowest window whose error, and that of its derivatives in units of the grid, stays below `tolerance`.
  /// \throws InputError if even the widest does not reach it
  static Window of_tolerance(double tolerance, double oversampling);

  std::size_t width() const noexcept { return width_; }
  double beta() const noexcept { return beta_; }
  double oversampling() const noexcept { return oversampling_; }

  /// ψ̂(θ) = ∫ψ(x) e^{−iθx} dx, θ in rad per step.
  double transform(double theta) const;

  /// 1/transform(n·step), n = 0 … out.size() − 1, relative error 1e-14; wide windows only, whose sinh is an
  /// exponential.
  void inverse_transforms(double step, std::span<double> out) const;

  /// Index of the first of the `width` samples used for a point at `position`, in steps.
  std::ptrdiff_t first(double position) const;

  /// ψ and its first two derivatives at the samples from first(position) on, by what `per_unit` steps are one of; zero
  /// up to whole packs.
  using Weights = std::array<std::array<double, stride>, 3>;
  void weights(double position, double per_unit, Weights& out) const;
  /// ψ alone, `stride` values.
  void weights(double position, double* out) const;

  /// Largest error of e^{iθx} and of its derivatives d/dx, d²/dx², measured at 64 points between two samples, rounding
  /// included.
  double error(double theta, std::size_t orders = 3) const;

 private:
  static constexpr std::size_t degree = 19;
  std::size_t width_;
  double oversampling_, beta_, peak_;
  std::vector<double> polynomial_;  // (degree + 1, stride): piece i in powers of y = 2f − 1, highest power first
};

}  // namespace hydro::waves
