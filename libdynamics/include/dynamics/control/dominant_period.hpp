#pragma once
/// \file  Switching by the period of a signal (Fagerbakke 2023, sections 4.2 and 6.8).
#include <optional>
#include <vector>

#include "hydro/base/state_bytes.hpp"

namespace dynamics {

/// A setting from some period on.
struct PeriodSetting {
  double from;   ///< s; the first is 0
  double value;  ///< in the unit of what is ruled
};

struct PeriodSwitching {
  double every;                         ///< s, from one check to the next
  double window;                        ///< s, of the signal that a check looks at: at least two periods
  double hysteresis;                    ///< Hz, by which two checks in turn may differ to be taken as steady
  double dwell = 0;                     ///< s, least time between switches
  std::vector<PeriodSetting> settings;  ///< from short to long
};

/// The frequency with the largest amplitude in evenly sampled values, Hz (D64): peak of the spectrum of the record
/// under a Hann window, between its bins by a parabola through the logarithms; to some 1 % of a bin for one
/// oscillation. 0 where nothing moves.
double dominant_frequency(const std::vector<double>& values, double step_s);

/// Checks every so often what period dominates a signal, from when the window is full, and takes its setting once two
/// checks in turn agree. It keeps what it has seen: one controller belongs to one run.
class DominantPeriodController {
 public:
  /// \throws hydro::InputError for times that are not positive, a window that holds no two checks' worth of samples,
  /// settings that do not begin at 0 or do not ascend
  explicit DominantPeriodController(PeriodSwitching law);
  /// Called once at the end of each full step, in order, with the time and what is watched, the surge of a module or
  /// the elevation of the waves. \returns the new setting, or nothing to leave it
  std::optional<double> sample(double time_s, double value);
  /// What it has seen and set, into bytes or out of them.
  void keep_state(hydro::StateBytes& bytes) {
    bytes.pass(time_, value_, next_check_, last_switch_, last_frequency_, setting_);
  }

 private:
  double frequency() const;

  PeriodSwitching law_;
  std::vector<double> time_, value_;
  double next_check_, last_switch_ = -1e300;
  std::optional<double> last_frequency_;
  std::optional<std::size_t> setting_;
};

}  // namespace dynamics
