#pragma once
/// \file  Cycles of a forced motion, and those of full amplitude among them; (F23), docs/theory/fit.md.
#include <cstddef>
#include <span>
#include <vector>

namespace fit {

struct Cycle {
  double start, end;  ///< in samples, between two: up-crossings of the mean by linear interpolation
  double amplitude;   ///< half of highest minus lowest sample
};
/// Cycles from up-crossing to up-crossing of the record's mean. A crossing counts once the motion has been below −10 %
/// of the largest amplitude since the last one: noise about zero makes no cycles. \throws hydro::InputError for fewer
/// than 16 samples or a constant record
std::vector<Cycle> find_cycles(std::span<const double> motion);

/// The longest run of cycles in a row whose amplitude is within `tolerance` of that of the largest-amplitude half of
/// all cycles (their median), and whose length is as near to the median length. Start-up and run-down fall out. \throws
/// hydro::InputError unless 0 < tolerance < 1, or there is no such cycle
std::vector<Cycle> full_amplitude(std::span<const Cycle> cycles, double tolerance);

}  // namespace fit
