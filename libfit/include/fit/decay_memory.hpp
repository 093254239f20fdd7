#pragma once
/// \file  What a free decay tells of the water's memory: the pair of poles that its motion asks for, and added mass and
///        damping over frequency as far as they are known; (F59)-(F61), docs/theory/fit.md.
///
///   ẍ + b₁ẋ + b₂|ẋ|ẋ + b₃ẋ³ + ∫k(t − τ)ẋ(τ)dτ + ω₀²(x − x₀) = 0,   k̂(s) = κs/(s² + 2αs + ω_p²)
///
/// ω₀² = C/(M + A∞) with stiffness C, mass M and added mass at infinite frequency A∞. This is the least memory that
/// radiates nothing at zero and at infinite frequency.
#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

#include "fit/decay.hpp"
#include "fit/forced_radiation.hpp"

namespace fit {

struct DecayMemoryOptions {
  DampingTerms terms = {.linear = false};  ///< beside the memory; coulomb is refused
  /// The record begins where the body was let go from rest in calm water: an empty radiation memory. Else what that
  /// memory holds at the first sample is fitted as well.
  bool starts_empty = false;
  bool fit_offset = true;  ///< the rest position
  double confidence = 0.95;
  int substeps = 4;
};

struct DecayMemoryFit {
  ShootingProblem problem;  ///< as it was solved
  ShootingFit motion;       ///< parameters as MotionLaw::with_radiation_memory has them
  /// "memory_strength" κ (1/s²), "memory_decay" α (1/s), "memory_frequency" ω_p (rad/s); without values where the
  /// record does not tell them.
  std::vector<Coefficient> memory;
  std::vector<Coefficient> damping;  ///< terms beside the memory, as DecayFit::damping
  double omega;                      ///< rad/s, of the decaying swing: Im λ, λ the eigenvalue of the linear part
  double rate;                       ///< 1/s, −Re λ
  /// Of the fitted parameters over their values, what is known of each direction in units of its own error, largest
  /// first: below 2 a direction is not told. Empty where a direction is not seen at all. (F60)
  Eigen::VectorXd singular_values;
  std::string weakest;  ///< the combination of parameters that the record tells least, and how well
  /// AICc of the same terms and a linear damping without a memory, or with a quadratic one beside it if that is lower,
  /// less that with the memory.
  double gain;
};

/// Fits the memory to one decay or to several. Three searches begin with poles below, at and above the frequency of the
/// swing, which all give it the damping that it has; the least cost is kept. The memory is told where it lowers AICc by
/// two and its intervals do not hold zero. \throws hydro::InputError for Coulomb friction, and as fit_decay()
DecayMemoryFit fit_decay_memory(std::span<const Window> records, const DecayMemoryOptions& options = {});

/// A and B at one frequency.
struct DecayRadiation {
  double omega;
  Coefficient added_mass;  ///< A(ω), kg or kg m²
  Coefficient damping;     ///< B(ω), N s/m or N m s/rad, with the linear term
};
/// What the fitted memory makes of a body: A(ω) = C/ω₀²(1 + Im k̂(iω)/ω) − M, B(ω) = C/ω₀²(b₁ + Re k̂(iω)), with errors
/// by propagation (F61); ω = ∞ gives A∞ and what of B is in the linear term. They have values where the memory has; far
/// from the frequency of the swing they are an extrapolation, by two poles, with errors of scatter alone.
/// \throws hydro::InputError unless the body's mass >= 0, stiffness > 0, omega > 0
DecayRadiation radiation_of(const DecayMemoryFit& fit, const RestoredBody& body, double omega,
                            double confidence = 0.95);

}  // namespace fit
