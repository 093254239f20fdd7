#include "compile/buoyancy.hpp"
#include "scene/placed.hpp"

#include <map>

namespace froude::compile {
namespace {

namespace hh = hydro::hydrostatics;
using dynamics::FloatingShape;
using hydro::InputError;
using Shapes = std::vector<std::shared_ptr<const FloatingShape>>;

hh::Hull read_hull(const scene::Buoyancy& given) {
  hh::TriangleMesh mesh = hh::read_mesh(given.mesh->value, {.unit = given.unit, .reverse = given.reverse});
  if (given.freeboard) mesh = hh::with_freeboard(std::move(mesh), *given.freeboard);
  return hh::Hull(std::move(mesh));
}

Shapes shapes_of(const scene::Buoyancy& given, std::vector<std::string>& notes) {
  Shapes shapes;
  const auto add = [&](FloatingShape shape) {
    shapes.push_back(std::make_shared<const FloatingShape>(std::move(shape)));
  };
  for (const auto& cylinder : given.cylinders) add(cylinder);
  for (const auto& sphere : given.spheres) add(sphere);
  if (!given.mesh) return shapes;
  scene::placed(given.mesh->place, [&] {
    hh::Hull hull = read_hull(given);
    for (const auto& note : hull.notes())
      notes.push_back(fmt::format("{}: {}", given.mesh->value.filename().string(), note));
    add(std::move(hull));
  });
  return shapes;
}

void require_dry_openings(const dynamics::Buoyancy& element, const Prepared& p, const hydro::Place& place) {
  const auto body = static_cast<std::size_t>(element.body);
  scene::placed(place,
                [&] { dynamics::immersion(element, p.bodies[body], dynamics::rest_state(p.bodies).pose[body]); });
}

/// Volume and its first moment about the centre of gravity of what a body has under water at rest.
struct Wet {
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

std::map<int, Wet> wet_at_rest(const Prepared& p) {
  const dynamics::State rest = dynamics::rest_state(p.bodies);
  std::map<int, Wet> wet;
  for (const auto& element : p.buoyancy) {
    const auto body = static_cast<std::size_t>(element.body);
    const auto im = dynamics::immersion(element, p.bodies[body], rest.pose[body]);
    Wet& sum = wet[element.body];
    sum.volume += im.volume;
    if (im.centre_of_buoyancy) sum.moment += im.volume * (*im.centre_of_buoyancy - rest.pose[body].centre);
  }
  return wet;
}

}  // namespace

void add_buoyancy(const scene::Scene& scene, Prepared& prepared) {
  std::map<std::string, Shapes> known;  // of the families of copies
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (!body.buoyancy) continue;
    const auto [at, is_new] = known.try_emplace(body.family);
    if (is_new) at->second = shapes_of(*body.buoyancy, prepared.notes);
    for (const auto& shape : at->second) {
      prepared.buoyancy.push_back({static_cast<int>(b), shape});
      require_dry_openings(prepared.buoyancy.back(), prepared, body.buoyancy->place);
    }
    if (!body.weight)
      prepared.notes.push_back(fmt::format(
          "{}: buoyancy acts but no weight does: what else holds it down must carry all of it (weight = true)",
          body.name));
  }
}

std::vector<std::string> out_of_balance(const Prepared& p) {
  std::vector<std::string> out;
  for (const auto& [index, wet] : wet_at_rest(p)) {
    const dynamics::RigidBody& body = p.bodies[static_cast<std::size_t>(index)];
    const double displaced = p.water.density * wet.volume;
    if (body.is_free(2) && std::abs(displaced - body.mass()) > 1e-4 * body.mass())
      out.push_back(
          fmt::format("{} displaces {:.7g} kg as placed and weighs {:.7g} kg", body.name(), displaced, body.mass()));
    const Eigen::Vector3d arm = wet.moment / std::max(wet.volume, 1e-300);
    if ((body.is_free(4) && std::abs(arm.x()) > 1e-4) || (body.is_free(3) && std::abs(arm.y()) > 1e-4))
      out.push_back(fmt::format("{}'s centre of buoyancy is ({:.6g}, {:.6g}) m beside its centre of gravity",
                                body.name(), arm.x(), arm.y()));
  }
  // Of a linear matrix only bodies on joints have it: others are taken to float.
  for (const dynamics::Hydrostatics& element : p.hydrostatics) {
    const dynamics::RigidBody& body = p.bodies[static_cast<std::size_t>(element.body)];
    const double mass = body.mass(), displaced = mass + element.lift / p.water.gravity;
    if (body.is_free(2) && std::abs(displaced - mass) > 1e-4 * mass)
      out.push_back(fmt::format("{} displaces {:.7g} kg as placed and weighs {:.7g} kg", body.name(), displaced, mass));
  }
  return out;
}

}  // namespace froude::compile
