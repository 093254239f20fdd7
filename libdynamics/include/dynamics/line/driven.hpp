#pragma once
/// \file  A line whose ends are moved by something that is stepped beside it: for each guess of where the ends will be
/// it
///        tells its pulls, and how they follow the guess. (D90), (D91)
#include <memory>
#include <vector>

#include "dynamics/line/stepper.hpp"

namespace dynamics::line {

/// Stepped by generalised-α (D80); the accelerations of those ends follow their velocities as that of everything
/// does, so a body stepped by the same rule and the line are one system with one step.
class DrivenLine {
 public:
  struct End {
    Eigen::Vector3d position, velocity;
    bool operator==(const End&) const = default;
  };
  /// What the line does to what moves its ends: forces on that, N, and their derivatives by places and velocities, (3k,
  /// 3k).
  struct Pulls {
    Places force;
    Eigen::MatrixXd by_place, by_velocity;
  };

  /// `prescribed`: the nodes, which `description` holds; it says no path of them. \throws hydro::InputError as Line and
  /// Stepper
  DrivenLine(Description description, std::vector<int> prescribed, double rho_infinity);
  ~DrivenLine();
  DrivenLine(const DrivenLine&) = delete;
  DrivenLine& operator=(const DrivenLine&) = delete;

  /// Begins at `state` with the velocities of the ends given, and accelerations (3, k).
  void start(const State& state, const std::vector<End>& ends, const Places& accelerations);

  /// Forces if the ends are there at time t, the step being from the last accept() to t; without a step, those at the
  /// instant, with accelerations as at start() or as the last step left them. The same arguments give the same forces,
  /// however often and in whatever order they are asked. Not a number where no such step can be made: a guess that
  /// draws the line beyond its strength of numbers.
  const Places& force(double t_s, const std::vector<End>& ends);
  /// The same with their derivatives, which an instant does not have: they are zero. They cost as much again.
  const Pulls& pulls(double t_s, const std::vector<End>& ends);

  /// The ends are there. \throws hydro::NumericsError if the line cannot follow
  void accept(double t_s, const std::vector<End>& ends);

  /// All that steps go on from, into bytes or out of them.
  void keep_state(hydro::StateBytes& bytes);

  const Line& line() const;
  const State& state() const;
  const Energies& energies() const;
  Stepper::Flow flow() const;
  /// Of what is accepted, found once, when it is asked for first.
  const Stepper::Balance& balance() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace dynamics::line
