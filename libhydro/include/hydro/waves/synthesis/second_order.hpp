#pragma once
/// \file  What a sea has to second order beside its free waves: harmonics bound to pairs of them, at the sums and the
///        differences of their frequencies. Equations (W63)-(W69), docs/theory/waves-nonlinear.md.
///
/// Any depth, any directions; a uniform current is allowed, a sheared one is not. Second order is a correction: it is
/// right as long as it is small, and short waves on long ones break that first (cut the sea off at a few times its
/// peak).
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hydro/signal/fft.hpp"
#include "hydro/waves/kinematics/field.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/synthesis/synthesis.hpp"

namespace hydro::waves {

/// A free wave as the kernels take it: wave vector, σ of (W1), and g and h of the water. A negative σ with the wave
/// vector turned round is the conjugate wave, so that one kernel serves sums and differences (W64).
struct FreeWave {
  double sigma, kx, ky;
};

/// Response to two waves of elevation amplitudes E₁, E₂ (complex), σ = σ₁ + σ₂, k = k₁ + k₂ (W65):
///   E = elevation · E₁E₂ (1/m),   Φ = i · potential · E₁E₂ (1/s);   a wave with itself has half of both.
struct PairKernel {
  double elevation, potential;
};

/// Kernel of a sum; for a difference give the second wave negated. A wave with itself negated gives the limit of a long
/// group along its heading (W66): the set-down, with `potential` zero, since what has no wave vector has no flow.
/// Finite for all pairs. Relative rounding error about 1e-16 κ₁/|k| for nearly equal waves.
/// \throws InputError unless both σ are finite and not zero
PairKernel pair_kernel(const FreeWave& one, const FreeWave& two, const Water& water);

/// Sharma and Dean's (1981) kernels for real waves of frequency σ going towards θ.
PairKernel sum_kernel(const FreeWave& one, const FreeWave& two, const Water& water);
PairKernel difference_kernel(const FreeWave& one, const FreeWave& two, const Water& water);

struct BoundParts {
  bool sums = true;
  bool differences = true;
};

struct BoundOptions {
  BoundParts parts = {};
  /// Share of the bound waves' own variance that may be left out, the weakest pairs first; 0 keeps all. Most of the
  /// N² pairs are very weak.
  double energy_left_out = 0;
};

/// The bound waves of a sea, to append to harmonics(sea). The mean level stays zero: a wave's difference with itself, a
/// level that only the tank's walls could tell, is left out (W67).
/// \throws InputError for a sheared current, and unless 0 <= energy_left_out < 1
struct BoundWaves {
  std::vector<Harmonic> harmonics;
  std::size_t pairs;       ///< before any was left out
  double variance;         ///< Σ|E|²/2 of all pairs as if their phases were independent, m²
  double energy_left_out;  ///< share of it that is not in `harmonics`
};
BoundWaves bound_harmonics(const Sea& sea, const BoundOptions& options = {});

/// K of (W67), m²/s²: what keeps the mean level of the surface at zero; for PressureLaw::full.
double second_order_bernoulli(const Sea& sea);

/// Skewness E[ζ³]/E[ζ²]^{3/2} of a long record of the sea to second order, from the kernels (W68).
double second_order_skewness(const Sea& sea);

/// Free and bound waves with PressureLaw::full.
HarmonicField second_order_field(const Sea& sea, const BoundOptions& bound = {}, HarmonicField::Options options = {});

/// Second-order part at one fixed place of a sea that stands on a frequency grid: all pairs are summed into bins of
/// that grid, and each series is one inverse FFT (W69). Cost O(N²) for the bins, without a list of pairs.
struct BoundAtPoint {
  double repetition_s;
  std::vector<std::complex<double>> elevation;  ///< amplitude of bin j, ω = 2πj/T_r, j = 0 … 2 j_max; m
  std::vector<std::complex<double>> u, v, w;    ///< of the velocity, m/s

  /// Series of one of them at t = 0, dt, …; dt must divide the repetition. Shape (samples).
  /// \throws InputError if it does not, or if a bin lies at or above the Nyquist frequency
  std::vector<double> series(std::span<const std::complex<double>> bins, const TimeGrid& grid) const;
};
/// `point`: x, y, z in m, −h <= z <= 0. \throws InputError as bound_harmonics(), and if the sea does not repeat
BoundAtPoint bound_at_point(const Sea& sea, const Eigen::Vector3d& point, const BoundParts& parts = {});

}  // namespace hydro::waves
