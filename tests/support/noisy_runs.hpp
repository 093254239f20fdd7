#pragma once
/// \file  Runs whose channels have noise and steps, for tests and cases of intervals.
#include <cmath>
#include <numbers>
#include <utility>

#include "fit/problem/decay.hpp"
#include "fit/problem/morison.hpp"
#include "fit/shooting.hpp"
#include "hydro/base/random.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace froude_test {

struct Noise {
  double position = 0, force = 0;            ///< deviations of white noise, m and N
  double memory = 0;                         ///< φ of the force's noise e_t = φ e_{t−1} + white
  double position_step = 0, force_step = 0;  ///< of the sensors, m and N; 0: they have none
  double step_s = 0.05;                      ///< between samples
  double late_s = 0;                         ///< the force behind the motion
};

inline double in_steps(double value, double step) { return step > 0 ? step * std::round(value / step) : value; }

constexpr double moved_cd = 1.2, moved_ca = 1.0;

/// Position and force of moved_cylinder, swinging by 0.4 m or a little more with a period of 4 s for 56 s; amplitude,
/// phase and place are drawn for each set, so that steps lie anywhere.
inline fit::morison::Problem moved_run(const Noise& noise, std::uint64_t set) {
  const hydro::RandomStream draw(77, set);
  const double omega = 2 * std::numbers::pi / 4, amplitude = 0.4 * (1 + 0.05 * draw.uniform(0)),
               phase = 2 * std::numbers::pi * draw.uniform(1), place = 0.05 * draw.uniform(2);
  const auto n = static_cast<std::size_t>(56 / noise.step_s);
  const auto of_force = ar1_noise(n, noise.memory, noise.force, 2 * set + 1),
             of_position = ar1_noise(n, 0, noise.position, 2 * set + 2);
  fit::RawRun raw;
  raw.force = {{"F", {}, {}}};
  for (std::size_t j = 0; j < n; ++j) {
    const double t = noise.step_s * static_cast<double>(j), angle = omega * t + phase,
                 earlier = angle - omega * noise.late_s;
    raw.time.push_back(t);
    raw.position.push_back(in_steps(place + amplitude * std::sin(angle) + of_position[j], noise.position_step));
    const double force = fit::morison_force(moved_cylinder, moved_cd, moved_ca, amplitude * omega * std::cos(earlier),
                                            -amplitude * omega * omega * std::sin(earlier));
    raw.force[0].values.push_back(in_steps(force + of_force[j], noise.force_step));
  }
  fit::morison::Problem problem;
  problem.runs.push_back({.source = {"run.csv"}, .cylinder = moved_cylinder, .raw = raw});
  problem.options.coefficients = {"cd", "ca"};
  return problem;
}

constexpr double decay_linear = 0.06, decay_quadratic = 0.3;

/// A decay of 40 s from 0.15 m or a little more, and its ω₀, all drawn; `step` is that of the sensor, m, with white
/// noise of a tenth of it, or of 2 mm where it is 0.
inline std::pair<fit::decay::Problem, double> decay_in_steps(double step, double step_s, std::uint64_t set,
                                                             double memory = 0) {
  const hydro::RandomStream draw(99, set);
  const double omega = 2 * (1 + 0.05 * draw.uniform(0)), first = 0.15 * (1 + 0.1 * draw.uniform(1)),
               place = 0.01 * draw.uniform(2);
  const auto n = static_cast<Eigen::Index>(40 / step_s);
  const Eigen::MatrixXd motion =
      fit::follow(fit::MotionLaw::oscillator, std::vector{omega, decay_linear, decay_quadratic, 0.0, 0.0, place},
                  Eigen::Vector2d(place + first, 0), step_s, n, 8);
  const auto noise = ar1_noise(static_cast<std::size_t>(n), memory, step > 0 ? step / 10 : 2e-3, set + 5000);
  fit::decay::Run run{.source = {"decay.csv"}, .time = {}, .motion = {}};
  for (Eigen::Index j = 0; j < n; ++j) {
    run.time.push_back(step_s * static_cast<double>(j));
    run.motion.push_back(in_steps(motion(j, 0) + noise[static_cast<std::size_t>(j)], step));
  }
  fit::decay::Problem problem{.turns = false, .runs = {run}, .body = {}, .options = {}};
  problem.options.motion.terms = {.linear = true, .quadratic = true};
  return {problem, omega};
}

}  // namespace froude_test
