#pragma once
/// \file  Starting a run anywhere: numbers that describe the states about one, joints closed and lengths kept. (F42),
///        docs/theory/fit.md.
#include <Eigen/Core>

#include <vector>

#include "compile/compile.hpp"

namespace froude::compile {

/// Places and velocities of everything that moves, and the angles of links where they have come to.
struct MovingState {
  dynamics::State bodies;
  std::vector<dynamics::line::State> lines;
  std::vector<std::vector<dynamics::line::LinkAngles>> angles;  ///< empty for a start
};
MovingState start_of(const TimeModel& model);

/// The smallest change of the free nodes' places that brings links to their lengths, by Newton; then of their
/// velocities. \throws hydro::NumericsError if they cannot be
void restore_lengths(const dynamics::line::Line& line, dynamics::line::State& state);

/// Why a run of this model cannot go on from places and velocities alone: what has a memory. Empty if it can.
std::string kept_memory(const TimeModel& model);

/// The states near one, by as many numbers as there are free places and velocities: a step along them, then bodies are
/// brought to where joints close, and links to their lengths.
class StateChart {
 public:
  /// The model is that of the middle; it may be forgotten after.
  StateChart(const TimeModel& model, MovingState middle);
  Eigen::Index coordinates() const;
  /// The first ones: places of the bodies together; their velocities follow.
  Eigen::Index places_of_bodies() const { return directions_.front().cols(); }
  /// All zero is the middle. \throws hydro::NumericsError if links cannot be brought to their lengths
  MovingState at(const TimeModel& model, const Eigen::VectorXd& coordinates) const;

 private:
  MovingState middle_;
  std::vector<Eigen::MatrixXd> directions_;  // of the bodies together, then of each line: free places
};

/// The model starts there, and at that time.
void start_from(const MovingState& state, TimeModel& model);

}  // namespace froude::compile
