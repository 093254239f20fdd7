#pragma once
/// \file  A second motion beside that of a line, so near that it tells how fast neighbours part. (D101)
#include <memory>
#include <optional>

#include "dynamics/line/stepper.hpp"
#include "dynamics/time/growth.hpp"

namespace dynamics::line {

/// Stepped as the line itself. Distance: root mean square over the free nodes of |δx| and |δv|√(ℓ/g), in mean
/// segments' lengths ℓ; at first a millionth of that.
class PerturbedTrajectory {
 public:
  /// Newton's tolerance for lines that have a perturbed trajectory: what it leaves must be small against their
  /// distance.
  static constexpr double tolerance = 1e-11;

  /// `settings`: those of the line's own stepper, but that its tolerance is the above. Begins beside `state`, which has
  /// been started, with other velocities: along `kick` (3, nodes) as far as lengths allow, of any size; left out: in a
  /// fixed, irregular direction. \throws hydro::InputError for generalised-α, whose steps keep more than places and
  /// velocities, for free nodes without mass, for a line without gravity, and for one in which nothing can move so
  PerturbedTrajectory(const Line& line, Stepper::Settings settings, const State& state,
                      const std::optional<Places>& kick = std::nullopt);
  ~PerturbedTrajectory();
  PerturbedTrajectory(const PerturbedTrajectory&) = delete;
  PerturbedTrajectory& operator=(const PerturbedTrajectory&) = delete;

  /// The line has made one step of h seconds to `state`, and `took` that. \throws hydro::NumericsError if the perturbed
  /// trajectory cannot make the same step, or is no neighbour any more
  void follow(const State& state, const StepReport& took, double h);

  const Growth& growth() const;
  /// All that it goes on from, into bytes or out of them.
  void keep_state(hydro::StateBytes& bytes);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace dynamics::line
