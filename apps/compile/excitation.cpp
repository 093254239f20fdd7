#include "compile/excitation.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "compile/waves.hpp"
#include "dynamics/force/turning_excitation.hpp"
#include "dynamics/force/wave_loads.hpp"
#include "hydro/base/error.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

using dynamics::frequency::PotentialGroup;
using hydro::InputError;
using hydro::waves::Component;
using scene::Scene;

const scene::Turning* turning_of(const Scene& scene, const PotentialGroup& group) {
  const scene::Turning* found = nullptr;
  for (const int b : group.bodies)
    if (const auto& turning = scene.bodies[static_cast<std::size_t>(b)].hydrodynamics->turning) found = &*turning;
  if (found != nullptr && group.bodies.size() > 1)
    throw InputError("bodies that feel each other's waves cannot turn each by itself", found->place,
                     "take interaction = \"self\" in [body.hydrodynamics], or leave `turning` out");
  return found;
}

dynamics::Excitation as_placed(const PotentialGroup& g, const hydro::waves::Sea& sea, const StepGrid& grid,
                               double ramp) {
  Eigen::MatrixXcd amplitudes(6 * static_cast<Eigen::Index>(g.bodies.size()),
                              static_cast<Eigen::Index>(sea.components().size()));
  Eigen::Index column = 0;
  for (const auto& c : sea.components())
    amplitudes.col(column++) = elevation_at_origin(c) * g.table.excitation(c.omega, c.heading);
  return {g.bodies, signals(sea, amplitudes, grid, ramp)};
}

/// Of one component on a body that has turned by `yaw` about the vertical through `centre`, global axes. (D121)
Eigen::Matrix<std::complex<double>, 6, 1> turned(const PotentialGroup& g, const Component& c,
                                                 const Eigen::Vector2d& centre, double yaw) {
  const auto way = [&](double heading) {
    return c.k * (centre.x() * std::cos(heading) + centre.y() * std::sin(heading));
  };
  const double seen = c.heading - yaw;
  const Eigen::Matrix<std::complex<double>, 6, 1> of_body =
      std::polar(1.0, way(seen) - way(c.heading)) * g.table.excitation(c.omega, seen);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Eigen::Matrix<std::complex<double>, 6, 1> out;
  out << R * of_body.head<3>(), R * of_body.tail<3>();
  return out;
}

dynamics::TurningExcitation turning(const PotentialGroup& g, const dynamics::RigidBody& body,
                                    const scene::Turning& asked, const hydro::waves::Sea& sea, const StepGrid& grid,
                                    double ramp) {
  const int yaws = static_cast<int>(std::ceil((asked.to - asked.from) / asked.spacing - 1e-9)) + 1;
  const double spacing = (asked.to - asked.from) / (yaws - 1);
  Eigen::MatrixXcd amplitudes(6 * yaws, static_cast<Eigen::Index>(sea.components().size()));
  scene::placed(asked.place, [&] {
    for (int k = 0; k < yaws; ++k) {
      Eigen::Index column = 0;
      for (const auto& c : sea.components())
        amplitudes.block<6, 1>(6 * k, column++) =
            elevation_at_origin(c) * turned(g, c, body.rest_centre().head<2>(), asked.from + k * spacing);
    }
  });
  return {.name = body.name(),
          .body = g.bodies.front(),
          .first_yaw = asked.from,
          .spacing = spacing,
          .yaws = yaws,
          .load = signals(sea, amplitudes, grid, ramp),
          .time_constant = asked.slower_than / (2 * std::numbers::pi)};
}

}  // namespace

void add_excitation(const Scene& scene, const Prepared& p, const hydro::waves::Sea& sea, const StepGrid& grid,
                    std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces) {
  const double ramp = scene.waves->ramp;
  std::vector<dynamics::Excitation> placed;
  std::vector<dynamics::TurningExcitation> turning_ones;
  for (const auto& g : p.groups) {
    if (!g.excitation) continue;
    if (const auto* asked = turning_of(scene, g))
      turning_ones.push_back(turning(g, p.bodies[static_cast<std::size_t>(g.bodies.front())], *asked, sea, grid, ramp));
    else
      placed.push_back(as_placed(g, sea, grid, ramp));
  }
  if (!placed.empty()) forces.push_back(std::make_unique<dynamics::ExcitationKind>(std::move(placed)));
  if (!turning_ones.empty())
    forces.push_back(std::make_unique<dynamics::TurningExcitationKind>(std::move(turning_ones)));
}

}  // namespace froude::compile
