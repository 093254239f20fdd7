#include "rest_memory.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "golden_section.hpp"
#include "hydro/signal/fft.hpp"

namespace fit {
namespace {

/// |Σ w_j x_j e^{−iω_k j}|²/Σ w_j² with Hann weights: of white noise its variance, at each ω_k = 2πk/n, 0 < k < n/2.
Eigen::ArrayXd tapered_periodogram(const Eigen::VectorXd& x) {
  const auto n = static_cast<std::size_t>(x.size());
  std::vector<double> faded(n);
  double squares = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double w = std::pow(std::sin(std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(n)), 2);
    faded[j] = w * x[static_cast<Eigen::Index>(j)];
    squares += w * w;
  }
  const auto spectrum = hydro::signal::real_fft(faded);
  Eigen::ArrayXd power(static_cast<Eigen::Index>((n - 1) / 2));
  for (Eigen::Index k = 0; k < power.size(); ++k)
    power[k] = std::norm(spectrum[static_cast<std::size_t>(k) + 1]) / squares;
  return power;
}

/// The white level s at which Σ ln(S + s) + P/(S + s) is least (Whittle 1953), by golden section in ln s.
double white_level(const Eigen::ArrayXd& power, const Eigen::ArrayXd& known) {
  const auto badness = [&](double log_level) {
    const Eigen::ArrayXd model = known + std::exp(log_level);
    return (model.log() + power / model).sum();
  };
  const double high = std::log(2 * power.mean());
  return std::exp(least_by_golden_section(badness, high - std::log(1e8), high, 1e-3));
}

}  // namespace

RestMemory rest_memory(const Eigen::VectorXd& record, const Eigen::MatrixXd& known, Eigen::Index lags) {  // (F69)
  const Eigen::ArrayXd power = tapered_periodogram(record);
  Eigen::ArrayXd of_known = Eigen::ArrayXd::Zero(power.size());
  for (Eigen::Index d = 0; d < known.cols(); ++d)
    of_known += tapered_periodogram(known.col(d)) / static_cast<double>(known.cols());
  RestMemory rest{white_level(power, of_known), Eigen::VectorXd(lags + 1)};
  // Where the known part is the larger one, the ratio tells of its chance alone, and counts as white by as much.
  const Eigen::ArrayXd model = of_known + rest.level, white = 1 + (power / model - 1) * (rest.level / model);
  const double step = 2 * std::numbers::pi / static_cast<double>(record.size());
  for (Eigen::Index lag = 0; lag <= lags; ++lag) {
    double sum = 0;
    for (Eigen::Index k = 0; k < white.size(); ++k)
      sum += white[k] * std::cos(step * static_cast<double>(lag * (k + 1) % record.size()));
    rest.ratio[lag] = sum / static_cast<double>(white.size());
  }
  return rest;
}

}  // namespace fit
