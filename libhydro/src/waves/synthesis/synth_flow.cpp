#include "synth_flow.hpp"

namespace hydro::waves {

StretchedHeight Surroundings::stretched(double z, double elevation) const {
  const double h = water.depth.metres();
  require(z >= -h, "a point at z = {} m lies below the bed at z = {} m", z, -h);
  return stretched_height(options.stretching, z, elevation, h, options.hs_m);
}

Kinematics Surroundings::kinematics(const Flow& flow, double z, double elevation) const {
  const Eigen::Vector2d U = current.at(z), shear = current.gradient(z);
  const Eigen::Vector3d wave(flow.ux, flow.uy, flow.uz);
  Kinematics out{};
  out.elevation = elevation;
  out.velocity = wave + Eigen::Vector3d(U.x(), U.y(), 0);
  out.acceleration = {flow.ax, flow.ay, flow.az};
  // ∇²φ = 0 gives the last entry.
  out.gradient << flow.xx, flow.xy, flow.xz + shear.x(), flow.xy, flow.yy, flow.yz + shear.y(), flow.xz, flow.yz,
      -flow.xx - flow.yy;
  out.dynamic_pressure = -water.density * (flow.potential_rate + U.x() * wave.x() + U.y() * wave.y());
  if (options.pressure == PressureLaw::full)
    out.dynamic_pressure += water.density * (options.bernoulli_constant - 0.5 * wave.squaredNorm());
  return out;
}

}  // namespace hydro::waves
