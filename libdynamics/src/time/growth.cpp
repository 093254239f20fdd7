#include "dynamics/time/growth.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {

namespace {
constexpr double back_at = 10, lost_at = 1000;  // times the distance at which the perturbed trajectory begins
}

bool Exponent::has_lasted() const { return block_correlation <= 2 / std::sqrt(static_cast<double>(blocks)); }

Growth::Growth(double t_s, double distance) : begins_(distance), time_{t_s}, logarithm_{0} {
  hydro::require(std::isfinite(distance) && distance > 0, "a perturbed trajectory needs a distance above 0, got {}",
                 distance);
}

double Growth::note(double t_s, double distance) {
  hydro::require(t_s > time_.back(), "time must increase: {} s does not come after {} s", t_s, time_.back());
  const double times = distance / begins_;
  if (!(times > 1 / lost_at && times < lost_at))
    throw hydro::NumericsError(fmt::format(
        "at t = {:.6g} s a neighbouring motion is {:.3g} times as far away as it began: a smaller step is needed", t_s,
        times));
  time_.push_back(t_s);
  logarithm_.push_back(offset_ + std::log(times));
  if (times < back_at && times > 1 / back_at) return 1;
  offset_ = logarithm_.back();
  return 1 / times;
}

/// The logarithm at a time within the notes, straight between two.
double Growth::at(double t_s) const {
  const auto after = std::lower_bound(time_.begin(), time_.end(), t_s);
  if (after == time_.begin()) return logarithm_.front();
  if (after == time_.end()) return logarithm_.back();
  const auto k = static_cast<std::size_t>(after - time_.begin());
  const double s = (t_s - time_[k - 1]) / (time_[k] - time_[k - 1]);
  return (1 - s) * logarithm_[k - 1] + s * logarithm_[k];
}

// (D102)
std::optional<Exponent> Growth::exponent(double from_s, int blocks) const {
  hydro::require(blocks >= 2, "the scatter of blocks needs at least 2 of them, got {}", blocks);
  hydro::require(from_s > time_.front() && from_s > 0, "an exponent is asked from {} s on of a motion from {} s on",
                 from_s, time_.front());
  const double to = time_.back(), length = (to - from_s) / blocks;
  if (time_.end() - std::upper_bound(time_.begin(), time_.end(), from_s) < blocks) return std::nullopt;
  std::vector<double> local;
  for (int k = 0; k < blocks; ++k) local.push_back((at(from_s + (k + 1) * length) - at(from_s + k * length)) / length);
  Exponent out{.value = (at(to) - at(from_s)) / (to - from_s),
               .error = 0,
               .from = from_s,
               .to = to,
               .blocks = blocks,
               .block_correlation = 0,
               .regular = std::log(to / from_s) / (to - from_s)};
  double squares = 0, products = 0;
  for (std::size_t k = 0; k < local.size(); ++k) {
    squares += std::pow(local[k] - out.value, 2);
    if (k > 0) products += (local[k] - out.value) * (local[k - 1] - out.value);
  }
  out.error = std::sqrt(squares / (blocks - 1.0) / blocks);
  if (squares > 0) out.block_correlation = products / squares;
  return out;
}

}  // namespace dynamics
