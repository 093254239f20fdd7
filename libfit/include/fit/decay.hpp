#pragma once
/// \file  Damping from a free decay: what extremes tell, and the fit of the whole motion; (F34)-(F37),
///        docs/theory/fit.md.
///
///   ẍ + b₁ẋ + b₂|ẋ|ẋ + b₃ẋ³ + c sgn ẋ + ω₀²(x − x₀) = 0, or ω₀² sin(x − x₀) for a pendulum.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/shooting.hpp"

namespace fit {

struct Extreme {
  double time;   ///< s, vertex of the parabola through the largest sample and its neighbours
  double value;  ///< of that vertex
};
/// The extremes between crossings of the mean; swings below `least` of the largest are left out as noise.
/// \throws hydro::InputError for fewer than 16 samples, uneven lengths, or fewer than two extremes
std::vector<Extreme> find_extremes(std::span<const double> time, std::span<const double> values, double least = 0.03);

/// Which damping acts.
struct DampingTerms {
  bool linear = true, quadratic = false, cubic = false, coulomb = false;
  int count() const { return linear + quadratic + cubic + coulomb; }
};

/// Logarithmic decrement of each half cycle, and the damping ratio of all.
struct Decrement {
  std::vector<double> amplitude;  ///< mean of the two extremes
  std::vector<double> ratio;      ///< ζ = δ/√(π² + δ²), δ = ln(a_n/a_{n+1})
  double offset;                  ///< of the rest position, from extremes on both sides
  double period;                  ///< s, damped, mean
};
Decrement logarithmic_decrement(std::span<const Extreme> extremes);  ///< \throws hydro::InputError for fewer than three

/// Energy lost per half cycle against amplitude (Froude 1874), by least squares; (F35).
struct EnergyFit {
  std::vector<Coefficient> damping;  ///< "linear" 1/s, "quadratic" 1/[x], "cubic" s/[x]², "coulomb" [x]/s²
  double omega;                      ///< rad/s, from the damped period
  double residual_rms;               ///< of the decrements
};
/// \throws hydro::InputError for no more decrements than terms
EnergyFit fit_energy(std::span<const Extreme> extremes, const DampingTerms& terms, double confidence = 0.95);

struct DecayOptions {
  DampingTerms terms = {.linear = true, .quadratic = true};
  bool pendulum = false;   ///< sine in place of x; x in rad
  bool fit_offset = true;  ///< the rest position
  double confidence = 0.95;
  int substeps = 4;
};
struct DecayFit {
  ShootingProblem problem;           ///< as it was solved, for profile_interval()
  ShootingFit motion;                ///< parameters "omega0", "linear", "quadratic", "cubic", "coulomb", "offset"
  std::vector<Coefficient> damping;  ///< those of the terms asked for
  Coefficient period;                ///< 2π/ω₀, s
  EnergyFit energy;                  ///< where the search began
  /// The motion comes to rest, and several numbers of half cycles before that fit it: intervals hold those of all
  /// (F114).
  bool several_ends = false;
  double samples;
  /// Independent samples of the records: those of the fit with linear, quadratic and cubic damping, whatever terms were
  /// asked for, so that fits of the same records with different terms are compared by the same number (F33).
  double independent;
  double aicc, bic;  ///< to compare terms on the same records; ∞ where that fit has no end
};
/// Fits the whole motion of one decay or of several with the same damping, from the values that energy gives. A damping
/// term of which the interval holds zero is reported as not identifiable, with its interval.
/// \throws hydro::InputError as its parts
DecayFit fit_decay(std::span<const Window> records, const DecayOptions& options = {});

}  // namespace fit
