#pragma once
/// \file  Parameters of a motion from its record, by following the motion itself; (F36)-(F38), docs/theory/fit.md.
///
/// Each record is a window with an initial state of its own, parameters are common to all windows: one window for a
/// short record, many for a long or a chaotic one (multiple shooting without the seams, which costs only what the seams
/// would tell).
#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/least_squares.hpp"

namespace fit {

/// One window, sampled evenly.
struct Window {
  double step;             ///< s
  Eigen::MatrixXd values;  ///< shape (n, channels of the model): what was measured of the state
};

enum class MotionLaw {
  oscillator,             ///< ẍ + b₁ẋ + b₂|ẋ|ẋ + b₃ẋ³ + c sgn ẋ + ω₀²(x − x₀) = 0
  pendulum,               ///< the same with ω₀² sin(x − x₀)
  fall,                   ///< ḧ = −g − k|ḣ|ḣ: a ball in still air
  double_pendulum,        ///< two hinged links, angles from the upright, friction in both hinges
  with_radiation_memory,  ///< ẍ + b₁ẋ + b₂|ẋ|ẋ + b₃ẋ³ + ∫k(t − τ)ẋ(τ)dτ + ω₀²(x − x₀) = 0, k of one pair of poles (F59)
};
/// Names of the parameters of a law, in the order of `ShootingProblem::start`: oscillator and pendulum "omega0",
/// "linear", "quadratic", "cubic", "coulomb", "offset"; fall "drag", "gravity"; double pendulum "coupling", "inertia",
/// "gravity1", "gravity2", "friction1", "friction2", all over the first inertia M₁₁ (F38); with_radiation_memory
/// "omega0", "linear", "quadratic", "cubic", "offset", "memory_strength" κ (1/s²), "memory_decay" α (1/s),
/// "memory_frequency" ω_p (rad/s).
std::vector<std::string> parameters_of(MotionLaw law);
/// Which states are measured, in the order of the channels: "x", "h", or "theta1" and "theta2".
std::vector<std::string> channels_of(MotionLaw law);

struct ShootingProblem {
  MotionLaw law;
  std::vector<Window> windows;
  std::vector<double> deviations;  ///< of the noise, per channel, or any common scale: weighs channels
  std::vector<double> start;       ///< of all parameters; those not fitted keep it
  std::vector<bool> fitted;        ///< which are fitted; none: initial states alone are
  int substeps = 4;                ///< Runge–Kutta steps per sample
  double confidence = 0.95;
  std::vector<double> lowest = {};  ///< bounds of the parameters; empty: none
  /// Whether states that are not measured (a memory) are fitted at each window's start; else they begin at zero.
  bool hidden_states_fitted = true;
};

struct ShootingFit {
  std::vector<Coefficient> parameters;  ///< of all, in the law's order; those not fitted have standard error 0
  std::vector<double> ended;            ///< where the search left them all, told or not
  SearchReport search;
  std::vector<Eigen::VectorXd> initial;  ///< initial state of each window, hidden ones where they are fitted
  std::vector<Eigen::MatrixXd> motion;   ///< of each window, as its values
  std::vector<double> rms;               ///< per channel, over all windows
  std::vector<double> explained;         ///< share of the variance about each window's mean, per channel
  /// Half widths of the bands at each sample, as `motion` (F46): of the fitted motion, and of a sample measured anew.
  /// Empty where not all is identifiable.
  std::vector<Eigen::MatrixXd> fit_band, sample_band;
  double inside = 0;            ///< share of the samples within sample_band
  double integration_error;     ///< largest change of a sample if steps are halved, in deviations
  double dof;                   ///< of Student's t behind the intervals
  std::string caution;          ///< why they may not hold; empty where nothing is known against them
  Eigen::MatrixXd correlation;  ///< of the fitted parameters
};

/// Fits parameters and initial states together (Ceres, derivatives through the integrator). Initial states start from
/// local polynomials of the first samples. Intervals count the memory of residuals within the windows (F4).
/// A parameter known no better than to its own size and to `tell` is not marked: that is the caller's judgement.
/// \throws hydro::InputError: shapes that do not fit, a window of fewer than 8 samples, values that are not
/// finite; hydro::NumericsError if the motion runs away from every start, and SearchFailed (verdict.hpp) if the search
/// has no end
ShootingFit fit_motion(const ShootingProblem& problem);

/// The motion of given parameters and initial state, shape (n, channels). \throws as above
Eigen::MatrixXd follow(MotionLaw law, std::span<const double> parameters, const Eigen::VectorXd& initial, double step,
                       Eigen::Index samples, int substeps = 4);

/// Interval of one parameter from the likelihood itself: the parameter is held at trial values, everything else is
/// fitted again, and the ends are where the cost has risen by half the square of the quantile, over the inflation that
/// correlated residuals ask for (F37). Unlike `parameters[j].interval` it need not be symmetric.
/// \throws hydro::NumericsError if an end is not found within 30 standard errors, or a search for it has none
Interval profile_interval(const ShootingProblem& problem, const ShootingFit& fit, std::size_t parameter);

}  // namespace fit
