/// \file  `[[wind]]`: the drag of a steady wind on an area of a body. (D135)
#include "dynamics/force/wind.hpp"

#include "dynamics/force/point_force.hpp"
#include "scene/element.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

struct Wind {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();          ///< body axes, m
  double area = 0, drag = 0, density = 0;                ///< m², 1, kg/m³
  double speed = 0, reference = 0, exponent = 0;         ///< m/s, m, 1
  hydro::Angle heading = hydro::Angle::from_radians(0);  ///< where the wind goes
  Place place;
};

const Binding<Wind>& wind_keys() {
  static const auto wind =
      Binding<Wind>("[[wind]]", "the drag of a steady wind on an area above the water")
          .key(vector("at", dim::length, "where the wind acts, body axes: the centre of the area"), &Wind::at)
          .key(positive("area", dim::area, "that the wind meets"), &Wind::area)
          .key(number("drag", "C, on that area").positive().or_default("1.0", "between a cylinder and a plate"),
               &Wind::drag)
          .key(positive("speed", dim::velocity, "of the wind at the reference height"), &Wind::speed)
          .key(quantity("heading", dim::angle, "where the wind goes, from +x towards +y"), &Wind::heading)
          .key(positive("reference_height", dim::length, "above still water")
                   .or_default("10 m", "at which winds are told"),
               &Wind::reference)
          .key(number("exponent", "of the speed with height, (z/reference_height)^exponent; some 0.12 over the sea")
                   .within(Limit::fraction)
                   .or_default("0", "the same at all heights"),
               &Wind::exponent)
          .key(positive("air_density", dim::density, "of the air")
                   .or_default("1.225 kg/m^3", "dry air of 15 degrees at sea level, ISO 2533"),
               &Wind::density)
          .place(&Wind::place);
  return wind;
}

/// As it blows where the body is placed: heights above still water do not follow its motion.
dynamics::WindDrag law_of(const Wind& wind, const dynamics::RigidBody& body) {
  const double height = body.properties().rest_position.xyz.z() + wind.at.z();
  const double speed =
      placed(wind.place, [&] { return dynamics::wind_at(height, wind.speed, wind.reference, wind.exponent); });
  return {speed * Eigen::Vector3d(std::cos(wind.heading.radians()), std::sin(wind.heading.radians()), 0),
          0.5 * wind.density * wind.drag * wind.area};
}

}  // namespace

std::unique_ptr<const ElementTable> wind_element() {
  return on_bodies<Wind>("wind", wind_keys(), [](const std::vector<OnBody<Wind>>& all, const Site& site) {
    std::vector<dynamics::AtPoint<dynamics::WindDrag>> out;
    for (const auto& [name, body, wind] : all)
      out.push_back({site.point(body, wind.at), law_of(wind, site.bodies[static_cast<std::size_t>(body)]), name});
    return std::make_unique<dynamics::PointForceKind<dynamics::WindDrag>>(
        std::move(out), dynamics::PointForceWords{"wind", "quadratic drag of the air at the velocity of its point"});
  });
}

}  // namespace froude::scene
