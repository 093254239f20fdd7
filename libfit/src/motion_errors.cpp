#include "motion_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/sensor.hpp"
#include "fit/sensor_noise.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/random.hpp"

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

namespace {

/// Mean squares of draws: their mean, and by how much they may exceed it by chance, two deviations.
std::pair<double, double> squares_of(const std::vector<std::vector<double>>& draws) {
  Eigen::ArrayXd squares(std::ssize(draws));
  for (Eigen::Index d = 0; d < squares.size(); ++d) {
    const auto& draw = draws[static_cast<std::size_t>(d)];
    squares[d] = Eigen::Map<const Eigen::VectorXd>(draw.data(), std::ssize(draw)).squaredNorm() /
                 static_cast<double>(draw.size());
  }
  return {squares.mean(), 2 * std::sqrt((squares - squares.mean()).square().mean())};
}

/// A signal as it is, or smoothed where noise moves it within a step: noise of its columns is not the sensor's.
/// Smoothing flattens a motion where it turns, which is where it stays on one step for long: only where it must be.
std::vector<double> without_noise(std::span<const double> signal, const Rounding& rounding,
                                  const DerivativeWeights& smooth) {
  constexpr double next_to_nothing = 0.05;  // of a step: it blurs a twentieth of the samples' roundings
  if (noise_of_differences(signal) < next_to_nothing * rounding.step) return {signal.begin(), signal.end()};
  return smoothed(signal, smooth);
}

/// What rounding does to signals that are up to a few steps larger or smaller, on the grid of the sensor. Their sizes
/// are drawn one from each of as many equal parts of that range: what rounding does changes from step to step, and
/// sizes that lie anywhere leave more of its mean square to chance.
std::vector<std::vector<double>> rounded_alike(const std::vector<double>& signal, const Rounding& rounding,
                                               double deviation, std::uint64_t stream) {
  constexpr std::uint64_t seed = 69;
  constexpr double steps = 4;  // so that most of the signal comes to lie anywhere within a step
  const auto [low, high] = std::minmax_element(signal.begin(), signal.end());
  const double middle = (*low + *high) / 2, furthest = (*high - *low) / 2;
  std::vector<std::vector<double>> out;
  for (std::uint64_t draw = 0; draw < noise_draws; ++draw) {
    const hydro::RandomStream random(seed, stream * 1000 + draw);
    const double size = (static_cast<double>(draw) + random.uniform(signal.size())) / noise_draws,
                 larger = furthest > 0 ? steps * rounding.step / furthest * (2 * size - 1) : 0;
    std::vector<double> error(signal.size());
    for (std::size_t j = 0; j < signal.size(); ++j) {
      const double white = deviation > 0 ? deviation * random.normal(j) : 0.0;
      const double moved = middle + (1 + larger) * (signal[j] - middle) + white;
      error[j] = rounding_error(moved - rounding.level, rounding.step);
    }
    out.push_back(std::move(error));
  }
  return out;
}

}  // namespace

std::optional<Rounding> find_rounding(std::span<const double> values, double step_s) {  // (F69)
  const double step = step_of(values);
  if (step == 0) return std::nullopt;
  const double total = noise_in(values, smoother_of(values, step_s));
  if (!sure_noise(total, step).rounds_with_memory()) return std::nullopt;
  return Rounding{step, values.front(), total};
}

std::vector<std::vector<double>> rounding_of(std::span<const double> values, const Eigen::MatrixXd& explained_by,
                                             const Rounding& rounding, double step_s, std::uint64_t stream) {  // (F69)
  const Eigen::Map<const Eigen::VectorXd> measured(values.data(), std::ssize(values));
  const Eigen::VectorXd fitted = explained_by * hydro::dense::CompleteQr(explained_by).solve(measured);
  const auto signal = without_noise({fitted.data(), values.size()}, rounding, smoother_of(values, step_s));
  auto alone = rounded_alike(signal, rounding, 0, stream);
  const auto [mean, by_chance] = squares_of(alone);
  const double total =
      std::min(rounding.total * rounding.total, (measured - fitted).squaredNorm() / static_cast<double>(values.size()));
  const double white = total - mean - by_chance;
  return white > 0 ? rounded_alike(signal, rounding, std::sqrt(white), stream) : alone;
}

}  // namespace fit
