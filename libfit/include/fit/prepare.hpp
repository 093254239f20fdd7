#pragma once
/// \file  From raw channels to a record that can be fitted, in steps that are named and kept; (F23)-(F26),
///        docs/theory/fit.md.
///
/// Order of the steps: even grid, outliers, levels, another rate, calibration and zero, delay, water, derivatives,
/// trend, filters, band-pass, window, mean cycle. What acts on the force from the trend on acts on both columns of the
/// model alike, so it takes noise and drift out and biases nothing.
#include <optional>
#include <string>
#include <vector>

#include "fit/band_pass.hpp"
#include "fit/calibration.hpp"
#include "fit/differentiate.hpp"
#include "fit/filter.hpp"
#include "fit/morison.hpp"
#include "fit/wave_motion.hpp"

namespace fit {

struct ForceChannel {
  std::string name;
  std::vector<double> values;              ///< N; V where a calibration is given
  std::optional<Calibration> calibration;  ///< its slope, with error and hysteresis, turns volts into newtons
  std::vector<double> zero_run = {};       ///< of the same unit, at rest: its mean is taken off. Empty: nothing is,
                                           ///< but for the offset of the calibration
};

/// One run as it was recorded; all columns of one length, those not measured empty.
struct RawRun {
  std::vector<double> time;         ///< s
  std::vector<ForceChannel> force;  ///< they carry the body together: their sum is the force
  std::vector<double> position;     ///< m
  std::string position_name = "position";
  std::vector<double> velocity;      ///< m/s, in place of a position
  std::vector<double> acceleration;  ///< m/s²; empty: from velocity or position
  /// Velocity of the water across both the force and the body's axis, m/s: a horizontal cylinder in waves feels
  /// √(u² + w²) u. Empty: none.
  std::vector<double> cross_velocity = {};
  /// Of the surface at a probe, m, in place of position and velocity: the water's motion at the body follows (F40).
  std::vector<double> elevation = {};
  std::optional<ProbeToBody> probe = {};  ///< with an elevation
  /// Of a body that moves in moving water: the columns above are the body's, but for cross_velocity, and the water's
  /// are these or an elevation (F49). Acceleration empty: from the velocity.
  std::vector<double> water_velocity = {}, water_acceleration = {};
};

struct FilterChoice {
  enum class Kind { butterworth, chebyshev, gaussian, finite, notch, moving_average } kind;
  int order = 4;       ///< Butterworth, Chebyshev
  double ripple = 0;   ///< Chebyshev
  double hz = 0;       ///< cutoff or centre
  double width = 0;    ///< notch: Hz
  double seconds = 0;  ///< moving average
};

/// \throws hydro::InputError as the filter
ZeroPhaseFilter filter_of(const FilterChoice& choice, double step_s);

struct WindowChoice {
  enum class Kind { all, span, full_cycles } kind = Kind::all;
  double from = 0, to = 0;  ///< span: s
  int cycles = 0;           ///< the last so many of full amplitude; 0: all of them
  double tolerance = 0.03;  ///< of a full amplitude and of a period
};

struct PrepareOptions {
  double longest_gap_s = 0;     ///< rows that may be missing at a stretch are bridged; 0: none may
  double outlier_window_s = 0;  ///< neighbours asked, half before and half after; 0: outliers are not looked for
  double outlier_deviations = 8;
  /// Columns that know few levels become the curve through them (F111).
  bool through_levels = false;
  double resample_hz = 0;              ///< all channels are brought to this rate (F48); 0: left as they are
  double delay_s = 0;                  ///< of the force behind the motion, taken off
  double derivative_bandwidth_hz = 0;  ///< 0: five times the main frequency
  Derivative derivative = Derivative::local_polynomial;
  /// The slope of the line of least squares through a window that is a span, else through all of the record, is taken
  /// off, about its middle: the mean stays (F108).
  bool detrend = false;
  std::vector<FilterChoice> filters = {};
  std::optional<BandEdges> band_pass = {};  ///< after the filters (F108)
  /// Of records that hold a surface: a band about the frequency of its waves (F50), in place of `band_pass`.
  bool band_about_waves = false;
  bool linear_drag = false;  ///< will be fitted: filters run over the velocity, too
  WindowChoice window = {};
  /// The window's cycles are laid over each other (F47): motion and columns of the model become their mean cycle, end
  /// to end, and forces stay each cycle's own. Least squares then fits the mean force, and what cycles differ by tells
  /// how well it is known. Needs full_cycles.
  bool average_cycles = false;
};

/// The force over one mean cycle.
struct MeanForce {
  std::vector<double> time;                   ///< s, from the beginning of the cycle
  std::vector<double> force, standard_error;  ///< N
  std::size_t cycles;
};

struct Prepared {
  ForceRecord record;
  std::vector<ForceError> force_errors;  ///< of calibration, hysteresis and zero
  std::vector<std::string> steps;        ///< what was done, in order
  std::vector<std::string> cautions;     ///< what is wrong with the sensors
  std::vector<double> cycle_starts;      ///< s; of the window where it was cut into cycles, with the end of the last
  std::optional<MeanForce> mean_force = {};  ///< where cycles were averaged
};

/// \throws hydro::InputError: lengths differ, a column is constant, two force channels that work against each other,
/// time with gaps longer than allowed, a window outside the record, a mean cycle of cycles that differ by more than a
/// tenth or without a window of full cycles, and as the steps themselves
Prepared prepare(RawRun run, const PrepareOptions& options);

/// A motion alone, of a body let go.
struct PreparedMotion {
  double step;  ///< s
  std::vector<double> time, values;
  std::vector<std::string> steps, cautions;  ///< as Prepared
};
/// Even grid, sensors looked at, outliers, and a window: a span or all. Nothing is filtered or straightened, since what
/// is fitted to the motion is not linear in it. `name`: of the channel, for what is told. \throws hydro::InputError as
/// prepare(), and for other options
PreparedMotion prepare_motion(const std::string& name, std::vector<double> time_s, std::vector<double> values,
                              const PrepareOptions& options);

/// A record of a carriage that tows a body, as it was recorded.
struct RawTow {
  std::vector<double> time;         ///< s
  std::vector<double> speed;        ///< of the carriage, m/s
  std::vector<ForceChannel> force;  ///< as RawRun; positive where the water resists a positive speed
};

struct PreparedTow {
  double step;                               ///< s
  std::vector<double> time, speed, force;    ///< the force in N, filtered; the speed as it was measured
  std::vector<ForceChannel> channels;        ///< of that force, N, zero taken off
  std::vector<double> zero_errors;           ///< N; standard error of the zero of each channel, 0 where none is known
  double filter_reach_s;                     ///< what a filter gives at one time leans on samples so far away
  std::vector<std::string> steps, cautions;  ///< as Prepared
};
/// Even grid, sensors looked at, outliers, another rate, calibration and zero, filters over the force. The window is
/// left to who looks for the steady part. \throws hydro::InputError as prepare(), and for a delay, cycles, a trend or a
/// band-pass, which would take off what is sought
PreparedTow prepare_towing(RawTow run, const PrepareOptions& options);

}  // namespace fit
