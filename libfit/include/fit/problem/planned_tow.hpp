#pragma once
/// \file  How long a cylinder must be towed for its drag to be known so well; (F99), docs/theory/fit.md.
#include <cstdint>
#include <vector>

#include "fit/experiment.hpp"
#include "fit/morison.hpp"

namespace fit {

/// What tows are to be like, and what they are to tell.
struct PlannedTow {
  Cylinder cylinder;
  double speed = 0;         ///< m/s
  double acceleration = 1;  ///< of the carriage at both ends, m/s²
  double cd = 1.2;          ///< what is expected
  double noise = 0;         ///< standard deviation of the force's, N
  double memory = 0;        ///< of that noise: its autocorrelation is e^{−t/memory}, s; 0: white
  double step = 0.01;       ///< between samples, s
  double confidence = 0.95;
};
/// What tows of one length tell, over `seeds` made records, each fitted as a measurement is.
struct PlannedTime {
  int seconds;        ///< at one speed
  double half_width;  ///< median of the half width of the intervals of C_D; infinite where half of them have none
  double held;        ///< share of the intervals that hold what was put in
  double refused;     ///< share of the records that are refused: their force does not settle
  bool holds;         ///< `held` is no less than the level but for two deviations of chance: of a record that is short
                      ///< against the memory of its noise intervals come out too narrow
};
/// (F99). \throws hydro::InputError as towing::solve() for the cylinder, for noise, memory, speed or a step that make
/// no sense, fewer than 128 samples, and no seeds
PlannedTime told_by(const PlannedTow& plan, int seconds, int seeds = made_records, std::uint64_t seed = 1);

/// Times that were tried on the way to one whose interval holds and has at most the half width `width`; the last has,
/// unless that would take more than `most` seconds. (F99) \throws as told_by(), and for a width that is not positive
std::vector<PlannedTime> times_for(const PlannedTow& plan, double width, int most = 3600, int seeds = made_records);

}  // namespace fit
