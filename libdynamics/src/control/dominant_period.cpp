#include "dynamics/control/dominant_period.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/signal/fft.hpp"

namespace dynamics {

double dominant_frequency(const std::vector<double>& values, double step_s) {
  const auto n = static_cast<double>(values.size());
  double mean = 0;
  for (const double v : values) mean += v / n;
  std::vector<double> tapered(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    tapered[i] = (values[i] - mean) * std::pow(std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / n), 2);
  const auto spectrum = hydro::signal::real_fft(tapered);
  std::size_t peak = 0;
  for (std::size_t k = 1; k + 1 < spectrum.size(); ++k)
    if (std::abs(spectrum[k]) > std::abs(spectrum[peak]) || peak == 0) peak = k;
  if (peak == 0 || !(std::abs(spectrum[peak]) > 0)) return 0;
  const double below = std::log(std::abs(spectrum[peak - 1]) + 1e-300), at = std::log(std::abs(spectrum[peak]));
  const double above = std::log(std::abs(spectrum[peak + 1]) + 1e-300), bend = below - 2 * at + above;
  const double shift = bend < 0 ? std::clamp((below - above) / (2 * bend), -0.5, 0.5) : 0;
  return (static_cast<double>(peak) + shift) / (n * step_s);
}

DominantPeriodController::DominantPeriodController(PeriodSwitching law)
    : law_(std::move(law)), next_check_(law_.every) {
  hydro::require(law_.every > 0 && law_.window > 0 && law_.hysteresis > 0 && law_.dwell >= 0,
                 "times and hysteresis of a switch must be positive");
  hydro::require(!law_.settings.empty() && law_.settings.front().from == 0, "settings must begin at a period of 0 s");
  for (std::size_t i = 1; i < law_.settings.size(); ++i)
    hydro::require(law_.settings[i].from > law_.settings[i - 1].from, "periods of settings must ascend");
}

double DominantPeriodController::frequency() const {
  const double step = (time_.back() - time_.front()) / static_cast<double>(time_.size() - 1);
  return dominant_frequency(value_, step);
}

std::optional<double> DominantPeriodController::sample(double time_s, double value) {
  time_.push_back(time_s);
  value_.push_back(value);
  if (time_s < next_check_) return {};
  const auto old = std::lower_bound(time_.begin(), time_.end(), time_s - law_.window);
  value_.erase(value_.begin(), value_.begin() + (old - time_.begin()));
  time_.erase(time_.begin(), old);
  if (time_.size() < 8) return {};
  next_check_ += law_.every;
  // A sample stands for the step before it. What begins tells nothing of the period yet: there is no check.
  const double span = time_.back() - time_.front(), looked_at = span + span / static_cast<double>(time_.size() - 1);
  if (looked_at < law_.window * (1 - 1e-9)) return {};
  const double now = frequency();
  const bool steady = last_frequency_ && std::abs(now - *last_frequency_) <= law_.hysteresis && now > 0;
  last_frequency_ = now;
  if (!steady || time_s - last_switch_ < law_.dwell) return {};
  const auto after = std::upper_bound(law_.settings.begin(), law_.settings.end(), 1 / now,
                                      [](double period, const PeriodSetting& s) { return period < s.from; });
  const auto chosen = static_cast<std::size_t>(after - law_.settings.begin()) - 1;
  if (setting_ == chosen) return {};
  setting_ = chosen;
  last_switch_ = time_s;
  return law_.settings[chosen].value;
}

}  // namespace dynamics
