#pragma once
/// \file  Static and dynamic friction from a torque that grows until the joint slips; (F52), docs/theory/fit.md.
#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"

namespace fit {

struct FrictionRampOptions {
  double ramp_s;      ///< before the slip: the torque there is taken as a straight line
  double slide_s;     ///< after it: the torque there is taken as constant
  double drop_s = 0;  ///< that the drop may take, filters counted: its samples belong to neither
  double confidence = 0.95;
};

/// One test. Torques have the sign of the record's.
struct FrictionRamp {
  Coefficient static_level;   ///< N m (or N): the line where the joint slips; named "static"
  Coefficient dynamic_level;  ///< N m: the mean while it slides; named "dynamic"
  Coefficient drop;           ///< N m, of the absolute value; named "drop"
  double slip_s;              ///< when it slipped, s; known to half of drop_s and one sample
  double rate;                ///< of the torque before, N m/s
  double slide_rate;          ///< of the torque after, N m/s
  double residual_rms;        ///< N m, of what both pieces leave over
  std::string caution;        ///< why a level may not hold; empty where nothing is known against them
  std::vector<double> line_time, line, slide_time, slide;  ///< both pieces as fitted, for a picture
};

/// Finds the slip where the drop from the line before it to the mean after it is largest against what both leave over,
/// of all instants before which the torque grew by a tenth of its level at least, and fits both pieces by least squares
/// with intervals for correlated residuals (F4). The instant is not known better than the drop takes; what the torque
/// grows in that time is in the interval of the static level. \throws hydro::InputError: uneven time, lengths that
/// differ, a value that is not finite, pieces of fewer than 16 samples, a record shorter than both, or a drop that its
/// own interval does not tell from none: the joint has not slipped, or both levels are one
FrictionRamp fit_friction_ramp(std::span<const double> time_s, std::span<const double> torque,
                               const FrictionRampOptions& options);

}  // namespace fit
