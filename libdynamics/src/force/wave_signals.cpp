#include "dynamics/force/wave_signals.hpp"

#include <cmath>

#include "dynamics/time/ramp.hpp"

namespace dynamics {

WaveSignals::WaveSignals(std::vector<double> omega, Eigen::MatrixXcd amplitudes, Eigen::MatrixXd table, double step,
                         double ramp_s)
    : omega_(std::move(omega)),
      amplitudes_(std::move(amplitudes)),
      table_(std::move(table)),
      step_(step),
      ramp_(ramp_s) {}

// Times of whole steps are products n·h, so they differ from the grid by round-off only.
std::optional<Eigen::Index> WaveSignals::whole_step(double t) const {
  const double sample = t / step_, whole = std::round(sample);
  if (std::abs(sample - whole) < 1e-9 * (1 + std::abs(whole)) && whole >= 0 &&
      whole < static_cast<double>(table_.cols()))
    return static_cast<Eigen::Index>(whole);
  return std::nullopt;
}

double WaveSignals::ramp_at(double t) const { return ramp(t, ramp_).value; }

Eigen::VectorXd WaveSignals::sum_at(double t) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(amplitudes_.rows());
  for (std::size_t c = 0; c < omega_.size(); ++c)
    sum += (amplitudes_.col(static_cast<Eigen::Index>(c)) * std::polar(1.0, omega_[c] * t)).real();
  return sum;
}

Eigen::VectorXd WaveSignals::at(double t) const {
  Eigen::VectorXd out;
  use_at(t, [&](const auto& s) { out = s; });
  return out;
}

}  // namespace dynamics
