#include "hydro/cylinders/layout.hpp"

#include <cmath>
#include <numbers>

namespace hydro::cylinders {
namespace {

using Eigen::Vector3d;

void check_top(const Cylinder& c, const std::string& what, const WaterDepth& depth) {
  if (!c.top) return;
  require(std::isfinite(*c.top) && *c.top > 0, "{}: the depth of its top must be finite and positive, got {} m", what,
          *c.top);
  const double bottom = c.draught.value_or(depth.metres());
  if (*c.top >= bottom)
    throw InputError(
        fmt::format("{}: its top at {} m is not above its bottom at {} m", what, *c.top, bottom), {},
        "state the depth of the top, from still water down; leave it out if the cylinder pierces the surface");
}

void check_cylinder(const Cylinder& c, const std::string& what, const WaterDepth& depth) {
  require(c.centre.allFinite(), "{}: its centre is not finite", what);
  require(std::isfinite(c.radius) && c.radius > 0, "{}: the radius must be finite and positive, got {} m", what,
          c.radius);
  if (!c.draught) {
    if (depth.is_infinite())
      throw InputError(fmt::format("{}: it stands on the sea bed, but the water is infinitely deep", what), {},
                       "state a draught, or a finite depth of the water");
    return;
  }
  require(std::isfinite(*c.draught) && *c.draught > 0, "{}: the draught must be finite and positive, got {} m", what,
          *c.draught);
  if (*c.draught >= depth.metres())
    throw InputError(
        fmt::format("{}: its draught of {} m reaches the bottom at {} m", what, *c.draught, depth.metres()), {},
        "reduce the draught or make the water deeper; a cylinder that stands on the bottom has no draught");
}

double area(const Cylinder& c) { return std::numbers::pi * c.radius * c.radius; }
double bottom(const Cylinder& c, const WaterDepth& depth) { return c.draught.value_or(depth.metres()); }

}  // namespace

void check(const std::vector<CylinderBody>& bodies, const WaterDepth& depth) {
  require(!bodies.empty(), "there is no body");
  std::vector<std::pair<const Cylinder*, std::string>> all;
  for (const CylinderBody& body : bodies) {
    require(!body.cylinders.empty(), "body \"{}\" has no cylinder", body.name);
    require(body.reference_point.allFinite(), "the reference point of body \"{}\" is not finite", body.name);
    require(!body.centre_of_gravity || body.centre_of_gravity->allFinite(),
            "the centre of gravity of body \"{}\" is not finite", body.name);
    for (std::size_t i = 0; i < body.cylinders.size(); ++i)
      all.emplace_back(&body.cylinders[i], fmt::format("cylinder {} of body \"{}\"", i + 1, body.name));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [c, what] = all[i];
    check_cylinder(*c, what, depth);
    check_top(*c, what, depth);
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [other, other_what] = all[j];
      const double distance = (c->centre - other->centre).norm();
      if (distance > c->radius + other->radius) continue;
      throw InputError(fmt::format("{} and {} overlap or touch: their axes are {:.6g} m apart, their radii {:.6g} m "
                                   "and {:.6g} m",
                                   other_what, what, distance, other->radius, c->radius),
                       {}, "move them apart; a gap between cylinders is needed");
    }
  }
}

Displacement displacement(const CylinderBody& body, const WaterDepth& depth) {
  Displacement d{0, Vector3d::Zero()};
  for (const Cylinder& c : body.cylinders) {
    const double top = c.top.value_or(0), volume = area(c) * (bottom(c, depth) - top);
    d.volume += volume;
    d.centre_of_buoyancy += volume * Vector3d(c.centre.x(), c.centre.y(), -(bottom(c, depth) + top) / 2);
  }
  d.centre_of_buoyancy /= d.volume;
  return d;
}

Eigen::Matrix<double, 6, 6> restoring(const CylinderBody& body, const Water& water) {
  require(body.centre_of_gravity.has_value(), "body \"{}\" has no centre of gravity, so no restoring matrix",
          body.name);
  const Vector3d& P = body.reference_point;
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Cylinder& c : body.cylinders) {  // the waterplane
    require(c.draught.has_value(), "body \"{}\" stands on the sea bed, so it has no restoring matrix", body.name);
    if (c.top) continue;
    const double x = c.centre.x() - P.x(), y = c.centre.y() - P.y(), own = c.radius * c.radius / 4;
    const double S = water.density * water.gravity * area(c);
    C(2, 2) += S;
    C(2, 3) += S * y;
    C(2, 4) -= S * x;
    C(3, 3) += S * (y * y + own);
    C(3, 4) -= S * x * y;
    C(4, 4) += S * (x * x + own);
  }
  const Displacement d = displacement(body, water.depth);
  const double weight = water.density * water.gravity * d.volume;
  const Vector3d arm = d.centre_of_buoyancy - *body.centre_of_gravity;  // buoyancy acts up, weight down
  C(3, 3) += weight * arm.z();
  C(4, 4) += weight * arm.z();
  C(3, 2) = C(2, 3);
  C(4, 2) = C(2, 4);
  C(4, 3) = C(3, 4);
  C(3, 5) = -weight * arm.x();
  C(4, 5) = -weight * arm.y();
  return C;
}

}  // namespace hydro::cylinders
