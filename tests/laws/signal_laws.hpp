#pragma once
/// \file  The laws of signals (dynamics/state/signal.hpp): a variation is the derivative of the value, and a signal
/// without one says why.
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/joint/joint.hpp"
#include "dynamics/state/signal.hpp"

namespace laws {

/// The value at a state, without the memory of a run.
inline double value_of(const dynamics::Signal& s, const dynamics::State& state, const Eigen::VectorXd& acceleration,
                       const Eigen::VectorXd& multipliers) {
  return s.value({state, acceleration, multipliers, multipliers.size(), nullptr});
}

/// How the six components of a joint's load vary, over all bodies and all multipliers.
struct LoadVariations {
  Eigen::MatrixXd by_motion, by_multiplier;  ///< (6, 6N), (6, count)
};
inline LoadVariations load_variations(const dynamics::JointSet& joints, int joint, dynamics::End end,
                                      const dynamics::State& still, const Eigen::VectorXd& lambda) {
  LoadVariations out{Eigen::MatrixXd::Zero(6, still.velocity.size()), Eigen::MatrixXd::Zero(6, joints.count())};
  const auto all = joints.load_variations(joint, end, still, lambda);
  for (int i = 0; i < 6; ++i) {
    const dynamics::Variation& told = all[static_cast<std::size_t>(i)];
    for (const auto& part : told.parts) out.by_motion.block<1, 6>(i, 6 * part.body) += part.by_motion;
    for (const auto& [column, factor] : told.by_multiplier) out.by_multiplier(i, column) += factor;
  }
  return out;
}

/// Variations about `still`, which has no velocities, against central differences of the values: error e² f‴/6 +
/// round-off/e, hence the tolerance relative to the largest derivative.
inline void expect_true_variations(const std::vector<dynamics::Signal>& signals, const dynamics::State& still,
                                   const Eigen::VectorXd& multipliers = {}) {
  constexpr double way = 1e-5, e_v = 1e-7;  // quadratic damping has a kink in its slope at rest: error of order e_v
  const Eigen::Index n = still.velocity.size();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  for (const dynamics::Signal& s : signals) {
    EXPECT_NE(static_cast<bool>(s.variation), !s.no_variation.empty()) << s.name << " has a variation or a reason";
    EXPECT_FALSE(s.name.empty() || s.unit.empty() || s.meaning.empty()) << s.name;
    if (!s.variation) continue;
    const dynamics::Variation told = s.variation({still, multipliers});
    Eigen::VectorXd by_q = none, by_v = none, by_a = none, by_l = Eigen::VectorXd::Zero(multipliers.size());
    for (const auto& part : told.parts) {
      by_q.segment<6>(6 * part.body) += part.by_motion.transpose();
      by_v.segment<6>(6 * part.body) += part.by_velocity.transpose();
      by_a.segment<6>(6 * part.body) += part.by_acceleration.transpose();
    }
    for (const auto& [row, factor] : told.by_multiplier) by_l[row] += factor;
    const auto expect_derivative = [&](const Eigen::VectorXd& derivative, const char* by, double e, auto at) {
      const double scale = 1 + derivative.cwiseAbs().maxCoeff();
      for (Eigen::Index i = 0; i < derivative.size(); ++i) {
        const Eigen::VectorXd d = e * Eigen::VectorXd::Unit(derivative.size(), i);
        const double ahead = at(d), rounding = 1e-15 * std::abs(ahead) / e;
        EXPECT_NEAR(derivative[i], (ahead - at(Eigen::VectorXd(-d))) / (2 * e), 2e-7 * scale + rounding)
            << s.name << " by " << by << " " << i;
      }
    };
    expect_derivative(by_q, "displacement", way, [&](const Eigen::VectorXd& d) {
      return value_of(s, dynamics::moved(still, d), none, multipliers);
    });
    expect_derivative(by_v, "velocity", e_v, [&](const Eigen::VectorXd& d) {
      dynamics::State moving = still;
      moving.velocity = d;
      return value_of(s, moving, none, multipliers);
    });
    expect_derivative(by_a, "acceleration", way,
                      [&](const Eigen::VectorXd& d) { return value_of(s, still, d, multipliers); });
    if (multipliers.size() > 0)
      expect_derivative(by_l, "multiplier", way,
                        [&](const Eigen::VectorXd& d) { return value_of(s, still, none, multipliers + d); });
  }
}

}  // namespace laws
