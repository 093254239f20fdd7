#pragma once
/// \file  Drag and inertia coefficients of a cylinder from force and motion; (F7)-(F11), (F49)-(F51),
///        docs/theory/fit.md.
///
/// Three experiments, two conventions. Water that moves past a fixed body pushes with its own pressure gradient too:
///   F = C_M ρV u̇ + ½ρ D L C_D |u| u                          (F7)  C_M is fitted
/// A body moved through still water feels no such thing, but its load cells carry its mass:
///   F = −(C_A ρV + m) a − ½ρ D L C_D |v| v                    (F8)  C_A is fitted
/// A body that moves in moving water has both, and its load cells carry its mass:
///   F = ρV u̇ − m a + C_A ρV (u̇ − a) + ½ρ D L C_D |u − v|(u − v)  (F49)  C_A is fitted
/// with V = πD²L/4. C_M = 1 + C_A is a conversion, not a measurement. F is the force of water on the body (F7), or
/// what the load cells carry (F8), (F49); positive along positive velocity.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/least_squares.hpp"
#include "fit/robust.hpp"

namespace fit {

enum class Experiment { water_moves, body_moves, both_move };

struct Cylinder {
  double diameter;                  ///< D, m
  double length;                    ///< L, m
  double density;                   ///< ρ of the water, kg/m³
  std::optional<double> viscosity;  ///< ν, m²/s, for the Reynolds number only
  Experiment experiment;
  double mass_beyond_load_cells =
      0;                  ///< m, kg, of all that the load cells carry, contained water included; not of water_moves
  double volume() const;  ///< πD²L/4
};

/// One draw of what noise of the measured motion adds to the motion that was derived from it (F68); as in a
/// ForceRecord, after the same filters.
struct MotionError {
  std::vector<double> velocity, acceleration;
  std::vector<double> water_acceleration = {};           ///< both_move only
  std::vector<double> drag_flow = {}, linear_flow = {};  ///< to first order; empty as there
};

/// Evenly sampled, of one length. Velocity and acceleration are the water's (water_moves), the body's (body_moves), or
/// the water's less the body's (both_move).
struct ForceRecord {
  std::vector<double> time;          ///< s
  std::vector<double> force;         ///< N
  std::vector<double> velocity;      ///< m/s
  std::vector<double> acceleration;  ///< m/s²
  /// |u|u, m²/s², where a filter has been run over the force: the same filter over |u|u, so that nothing is biased;
  /// (F25). Empty: from the velocity.
  std::vector<double> drag_flow = {};
  std::vector<double> water_acceleration = {};  ///< u̇ itself, m/s²; both_move only
  std::vector<double> linear_flow = {};  ///< the same for a linear drag: the filter over the velocity, m/s. Empty: it
  /// Draws of the motion's noise: its bias is taken off the coefficients, and its scatter is in their intervals (F68).
  /// Empty: the motion is taken as exact.
  std::vector<MotionError> motion_errors = {};
  /// Draws of what the steps of the force's sensors may have done to the force, N (F69). Empty: they have none.
  std::vector<std::vector<double>> rounding = {};
};

/// The force of (F7), (F8) or (F49), N; `inertia` is C_M or C_A, after the experiment, velocity and acceleration are as
/// in a ForceRecord, `water_acceleration` counts for both_move only.
double morison_force(const Cylinder& cylinder, double cd, double inertia, double velocity, double acceleration,
                     double water_acceleration = 0);

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

/// A force of one frequency that the model does not know: lift, vortices, a vibration of the structure; (F50). One of
/// the two is given.
struct ForceLine {
  double hz = 0;        ///< its frequency
  double multiple = 0;  ///< of the main frequency of the motion
};

struct MorisonOptions {
  double confidence = 0.95;
  IntervalMethod method = IntervalMethod::effective_samples;
  bool force_offset = false;              ///< fit a constant force as well: an offset of the load cells
  bool linear_drag = false;               ///< fit a drag that goes with the velocity as well (F51)
  std::vector<ForceLine> lines = {};      ///< fitted as well
  bool bands = false;                     ///< tell the bands of the fit (F53)
  std::optional<RobustLoss> robust = {};  ///< wild samples of the force pull less (F39)
  CylinderErrors cylinder_errors = {};
  std::vector<ForceError> force_errors = {};
  double delay_error_s = 0;  ///< standard uncertainty of the delay that was taken off the force
  /// Standard errors of the slopes of the channels that velocity and acceleration are from, over the slopes (F105): of
  /// one channel for both where `one_motion`. Not where both move.
  double velocity_slope = 0, acceleration_slope = 0;
  bool one_motion = true;
};

/// Share of one source in the uncertainty that does not average out; (F26).
struct SystematicError {
  std::string source;
  double cd, inertia;  ///< change of the coefficients for one standard deviation
};

/// A line as it was fitted: Re A e^{iωt}, t as in the record.
struct FittedLine {
  double hz;
  Coefficient amplitude;  ///< |A|, N; without a value where the ellipse of its two parts holds zero
  double phase;           ///< of A, rad
};

struct MorisonFit {
  Coefficient cd;
  Coefficient inertia;                     ///< named "cm" (water_moves) or "ca" (body_moves, both_move)
  std::optional<Coefficient> offset;       ///< N, if asked for
  std::optional<Coefficient> linear_drag;  ///< B, N s/m, if asked for: a force −Bv on a body, Bu of water
  std::vector<FittedLine> lines;           ///< in the order asked for
  SearchReport search;
  double residual_rms;        ///< N
  double squared_error;       ///< sum of the squared residuals, SSE, N²
  double explained;           ///< R² = 1 − residual variance / variance of the force
  double explained_adjusted;  ///< 1 − (1 − R²)(n − 1)/(n − p), p coefficients fitted to n samples
  double period;              ///< main period 2π √(Σwu²/Σwu̇²), s: of a sinusoid its period (w: Hann)
  double velocity_amplitude;  ///< √2 times the rms velocity, m/s: of a sinusoid its amplitude (w: Hann)
  double kc;                  ///< Keulegan–Carpenter number, velocity_amplitude · period / D
  std::optional<double> re;   ///< Reynolds number velocity_amplitude · D/ν
  double confidence;
  double dof;                           ///< of Student's t behind the intervals
  double correlation = 0;               ///< of the errors of the two coefficients, −1 … 1; 0 where not known
  std::vector<SystematicError> budget;  ///< empty where no such uncertainty was stated
  double share_inside = 1;              ///< of samples, as RobustFit has it; 1 without
  std::optional<Coefficient> delay;     ///< s, of the force behind the motion, where it was estimated
  std::string caution;  ///< why the intervals may be too narrow; empty where nothing is known against them
  std::size_t samples;
  std::vector<double> fitted;  ///< N, at the samples given
  /// Half widths of the bands at each sample, N, where asked for and all is identifiable (F53): of the fitted force,
  /// and of a sample measured anew.
  std::vector<double> fit_band = {}, sample_band = {};
  double inside = 0;  ///< share of the samples within sample_band
};

/// Fits C_D and C_M or C_A by least squares, with intervals that are honest about correlated residuals (F4).
///
/// A coefficient is reported without a value where the record cannot tell it to ±1: where half the interval exceeds 1,
/// or where a force 1° of the main period too late would shift it by more than 1 (F11). Drag at small KC is such a
/// case. \throws hydro::InputError: lengths differ, fewer than 32 samples, uneven time, less than one main period, no
/// motion, a value that is not finite, dimensions or density not positive, a mass with water_moves, an acceleration of
/// the water without both_move or both_move without it, a line without one frequency between 0 and half the sampling
/// rate
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

/// Why the force (or the motion) must have the wrong sign; empty where it need not: drag or all inertia comes out
/// negative with its whole interval and the other is not positive with its own, which no flow does; (F26).
std::string sign_trouble(const Cylinder& cylinder, const MorisonFit& fit);

}  // namespace fit
