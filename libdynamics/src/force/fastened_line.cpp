#include "dynamics/force/fastened_line.hpp"

#include <fmt/format.h>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using line::DrivenLine;

/// Where bodies have the ends of a line, into a vector that has room.
void find_ends(const FastenedLine& l, const State& state, std::vector<DrivenLine::End>& out) {
  out.clear();
  for (const auto& end : l.ends) out.push_back({place_of(end.at, state), velocity_of(end.at, state)});
}

std::vector<DrivenLine::End> ends_of(const FastenedLine& l, const State& state) {
  std::vector<DrivenLine::End> out;
  find_ends(l, state, out);
  return out;
}

std::vector<int> nodes_of(const FastenedLine& l) {
  std::vector<int> out;
  for (const auto& end : l.ends) out.push_back(end.node);
  return out;
}

/// Pulls of a line: in its step, where its memory has them, or at rest, in `at_rest`.
const DrivenLine::Pulls& pulls_of(const FastenedLine& l, std::size_t i, const Instant& now,
                                  DrivenLine::Pulls& at_rest) {
  if (now.memory != nullptr) return static_cast<FastenedLineMemory*>(now.memory)->pulls(i, now.state);
  const auto found = pulls_at_rest(line::Line(l.still), line_at_rest(l, now.state), nodes_of(l));
  at_rest = {-found.force, -found.by_place, -found.by_velocity};
  return at_rest;
}

/// Their forces alone.
const line::Places& force_of(const FastenedLine& l, std::size_t i, const Instant& now, DrivenLine::Pulls& at_rest) {
  if (now.memory != nullptr) return static_cast<FastenedLineMemory*>(now.memory)->force(i, now.state);
  return pulls_of(l, i, now, at_rest).force;
}

/// Energy held by a line: what moves counts too, since a body cannot tell one from the other.
EnergyFlow energy_of(const DrivenLine& l) {
  const line::Stepper::Flow flow = l.flow();
  return {.stored = l.energies().total(), .supplied = flow.supplied, .dissipated = flow.dissipated};
}

}  // namespace

line::State line_at_rest(const FastenedLine& l, const State& bodies) {
  const line::Line still(l.still);
  line::State at{.time = bodies.time,
                 .position = l.places,
                 .velocity = line::Places::Zero(3, still.nodes()),
                 .tension = Eigen::VectorXd::Zero(still.segments())};
  const auto ends = ends_of(l, bodies);
  for (std::size_t k = 0; k < ends.size(); ++k) at.position.col(l.ends[k].node) = ends[k].position;
  return equilibrium(still, hanging_shape(still, at));
}

FastenedLineMemory::FastenedLineMemory(const std::vector<FastenedLine>& elements, const State& state)
    : elements_(elements) {
  Eigen::Index count = 0;
  for (const FastenedLine& l : elements) {
    lines_.push_back(std::make_unique<DrivenLine>(l.run, nodes_of(l), l.rho_infinity));
    count += static_cast<Eigen::Index>(l.ends.size());
  }
  at_rest_.resize(elements.size());
  start(state, line::Places::Zero(3, count));
}

/// Line i at rest there; a start that tries other accelerations finds it known.
const line::State& FastenedLineMemory::at_rest(std::size_t i, const State& state) {
  AtRest& known = at_rest_[i];
  find_ends(elements_[i], state, ends_);
  if (known.ends != ends_) {
    known.state = line_at_rest(elements_[i], state);
    known.ends = ends_;
  }
  known.state.time = state.time;
  return known.state;
}

void FastenedLineMemory::start(const State& state, const line::Places& accelerations) {
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto count = static_cast<Eigen::Index>(elements_[i].ends.size());
    const line::State& still = at_rest(i, state);  // which finds the ends
    lines_[i]->start(still, ends_, accelerations.middleCols(first, count));
    first += count;
  }
}

line::Places FastenedLineMemory::accelerations_of_ends(const State& state, const Eigen::VectorXd& acceleration) const {
  std::vector<Vector3d> all;
  for (const FastenedLine& l : elements_)
    for (const auto& end : l.ends) all.push_back(acceleration_of(end.at, state, acceleration));
  line::Places out(3, static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = all[k];
  return out;
}

void FastenedLineMemory::accept(const State& state) {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    find_ends(elements_[i], state, ends_);
    lines_[i]->accept(state.time, ends_);
  }
}

const line::Places& FastenedLineMemory::force(std::size_t i, const State& state) {
  find_ends(elements_[i], state, ends_);
  return lines_[i]->force(state.time, ends_);
}

const DrivenLine::Pulls& FastenedLineMemory::pulls(std::size_t i, const State& state) {
  find_ends(elements_[i], state, ends_);
  return lines_[i]->pulls(state.time, ends_);
}

void FastenedLineKind::couple(BlockPattern& pattern) const {
  for (const FastenedLine& l : elements_)
    for (std::size_t k = 0; k < l.ends.size(); ++k)
      for (std::size_t m = 0; m < k; ++m)
        if (l.ends[m].at.body != l.ends[k].at.body) pattern.couple(l.ends[m].at.body, l.ends[k].at.body);
}

std::unique_ptr<Memory> FastenedLineKind::make_memory(const State& state) const {
  return std::make_unique<FastenedLineMemory>(elements_, state);
}

void FastenedLineKind::add_load(const Instant& now, LoadSink& out) const {
  DrivenLine::Pulls at_rest;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const line::Places& forces = force_of(elements_[i], i, now, at_rest);
    for (std::size_t k = 0; k < elements_[i].ends.size(); ++k) {
      const auto& end = elements_[i].ends[k];
      const Vector3d force = forces.col(static_cast<Eigen::Index>(k));
      Vector6 load;
      load << force, arm_of(end.at, now.state).cross(force);
      out.add(end.at.body, load);
    }
  }
}

// (D90): moments turn with the arm, and a turning arm changes the velocity of its end by ω × (δθ × r).
void FastenedLineKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  DrivenLine::Pulls at_rest;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto& ends = elements_[i].ends;
    const DrivenLine::Pulls& p = pulls_of(elements_[i], i, now, at_rest);
    for (std::size_t k = 0; k < ends.size(); ++k)
      for (std::size_t m = 0; m < ends.size(); ++m) {
        const auto row = 3 * static_cast<Eigen::Index>(k), column = 3 * static_cast<Eigen::Index>(m);
        const Matrix3d by_x = p.by_place.block<3, 3>(row, column), by_v = p.by_velocity.block<3, 3>(row, column);
        const Vector3d arm = arm_of(ends[k].at, now.state), other = arm_of(ends[m].at, now.state);
        const Vector3d omega = now.state.twist(ends[m].at.body).tail<3>();
        Eigen::Matrix<double, 3, 6> by_q = by_x * place_by_displacement(other);
        by_q.rightCols<3>() -= by_v * cross_matrix(omega) * cross_matrix(other);
        const Eigen::Matrix<double, 6, 3> acts = place_by_displacement(arm).transpose();
        Matrix6 by_displacement = acts * by_q;
        const Vector3d force = p.force.col(static_cast<Eigen::Index>(k));
        if (k == m) by_displacement.bottomRightCorner<3, 3>() += cross_matrix(force) * cross_matrix(arm);
        out.add(ends[k].at.body, ends[m].at.body, by_displacement, acts * by_v * place_by_displacement(other));
      }
  }
}

EnergyFlow FastenedLineKind::energy(const Instant& now) const {
  EnergyFlow sum;
  if (now.memory == nullptr) return sum;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const EnergyFlow one = energy_of(static_cast<FastenedLineMemory*>(now.memory)->line(i));
    sum.stored += one.stored;
    sum.supplied += one.supplied;
    sum.dissipated += one.dissipated;
  }
  return sum;
}

namespace {

/// How the pull on one end varies about rest: as its direction goes, with the static stiffness.
Variation pull_variation(const FastenedLine& l, std::size_t k, const State& still) {
  DrivenLine::Pulls at_rest;
  const DrivenLine::Pulls& p = pulls_of(l, 0, {still, nullptr}, at_rest);
  const Vector3d along = p.force.col(static_cast<Eigen::Index>(k)).normalized();
  Variation out;
  for (std::size_t m = 0; m < l.ends.size(); ++m) {
    const auto row = 3 * static_cast<Eigen::Index>(k), column = 3 * static_cast<Eigen::Index>(m);
    const Matrix3d by_x = p.by_place.block<3, 3>(row, column), by_v = p.by_velocity.block<3, 3>(row, column);
    const Eigen::Matrix<double, 3, 6> follow = place_by_displacement(arm_of(l.ends[m].at, still));
    out.parts.push_back({.body = l.ends[m].at.body,
                         .by_motion = along.transpose() * by_x * follow,
                         .by_velocity = along.transpose() * by_v * follow});
  }
  return out;
}

}  // namespace

std::vector<Signal> FastenedLineKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    for (std::size_t k = 0; k < elements_[i].ends.size(); ++k)
      out.push_back(
          {.name = elements_[i].ends[k].name + ".force",
           .unit = "N",
           .meaning = fmt::format("pull of {} on its body", elements_[i].ends[k].name),
           .value =
               [this, i, k](const Reading& r) {
                 DrivenLine::Pulls at_rest;
                 const auto& forces = force_of(elements_[i], i, {r.state, r.memory}, at_rest);
                 return forces.col(static_cast<Eigen::Index>(k)).norm();
               },
           .variation = [this, i, k](const Still& still) { return pull_variation(elements_[i], k, still.state); }});
  return out;
}

}  // namespace dynamics
