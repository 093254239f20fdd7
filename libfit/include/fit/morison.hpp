#pragma once
/// \file  Drag and inertia coefficients of a cylinder from force and motion; (F7)-(F11), docs/theory/fit.md.
///
/// Two experiments, two conventions. Water that moves past a fixed body pushes with its own pressure gradient too:
///   F = C_M ρV u̇ + ½ρ D L C_D |u| u                          (F7)  C_M is fitted
/// A body moved through still water feels no such thing, but its load cells carry its mass:
///   F = −(C_A ρV + m) a − ½ρ D L C_D |v| v                    (F8)  C_A is fitted
/// with V = πD²L/4. C_M = 1 + C_A is a conversion, not a measurement. F is the force of water on the body (F7), or
/// what the load cells carry (F8); positive along positive velocity.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/least_squares.hpp"

namespace fit {

enum class Experiment { water_moves, body_moves };

struct Cylinder {
  double diameter;                  ///< D, m
  double length;                    ///< L, m
  double density;                   ///< ρ of the water, kg/m³
  std::optional<double> viscosity;  ///< ν, m²/s, for the Reynolds number only
  Experiment experiment;
  double mass_beyond_load_cells =
      0;                  ///< m, kg, of all that the load cells carry, contained water included; body_moves only
  double volume() const;  ///< πD²L/4
};

/// Evenly sampled, of one length. Velocity and acceleration are the water's (water_moves) or the body's (body_moves).
struct ForceRecord {
  std::vector<double> time;          ///< s
  std::vector<double> force;         ///< N
  std::vector<double> velocity;      ///< m/s
  std::vector<double> acceleration;  ///< m/s²
  /// |u|u, m²/s², where a filter has been run over the force: the same filter over |u|u, so that nothing is biased;
  /// (F25). Empty: from the velocity.
  std::vector<double> drag_flow = {};
};

/// The force of (F7) or (F8), N; `inertia` is C_M or C_A, after the experiment.
double morison_force(const Cylinder& cylinder, double cd, double inertia, double velocity, double acceleration);

/// What one standard deviation of something that is the same throughout the run does to the force.
struct ForceError {
  std::string source;         ///< "slope of F1"
  std::vector<double> force;  ///< N, at the samples of the record
};

/// Standard uncertainties of what the cylinder is taken for.
struct CylinderErrors {
  double diameter = 0, length = 0;  ///< m
  double density = 0;               ///< kg/m³
  double mass = 0;                  ///< kg, beyond the load cells
};

/// Where the intervals come from.
enum class IntervalMethod {
  effective_samples,  ///< autoregression of the residuals, (F4)
  cycle_clusters,     ///< sums over single periods, (F27)
  block_bootstrap     ///< residuals drawn anew in blocks, (F28)
};

struct MorisonOptions {
  double confidence = 0.95;
  IntervalMethod method = IntervalMethod::effective_samples;
  bool force_offset = false;  ///< fit a constant force as well: an offset of the load cells
  bool robust = false;        ///< Huber's estimate (F39): wild samples of the force pull less
  CylinderErrors cylinder_errors = {};
  std::vector<ForceError> force_errors = {};
  double delay_error_s = 0;  ///< standard uncertainty of the delay that was taken off the force
};

/// Share of one source in the uncertainty that does not average out; (F26).
struct SystematicError {
  std::string source;
  double cd, inertia;  ///< change of the coefficients for one standard deviation
};

struct MorisonFit {
  Coefficient cd;
  Coefficient inertia;           ///< named "cm" (water_moves) or "ca" (body_moves)
  std::optional<double> offset;  ///< N, if asked for
  FitReport search;
  double residual_rms;        ///< N
  double explained;           ///< 1 − residual variance / variance of the force
  double period;              ///< main period 2π √(Σwu²/Σwu̇²), s: of a sinusoid its period (w: Hann)
  double velocity_amplitude;  ///< √2 times the rms velocity, m/s: of a sinusoid its amplitude (w: Hann)
  double kc;                  ///< Keulegan–Carpenter number, velocity_amplitude · period / D
  std::optional<double> re;   ///< Reynolds number velocity_amplitude · D/ν
  double confidence;
  double dof;                           ///< of Student's t behind the intervals
  double correlation = 0;               ///< of the errors of the two coefficients, −1 … 1; 0 where not known
  std::vector<SystematicError> budget;  ///< empty where no such uncertainty was stated
  double share_inside = 1;              ///< of samples that a robust fit counts in full
  std::optional<Coefficient> delay;     ///< s, of the force behind the motion, where it was estimated
  std::string caution;  ///< why the intervals may be too narrow; empty where nothing is known against them
  std::size_t samples;
  std::vector<double> fitted;  ///< N, at the samples given
};

/// Fits C_D and C_M or C_A by least squares, with intervals that are honest about correlated residuals (F4).
///
/// A coefficient is reported without a value where the record cannot tell it to ±1: where half the interval exceeds 1,
/// or where a force 1° of the main period too late would shift it by more than 1 (F11). Drag at small KC is such a
/// case. \throws hydro::InputError: lengths differ, fewer than 32 samples, uneven time, less than one main period, no
/// motion, a value that is not finite, dimensions or density not positive, a mass with water_moves
MorisonFit fit_morison(const Cylinder& cylinder, const ForceRecord& record, const MorisonOptions& options = {});

/// As fit_morison(), with the delay of the force behind the motion as a third unknown (F24): its uncertainty is then in
/// those of the coefficients. Delays up to ±`longest_s` are searched; keep it below half the main period, since a force
/// half a period late is the force with its sign turned.
struct DelayedFit {
  MorisonFit fit;       ///< `fit.delay` is given
  ForceRecord aligned;  ///< the record with the delay taken off; longest_s is given up at both ends
};
/// \throws hydro::InputError as fit_morison(), and for a record not longer than twice the longest delay and one period
DelayedFit fit_morison_and_delay(const Cylinder& cylinder, const ForceRecord& record, double longest_s,
                                 const MorisonOptions& options = {});

/// The inertia coefficient of a fit in either convention, "cm" or "ca": C_M = 1 + C_A shifts value and intervals alike.
/// \throws hydro::InputError for another name
Coefficient inertia_as(const MorisonFit& fit, const std::string& name);

}  // namespace fit
