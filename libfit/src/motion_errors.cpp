#include "motion_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/sensor.hpp"
#include "fit/sensor_noise.hpp"

namespace fit {
namespace {

double step_of(std::span<const double> values) {
  const auto q = find_quantisation(values);
  return q ? q->step : 0;
}

/// The samples smoothed, those near the ends as they are: the signal that a sensor rounded, but for noise.
std::vector<double> smoothed(std::span<const double> values, const DerivativeWeights& smooth) {
  std::vector<double> out(values.begin(), values.end());
  const auto inner = smooth.apply(values);
  std::copy(inner.begin(), inner.end(), out.begin() + smooth.half_width());
  return out;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  std::transform(a.begin(), a.end(), b.begin(), out.begin(), std::minus<>());
  return out;
}

/// Deviation of white noise from sixth differences, in which a motion of fifteen samples a period and more is next to
/// nothing: Σ C(6,k)² = 924.
double noise_of_differences(std::span<const double> values) {
  std::vector<double> d(values.begin(), values.end());
  for (int order = 0; order < 6; ++order) {
    std::adjacent_difference(d.begin(), d.end(), d.begin());
    d.erase(d.begin());
  }
  return std::sqrt(std::inner_product(d.begin(), d.end(), d.begin(), 0.0) / (924 * static_cast<double>(d.size())));
}

/// The noise of a motion that is sure to be noise: where sixth differences have much less of it than smoothing took
/// off, that was motion, or noise of a kind that is not known, for the larger part.
SensorNoise noise_of(const Motion& motion, std::span<const double> measured) {
  constexpr double much_less = 0.8;
  const double step = step_of(measured), differences = noise_of_differences(measured);
  const bool white = step > 0 || differences > much_less * motion.noise;
  return sensor_noise(white ? motion.noise : differences, step);
}

bool negligible(const Motion& m) {
  constexpr double share = 1e-4;  // of the variance: of inertia, then, as much
  const double squares = std::inner_product(m.acceleration.begin(), m.acceleration.end(), m.acceleration.begin(), 0.0);
  return m.noise_acceleration * m.noise_acceleration * static_cast<double>(m.acceleration.size()) < share * squares;
}

}  // namespace

std::vector<MotionError> errors_of(const Motion& motion, std::span<const double> measured, bool from_velocity,
                                   std::uint64_t stream) {  // (F68)
  if (motion.weights.empty() || negligible(motion)) return {};
  const SensorNoise noise = noise_of(motion, measured);
  const std::vector<double> signal = smoothed(measured, motion.weights[0]);
  const auto cut = static_cast<std::ptrdiff_t>(motion.first);
  std::vector<MotionError> out;
  for (std::uint64_t draw = 0; draw < noise_draws; ++draw) {
    const auto error = drawn_error(signal, noise, DrawnError::all, stream, draw);
    out.push_back(
        {from_velocity ? std::vector<double>(error.begin() + cut, error.end() - cut) : motion.weights[1].apply(error),
         motion.weights.back().apply(error)});
  }
  return out;
}

std::vector<MotionError> relative_errors(const std::vector<MotionError>& body, const std::vector<MotionError>& water) {
  std::vector<MotionError> out;
  for (std::size_t d = 0; d < std::max(body.size(), water.size()); ++d) {
    const std::size_t n = body.empty() ? water[d].velocity.size() : body[d].velocity.size();
    const MotionError still{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
    const MotionError &b = body.empty() ? still : body[d], &w = water.empty() ? still : water[d];
    out.push_back({difference(w.velocity, b.velocity), difference(w.acceleration, b.acceleration), w.acceleration});
  }
  return out;
}

void add_drag_errors(std::span<const double> velocity, std::span<const double> across,
                     std::vector<MotionError>& errors) {
  std::vector<double> slope(velocity.size());
  for (std::size_t j = 0; j < slope.size(); ++j) {
    const double u = velocity[j], w = across.empty() ? 0 : across[j], speed = std::hypot(u, w);
    slope[j] = speed > 0 ? speed + u * u / speed : 0;
  }
  for (MotionError& e : errors) {
    e.drag_flow.resize(slope.size());
    std::transform(slope.begin(), slope.end(), e.velocity.begin(), e.drag_flow.begin(), std::multiplies<>());
  }
}

std::vector<std::vector<double>> rounding_of(std::span<const double> values, double step_s,
                                             std::uint64_t stream) {  // (F69)
  const double step = step_of(values);
  if (step == 0) return {};
  const LocalPolynomial smooth = smoother_of(values, step_s);
  const SensorNoise noise = sure_noise(noise_in(values, smooth), step);
  if (!noise.rounds_with_memory()) return {};
  const std::vector<double> signal = smoothed(values, smooth);
  std::vector<std::vector<double>> out;
  for (std::uint64_t draw = 0; draw < noise_draws; ++draw)
    out.push_back(drawn_error(signal, noise, DrawnError::rounding, stream, draw));
  return out;
}

}  // namespace fit
