#include "dynamics/force/second_order.hpp"

#include "dynamics/time/ramp.hpp"

namespace dynamics {

// (D137)
Vector6 SecondOrderLoad::at(double time) const {
  const double r = ramp(time, ramp_s).value;
  Vector6 out = r * r * mean;
  if (!signals) return out;
  signals->use_at(time, [&](const auto& x) {
    for (Eigen::Index mode = 0; product && mode < 6; ++mode)
      out[mode] += x[0] * x[2 + 2 * mode] + x[1] * x[3 + 2 * mode];
    for (std::size_t mode = 0; mode < 6; ++mode)  // column by column: no memory is asked for in a step
      for (Eigen::Index q = 0; q < form[mode].cols(); ++q)
        out[static_cast<Eigen::Index>(mode)] += x[q] * form[mode].col(q).dot(x);
  });
  return out;
}

void SecondOrderKind::add_load(const Instant& now, LoadSink& out) const {
  for (const SecondOrderLoad& e : elements_) out.add(e.body, e.at(now.state.time));
}

EnergyFlow SecondOrderKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const SecondOrderLoad& e : elements_)
    flow.supplied += e.at(now.state.time).dot(now.state.velocity.segment<6>(6 * e.body));
  return flow;
}

}  // namespace dynamics
