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

/// `values` at `points` even phases of each cycle, by the cubic through four samples: error below 0.023 (ωΔt)⁴ of a
/// sinusoid inside the record. Shape (cycles · points), one cycle after the other. \throws hydro::InputError for fewer
/// than 4 samples, no cycle, fewer than 8 points, or a cycle that reaches beyond the record
std::vector<double> on_phases(std::span<const double> values, std::span<const Cycle> cycles, std::size_t points);

/// The mean of cycles laid over each other, and what they scatter by about it at each phase.
struct CycleMean {
  std::vector<double> mean, standard_error;  ///< shape (points); the error is that of the mean, s/√cycles
  double left;  ///< rms of what single cycles differ from the mean by, over the rms of the mean's deviation from its
                ///< own mean
};
/// Of what on_phases() gives; (F47). \throws hydro::InputError unless `laid` holds two whole cycles at least
CycleMean mean_cycle(std::span<const double> laid, std::size_t points);

}  // namespace fit
