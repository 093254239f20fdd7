#pragma once
/// \file  Added mass and radiation damping from decays and forced oscillations of small amplitude, and the poles of the
///        memory that belongs to them; (F54)-(F56), docs/theory/fit.md.
#include <span>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/decay.hpp"
#include "hydro/radiation/rational.hpp"

namespace fit {

/// What is known of a body that water and springs bring back: mass and stiffness, or inertia and turning stiffness, SI.
struct RestoredBody {
  double mass;            ///< M, kg or kg m²
  double stiffness;       ///< C, N/m or N m/rad
  double mass_error = 0;  ///< standard uncertainties, relative
  double stiffness_error = 0;
};

/// What the water adds to a body's mass in free motion, A = C/ω₀² − M, and the damping that belongs to it, each term
/// b_k of the decay times C/ω₀²; (F54). A is that at the frequency of the decay.
struct AddedMass {
  double omega;                      ///< ω₀, rad/s
  Coefficient added_mass;            ///< kg or kg m²; without a value where its interval holds zero
  std::vector<Coefficient> damping;  ///< of the terms that were fitted, each with its name
};
/// \throws hydro::InputError unless mass >= 0 and stiffness > 0, both finite, and errors are not negative, or for a
/// decay whose period is not known
AddedMass added_mass(const DecayFit& decay, const RestoredBody& body, double confidence = 0.95);

/// A and B at the frequency of one forced oscillation.
struct RadiationPoint {
  double omega;            ///< rad/s, of the motion
  double amplitude;        ///< of the motion, m or rad
  Coefficient added_mass;  ///< A, kg or kg m²
  Coefficient damping;     ///< B, N s/m or N m s/rad
  double second_harmonic;  ///< of the force, over its first: what is not linear
  double third_harmonic;
  double residual_rms;         ///< N or N m, of what is in none of the three harmonics
  std::string caution;         ///< why the intervals may not hold; empty where nothing is known against them
  std::vector<double> fitted;  ///< force at the samples given
};

/// Fits F = −(M + A)ẍ − Bẋ − Cx − F₀ to a steady forced oscillation: F is what the load cells carry, positive along
/// positive x, as in (F8). The motion's frequency is where its transform has its peak; its first harmonic and those of
/// the force up to the third are fitted by least squares, with errors of the force by (F4) and those of the motion by
/// propagation (F55). The record need not hold whole cycles, but must be steady.
/// \throws hydro::InputError: lengths that differ, uneven time, fewer than 64 samples or three cycles, values that are
/// not finite, no motion, a motion of which more than a tenth (rms) is not in its first harmonic, mass or stiffness
/// negative
RadiationPoint fit_radiation(std::span<const double> time_s, std::span<const double> motion,
                             std::span<const double> force, const RestoredBody& body, double confidence = 0.95);

/// The memory that belongs to the points: poles common to A and B (hydro::radiation::fit()), no closer to them than
/// they are known; (F56).
struct RadiationMemory {
  hydro::radiation::RationalFit poles;
  double tolerance;  ///< asked of the poles: twice the largest error from scatter of A and B among the points, relative
                     ///< to max B, as the largest of several errors is
  std::string refused;  ///< why the poles may not be told: they differ from the points by twice `tolerance` (F67)
  Coefficient limit;  ///< A∞ that belongs to them, "added_mass_limit"; without a value where points are known so badly
                      ///< that their redraws would have a damping below zero
};
/// The interval of A∞ is that of forty redraws of the points within their scatter, each fitted anew, and of one more
/// fit with all points moved by what is the same in them; it does not count what lies beyond the last point. \throws
/// hydro::InputError for fewer than five points, two of one frequency, or damping that is negative beyond its error; as
/// hydro::radiation::fit()
RadiationMemory fit_radiation_memory(std::span<const RadiationPoint> points, double confidence = 0.95);

}  // namespace fit
