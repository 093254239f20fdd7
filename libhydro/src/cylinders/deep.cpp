#include "deep.hpp"

#include <algorithm>
#include <cmath>

namespace hydro::cylinders {
namespace {

constexpr double deep_sizes = 60;   // in these depths the bottom is felt by (size/h)³
constexpr double most_sizes = 400;  // beyond, the gap under the cylinder is too long for its edge
constexpr double wave_depths = 20;  // Kh at which the error is some 1e-6 …
constexpr double least_depths = 8;  // … and 6e-5

}  // namespace

Water effective_water(const std::vector<CylinderBody>& bodies, const Water& water, double omega) {
  std::vector<Cylinder> all;
  for (const CylinderBody& body : bodies) all.insert(all.end(), body.cylinders.begin(), body.cylinders.end());
  return effective_water(all, water, omega, deep_sizes);
}

Water effective_water(const std::vector<Cylinder>& all, const Water& water, double omega, double sizes) {
  if (!water.depth.is_infinite()) return water;
  double size = 0, across = 0;
  for (const Cylinder& c : all) {
    size = std::max(size, c.radius + c.draught.value_or(0));
    for (const Cylinder& other : all) across = std::max(across, (c.centre - other.centre).norm());
  }
  const double K = omega * omega / water.gravity, most = most_sizes * size;
  if (K * most < least_depths)
    throw InputError(fmt::format("{:.6g} rad/s is too low for infinitely deep water: a wave of this length needs more "
                                 "than {:.4g} m of depth to be deep, {:.0f} times the size of the cylinders",
                                 omega, least_depths / K, most_sizes),
                     {},
                     fmt::format("state the depth, or ask for frequencies from {:.4g} rad/s",
                                 std::sqrt(least_depths / most * water.gravity)));
  Water finite = water;
  finite.depth = WaterDepth::from_metres(std::max({sizes * size, 2 * across, std::min(wave_depths / K, most)}));
  return finite;
}

}  // namespace hydro::cylinders
