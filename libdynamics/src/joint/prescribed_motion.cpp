#include "dynamics/joint/prescribed_motion.hpp"

#include <cmath>
#include <memory>

#include "dynamics/line/path.hpp"
#include "dynamics/time/ramp.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

PrescribedMotion prescribed_harmonic(double amplitude, double omega, double ramp_s) {
  hydro::require(std::isfinite(amplitude) && omega > 0 && ramp_s >= 0,
                 "a prescribed motion has a finite amplitude, a positive frequency and no negative ramp");
  return [=](double t) -> PrescribedState {
    const double s = amplitude * std::sin(omega * t), c = amplitude * std::cos(omega * t);
    const PrescribedState full{s, omega * c, -omega * omega * s};
    const Ramp r = ramp(t, ramp_s);
    return {r.value * full.coordinate, r.rate * full.coordinate + r.value * full.rate,
            r.bend * full.coordinate + 2 * r.rate * full.rate + r.value * full.acceleration};
  };
}

PrescribedMotion prescribed_through(std::vector<double> time_s, const std::vector<double>& coordinate) {
  std::vector<Eigen::Vector3d> along;
  for (const double x : coordinate) along.push_back(x * Eigen::Vector3d::UnitX());
  const auto path = std::make_shared<const line::SplinePath>(std::move(time_s), along);
  return [path](double t) -> PrescribedState {
    const auto at = path->at(t);
    return {at.position.x(), at.velocity.x(), at.acceleration.x()};
  };
}

PrescribedMotion reversed(PrescribedMotion motion) {
  return [motion = std::move(motion)](double t) -> PrescribedState {
    const PrescribedState at = motion(t);
    return {-at.coordinate, -at.rate, -at.acceleration};
  };
}

}  // namespace dynamics
