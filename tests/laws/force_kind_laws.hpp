#pragma once
/// \file  The laws that every kind of force obeys (force_kind.hpp, L1 to L5), as a suite for any of them.
#include <gtest/gtest.h>

#include <memory>

#include "dynamics/force/force_kind.hpp"
#include "laws/signal_laws.hpp"
#include "support/force_law_models.hpp"

namespace laws {

using dynamics::ForceKind;
using dynamics::State;

inline Eigen::VectorXd load(const ForceKind& kind, const State& state, dynamics::Memory* memory) {
  Eigen::VectorXd F = Eigen::VectorXd::Zero(state.velocity.size());
  dynamics::LoadSink sink(F);
  kind.add_load({state, memory}, sink);
  return F;
}

/// ∂F/∂q (by_displacement 1, by_velocity 0) or ∂F/∂v (0, 1), dense.
inline Eigen::MatrixXd jacobian(const ForceKind& kind, const State& state, dynamics::Memory* memory,
                                double by_displacement, double by_velocity) {
  dynamics::BlockPattern pattern(static_cast<int>(state.pose.size()));
  kind.couple(pattern);
  pattern.freeze();
  dynamics::BlockMatrix m(pattern);
  dynamics::JacobianSink sink(m, by_displacement, by_velocity);
  kind.add_jacobian({state, memory}, sink);
  return -m.dense();
}

inline void expect_pure(const ForceKind& kind, const State& state, const State& other, dynamics::Memory* memory) {
  const Eigen::VectorXd first = load(kind, state, memory);
  load(kind, other, memory);
  EXPECT_EQ(load(kind, state, memory), first) << "L1: asked again after another state";
  Eigen::VectorXd sum = first;
  dynamics::LoadSink sink(sum);
  kind.add_load({state, memory}, sink);
  EXPECT_LT((sum - 2 * first).norm(), 1e-12 * (1 + first.norm())) << "L2: added, not assigned";
}

/// L5 by central differences: error e² F‴/6 + round-off/e, hence the tolerance relative to the largest derivative.
inline void expect_true_jacobians(const ForceKind& kind, const State& state, dynamics::Memory* memory) {
  constexpr double e = 1e-5;
  const Eigen::Index n = state.velocity.size();
  Eigen::MatrixXd by_q(n, n), by_v(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd d = e * Eigen::VectorXd::Unit(n, i);
    by_q.col(i) =
        (load(kind, dynamics::moved(state, d), memory) - load(kind, dynamics::moved(state, -d), memory)) / (2 * e);
    State plus = state, minus = state;
    plus.velocity += d;
    minus.velocity -= d;
    by_v.col(i) = (load(kind, plus, memory) - load(kind, minus, memory)) / (2 * e);
  }
  const Eigen::MatrixXd q = jacobian(kind, state, memory, 1, 0), v = jacobian(kind, state, memory, 0, 1);
  EXPECT_LT((q - by_q).cwiseAbs().maxCoeff(), 2e-7 * (1 + by_q.cwiseAbs().maxCoeff())) << "L5 by displacement";
  EXPECT_LT((v - by_v).cwiseAbs().maxCoeff(), 2e-7 * (1 + by_v.cwiseAbs().maxCoeff())) << "L5 by velocity";
}

/// vᵀM v of the kind's own mass.
inline double mass_between_velocities(const ForceKind& kind, const State& state) {
  Eigen::VectorXd momentum = Eigen::VectorXd::Zero(state.velocity.size());
  dynamics::MassSink sink(state.velocity, momentum);
  kind.add_mass(state, sink);
  return momentum.dot(state.velocity);
}

/// Both ways of asking for the mass agree, and it is symmetric and never negative.
inline void expect_true_mass(const ForceKind& kind, const State& state) {
  dynamics::BlockPattern pattern(static_cast<int>(state.pose.size()));
  kind.couple(pattern);
  pattern.freeze();
  dynamics::BlockMatrix matrix(pattern);
  dynamics::MassSink sink(matrix, 2);
  kind.add_mass(state, sink);
  const Eigen::MatrixXd M = matrix.dense() / 2;
  const double size = 1 + M.cwiseAbs().maxCoeff();
  EXPECT_LT((M - M.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size);
  EXPECT_NEAR(state.velocity.dot(M * state.velocity), mass_between_velocities(kind, state),
              1e-12 * size * state.velocity.squaredNorm());
  EXPECT_GE(mass_between_velocities(kind, state), -1e-12 * size);
}

/// L4: F·v + ½ vᵀ(dM/dt)v = supplied − dissipated − d(stored)/dt, rates by central differences along the motion. What
/// the mass itself was is asked at other times too, since water rises.
inline void expect_energy_balance(const ForceKind& kind, const State& state, dynamics::Memory* memory) {
  constexpr double e = 1e-5;
  const auto flow = kind.energy({state, memory});
  const State ahead = dynamics::moved(state, e * state.velocity), behind = dynamics::moved(state, -e * state.velocity);
  const double stored_rate = (kind.energy({ahead, memory}).stored - kind.energy({behind, memory}).stored) / (2 * e);
  State later = ahead, earlier = behind;
  later.time += e;
  earlier.time -= e;
  const double mass_rate = (mass_between_velocities(kind, later) - mass_between_velocities(kind, earlier)) / (4 * e);
  const double power = load(kind, state, memory).dot(state.velocity) + mass_rate;
  const double scale =
      std::abs(power) + std::abs(flow.supplied) + std::abs(flow.dissipated) + std::abs(stored_rate) + 1;
  EXPECT_NEAR(power, flow.supplied - flow.dissipated - stored_rate, 1e-7 * scale) << "L4";
}

/// All of them at several random states.
inline void expect_force_laws(const ForceKind& kind, const std::vector<dynamics::RigidBody>& bodies) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    State state = support::random_state(bodies, seed), other = support::random_state(bodies, seed + 100);
    const auto memory = kind.make_memory(dynamics::rest_state(bodies));
    expect_pure(kind, state, other, memory.get());
    expect_true_jacobians(kind, state, memory.get());
    expect_energy_balance(kind, state, memory.get());
    expect_true_mass(kind, state);
    state.velocity.setZero();
    expect_true_variations(kind.signals(), state);
  }
}

}  // namespace laws
