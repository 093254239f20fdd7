#pragma once
/// \file  The mooring line of the OC3 spar and how its fairlead is moved, for a case and for its price.
#include "harness/line_cases.hpp"

namespace froude::validation {

/// Two metres of surge and one of heave together, period 10 s.
class Oc3Moved final : public dynamics::line::Path {
 public:
  explicit Oc3Moved(const Eigen::Vector3d& place) : place_(place) {}
  Place at(double t) const override {
    constexpr double omega = 2 * std::numbers::pi / 10;
    const Eigen::Vector3d way(2, 0, 1);
    return {place_ + std::sin(omega * t) * way, omega * std::cos(omega * t) * way,
            -omega * omega * std::sin(omega * t) * way};
  }

 private:
  Eigen::Vector3d place_;
};

inline MooringLine oc3_line() {
  constexpr double damping = 0.8 * 902.2 / 200 * 172791;  // 0.8 of ℓ√(EA m) at 200 segments, N s
  return {.length = 902.2,
          .mass_per_length = 77.7066,
          .diameter = 0.09,
          .axial_stiffness = 384.243e6,
          .axial_damping = damping,
          .cd = 1.6,
          .cd_tangential = 0.1,
          .ca = 1,
          .anchor = {853.87, 0, -320},
          .fairlead = {5.2, 0, -70},
          .water = {.density = 1025, .gravity = 9.80665, .depth = hydro::WaterDepth::from_metres(320)},
          .bed = {{.z = -320, .stiffness = 3e6, .damping = 3e5}}};
}

}  // namespace froude::validation
