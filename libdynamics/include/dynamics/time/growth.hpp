#pragma once
/// \file  How fast motions that begin as neighbours part: the largest Lyapunov exponent and its error. (D101), (D102)
#include <optional>
#include <vector>

#include "hydro/base/state_bytes.hpp"

namespace dynamics {

/// The largest Lyapunov exponent over a time: neighbours part as e^{λt}.
struct Exponent {
  double value;     ///< λ, 1/s
  double error;     ///< its standard error by the scatter of blocks, 1/s
  double from, to;  ///< the time that counts, s
  int blocks;
  double block_correlation;  ///< correlation of neighbouring blocks, −1 … 1; 0 if all are the same
  double regular;  ///< ln(to/from)/(to − from), 1/s: what neighbours show that part in proportion to time, λ = 0

  /// False: neighbouring blocks are alike beyond chance, and `error` is too small.
  bool has_lasted() const;
};

/// Distances of a motion from a perturbed trajectory that is brought back along the line between them whenever it has
/// come ten times nearer or farther than it began. (D101) Any norm will do, the same throughout.
class Growth {
 public:
  /// The perturbed trajectory begins at time t_s, `distance` away. \throws hydro::InputError unless that is above 0
  Growth(double t_s, double distance);

  /// At t_s, later than the last, the perturbed trajectory is at `distance`. Returns by what its displacement must be
  /// multiplied now: 1 where it may go on. \throws hydro::NumericsError for a distance that is 0 or no number, or more
  /// than a thousand times off: the motions are then no neighbours
  double note(double t_s, double distance);

  /// Logarithm of how far neighbours have parted since the start, as if the perturbed trajectory had never been brought
  /// back.
  double logarithm() const { return logarithm_.back(); }

  /// Over the times from from_s to the last, in equal blocks; nothing as long as there are fewer notes than blocks.
  /// \throws hydro::InputError unless from_s is above 0 and after the start, and for fewer than 2 blocks
  std::optional<Exponent> exponent(double from_s, int blocks = 20) const;
  void keep_state(hydro::StateBytes& bytes) { bytes.pass(begins_, offset_, time_, logarithm_); }

 private:
  double at(double t_s) const;
  double begins_, offset_ = 0;
  std::vector<double> time_, logarithm_;
};

}  // namespace dynamics
