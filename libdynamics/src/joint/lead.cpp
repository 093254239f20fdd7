#include "dynamics/joint/lead.hpp"

#include <cmath>
#include <memory>

#include "dynamics/line/path.hpp"
#include "dynamics/time/ramp.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

Lead led_harmonically(double amplitude, double omega, double ramp_s) {
  hydro::require(std::isfinite(amplitude) && omega > 0 && ramp_s >= 0,
                 "a joint is led with a finite amplitude, a positive frequency and no negative ramp");
  return [=](double t) -> Led {
    const double s = amplitude * std::sin(omega * t), c = amplitude * std::cos(omega * t);
    const Led full{s, omega * c, -omega * omega * s};
    const Ramp r = ramp(t, ramp_s);
    return {r.value * full.travel, r.rate * full.travel + r.value * full.rate,
            r.bend * full.travel + 2 * r.rate * full.rate + r.value * full.acceleration};
  };
}

Lead led_through(std::vector<double> time_s, const std::vector<double>& travel) {
  std::vector<Eigen::Vector3d> along;
  for (const double x : travel) along.push_back(x * Eigen::Vector3d::UnitX());
  const auto path = std::make_shared<const line::SplinePath>(std::move(time_s), along);
  return [path](double t) -> Led {
    const auto at = path->at(t);
    return {at.position.x(), at.velocity.x(), at.acceleration.x()};
  };
}

Lead reversed(Lead lead) {
  return [lead = std::move(lead)](double t) -> Led {
    const Led at = lead(t);
    return {-at.travel, -at.rate, -at.acceleration};
  };
}

}  // namespace dynamics
