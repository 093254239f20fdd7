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

Eigen::VectorXd WaveSignals::at(double t) const {
  const double grown = ramp(t, ramp_).value;
  const double sample = t / step_, whole = std::round(sample);
  // Times of whole steps are products n·h, so they differ from the grid by round-off only.
  if (std::abs(sample - whole) < 1e-9 * (1 + std::abs(whole)) && whole >= 0 &&
      whole < static_cast<double>(table_.cols()))
    return grown * table_.col(static_cast<Eigen::Index>(whole));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(amplitudes_.rows());
  for (std::size_t c = 0; c < omega_.size(); ++c)
    sum += (amplitudes_.col(static_cast<Eigen::Index>(c)) * std::polar(1.0, omega_[c] * t)).real();
  return grown * sum;
}

}  // namespace dynamics
