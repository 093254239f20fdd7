#include "dynamics/line/perturbed_trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "equations.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::line {
namespace {

constexpr double apart = 1e-6;  // at first: far above rounding, and its square below that of lengths

/// The same everywhere and for every line, along nothing in particular.
Places irregular(const Line& line) {
  Places out(3, line.nodes());
  for (int i = 0; i < line.nodes(); ++i)
    for (int c = 0; c < 3; ++c) out(c, i) = std::sin(1.0 + 2.3 * i * (c + 1) + 1.7 * c);
  return out;
}

void require_steps_of_places(const Line& line, const Stepper::Settings& settings) {
  if (keeps_accelerations(settings.scheme))
    throw hydro::InputError(
        fmt::format("steps of {} keep accelerations of their own, of which a perturbed trajectory is not",
                    name_of(settings.scheme)),
        {}, "step the line with \"energy_momentum\"");
  hydro::require(!line.has_massless_nodes(), "a free node of the line has no mass, so motions have no neighbours");
  hydro::require(line.description().gravity > 0, "a line without gravity has no time to measure velocities in");
}

}  // namespace

struct PerturbedTrajectory::Work {
  const Line& line;
  Equations equations;
  Stepper stepper;
  State state;
  Places own;           // room for bring()
  double length, time;  // ℓ, √(ℓ/g)
  int free = 0;
  std::optional<Growth> growth = {};

  Work(const Line& l, const Stepper::Settings& settings)
      : line(l),
        equations(l),
        stepper(l, settings),
        length(l.length() / l.segments()),
        time(std::sqrt(length / l.description().gravity)) {
    for (int i = 0; i < l.nodes(); ++i) free += l.held(i) == nullptr ? 1 : 0;
  }

  double distance(const State& from) const {
    double sum = 0;
    for (int i = 0; i < line.nodes(); ++i)
      if (line.held(i) == nullptr)
        sum += (state.position.col(i) - from.position.col(i)).squaredNorm() +
               time * time * (state.velocity.col(i) - from.velocity.col(i)).squaredNorm();
    return std::sqrt(sum / free) / length;
  }

  /// Multiplies the displacement; of lengths that are kept it leaves squares, which are taken off.
  void bring(const State& beside, double share) {
    state.position = beside.position + share * (state.position - beside.position);
    state.velocity = beside.velocity + share * (state.velocity - beside.velocity);
    if (state.grip.cols() == beside.grip.cols()) state.grip = beside.grip + share * (state.grip - beside.grip);
    const double rounding = 1e-14 * std::max(line.length(), beside.position.cwiseAbs().maxCoeff());
    // What the line's velocities have along lengths, which steps turn round and never damp (D79), its neighbour has
    // too, and nothing of its own: else that would soon be all that is between them where neighbours come together.
    own = beside.velocity;
    if (!equations.project_place(beside.position, rounding, state.position) ||
        !equations.project_velocity(state, state.velocity) || !equations.project_velocity(beside, own))
      throw hydro::NumericsError("a neighbouring motion cannot be brought to the line's lengths");
    state.velocity += beside.velocity - own;
    stepper.go_on(state);
  }
};

PerturbedTrajectory::PerturbedTrajectory(const Line& line, Stepper::Settings settings, const State& state,
                                         const std::optional<Places>& kick) {
  require_steps_of_places(line, settings);
  settings.tolerance = tolerance;
  work_ = std::make_unique<Work>(line, settings);
  Work& w = *work_;
  Places along = kick ? *kick : irregular(line);
  for (const Held& h : line.description().held) along.col(h.node).setZero();
  for (int i = 0; i < line.nodes(); ++i) along.col(i) = along.col(line.same_as(i)).eval();
  if (!w.equations.project_velocity(state, along)) throw hydro::NumericsError("the line's lengths are singular");
  w.state = state;
  w.state.velocity += along;
  const double size = w.distance(state);
  hydro::require(size > 1e-9 * w.time / w.length * along.cwiseAbs().maxCoeff() && size > 0,
                 "nothing of the line can move in the direction of its perturbed trajectory");
  w.bring(state, apart / size);
  w.growth.emplace(state.time, w.distance(state));
}

PerturbedTrajectory::~PerturbedTrajectory() = default;

const Growth& PerturbedTrajectory::growth() const { return *work_->growth; }

void PerturbedTrajectory::keep_state(hydro::StateBytes& bytes) {
  bytes.pass(work_->state, *work_->growth);
  work_->stepper.keep_state(work_->state, bytes);
}

void PerturbedTrajectory::follow(const State& state, const StepReport& took, double h) {
  Work& w = *work_;
  const StepReport own = w.stepper.step(w.state, h);
  if (own.halvings != took.halvings)
    throw hydro::NumericsError(
        fmt::format("the step to t = {:.6g} s is cut for one of two neighbouring motions and not for the other: a "
                    "smaller step is needed",
                    state.time));
  w.state.time = state.time;
  const double share = w.growth->note(state.time, w.distance(state));
  if (share != 1) w.bring(state, share);
}

}  // namespace dynamics::line
