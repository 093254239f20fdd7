#include "dynamics/force/buoyancy.hpp"

#include <limits>

namespace dynamics {
namespace {

namespace hh = hydro::hydrostatics;

bool is_finite(const Pose& pose) { return pose.centre.allFinite() && pose.attitude.coeffs().allFinite(); }

}  // namespace

hh::Immersion immersion(const Buoyancy& element, const RigidBody& body, const Pose& pose) {
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  const hh::Pose placed{R, pose.centre - R * body.properties().centre_of_gravity.xyz};
  return std::visit([&](const auto& shape) { return hh::immersion(shape, placed); }, *element.shape);
}

BuoyancyKind::BuoyancyKind(const std::vector<RigidBody>& bodies, std::vector<Buoyancy> elements,
                           const hydro::Water& water)
    : bodies_(bodies), elements_(std::move(elements)), water_(water) {
  const State rest = rest_state(bodies);
  for (const Buoyancy& e : elements_) {
    const auto body = static_cast<std::size_t>(e.body);
    at_rest_ += hh::buoyancy_energy(immersion(e, bodies[body], rest.pose[body]), water);
  }
}

std::string BuoyancyKind::method() const {
  std::size_t triangles = 0, closed_forms = 0;
  for (const Buoyancy& e : elements_) {
    if (const auto* hull = std::get_if<hh::Hull>(e.shape.get()))
      triangles += hull->triangles().size();
    else
      ++closed_forms;
  }
  std::string text = "exact in still water at the true pose:";
  if (triangles > 0) text += fmt::format(" {} triangles cut", triangles);
  if (triangles > 0 && closed_forms > 0) text += ",";
  if (closed_forms > 0) text += fmt::format(" {} cylinders and spheres in closed form", closed_forms);
  return text;
}

hh::Immersion BuoyancyKind::immersion_of(const Buoyancy& element, const State& state) const {
  const auto body = static_cast<std::size_t>(element.body);
  try {
    return immersion(element, bodies_[body], state.pose[body]);
  } catch (const hydro::InputError& e) {
    throw hydro::NumericsError(fmt::format("{} at {:.6g} s: {}", bodies_[body].name(), state.time, e.rule()));
  }
}

void BuoyancyKind::add_load(const Instant& now, LoadSink& out) const {
  for (const Buoyancy& e : elements_) {
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    // A pose that Newton's iteration has lost has no load; the step is then halved.
    out.add(e.body, is_finite(pose) ? hh::buoyancy(immersion_of(e, now.state), water_, pose.centre)
                                    : Vector6(Vector6::Constant(std::numeric_limits<double>::quiet_NaN())));
  }
}

void BuoyancyKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const Buoyancy& e : elements_) {
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    if (is_finite(pose))
      out.add(e.body, e.body, -hh::buoyancy_stiffness(immersion_of(e, now.state), water_, pose.centre),
              Matrix6::Zero());
  }
}

double BuoyancyKind::stored(const State& state) const {
  double sum = 0;
  for (const Buoyancy& e : elements_) sum += hh::buoyancy_energy(immersion_of(e, state), water_);
  return sum;
}

EnergyFlow BuoyancyKind::energy(const Instant& now) const { return {.stored = stored(now.state) - at_rest_}; }

}  // namespace dynamics
