#pragma once
/// \file  A fitted coefficient as it is reported: with an interval, or with the reason why there is no number.
#include <optional>
#include <string>

namespace fit {

struct Interval {
  double low, high;
};

struct Coefficient {
  std::string name;
  std::optional<double> value;  ///< empty: the data do not tell; see `why_not`
  double standard_error = 0;
  double systematic_error = 0;   ///< standard error from what is the same throughout: calibration, geometry, delay
  Interval interval{};           ///< at the level asked for; it is given for an empty value too, as wide as it is
  Interval white_interval{};     ///< as if residuals were independent; for comparison only
  double effective_samples = 0;  ///< independent samples that would tell as much
  double shift_per_degree = 0;   ///< change of the value if the force came 1° of the main period too late
  std::string why_not;           ///< why there is no value
};

}  // namespace fit
