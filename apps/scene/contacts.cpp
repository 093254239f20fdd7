/// \file  `[[contact]]`
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using dynamics::Ball, dynamics::Box, dynamics::HalfSpace, dynamics::Rod, dynamics::Shape;

/// What one table says: shapes of the first body, each a contact of its own, and one of the second.
struct Shapes {
  std::vector<Shape> first;
  Shape only;  ///< of the first, of kind "rods"
  Shape second;
  double restitution, friction = 0;
};

/// A ball where both ends are one point.
Binding<Shape> rod() {
  return Binding<Shape>("a rod of [[contact]]", "a cylinder with round ends")
      .key(vector("from", dim::length, "middle of one end, body axes (ground: global axes)"))
      .key(vector("to", dim::length, "middle of the other end"))
      .key(positive("diameter", dim::length, "of the rod"))
      .then([](const Record& record, Shape& out) {
        const Eigen::Vector3d from = record.vector("from"), to = record.vector("to");
        const double radius = record.si("diameter") / 2;
        out = from == to ? Shape(Ball{from, radius}) : Shape(Rod{from, to, radius});
      });
}

Binding<Shapes> balls_against(const std::string& meaning) {
  return Binding<Shapes>("", meaning)
      .keys({points("points", "on the first body, body axes; each ± makes two, each a contact of its own"),
             positive("radius", dim::length, "of a ball about each point; left out: the point itself").optional()})
      .then([](const Record& record, Shapes& out) {
        const double radius = record.has("radius") ? record.si("radius") : 0;
        for (const Eigen::Vector3d& p : record["points"].points.front()) out.first.push_back(Ball{p, radius});
      });
}

Binding<HalfSpace> half_space() {
  return Binding<HalfSpace>("", "")
      .key(vector("at", dim::length, "a point of the plane, axes of the second (ground: global)"), &HalfSpace::point)
      .key(direction("normal", "out of the second, its axes (ground: global)"), &HalfSpace::outward)
      .then([](const Record&, HalfSpace& out) { out.outward.normalize(); });
}

Binding<Box> box() {
  return Binding<Box>("", "")
      .keys({vector("from", dim::length, "one corner, axes of the second (ground: global)"),
             vector("to", dim::length, "the corner opposite to it")})
      .then([](const Record& record, Box& out) {
        const Eigen::Vector3d from = record.vector("from"), to = record.vector("to");
        out.centre = (from + to) / 2;
        out.half = (to - from).cwiseAbs() / 2;
        if (!(out.half.minCoeff() > 0))
          throw record.wrong("to", "makes a box without volume", "give the corner opposite to `from`");
      });
}

Binding<Shapes> rods() {
  return Binding<Shapes>("", "a cylinder with round ends of the first against one of the second")
      .table("first", rod(), &Shapes::only)
      .table("second", rod(), &Shapes::second)
      .then([](const Record&, Shapes& out) { out.first = {out.only}; });
}

const Binding<Shapes>& contact() {
  static const auto binding =
      Binding<Shapes>("[[contact]]",
                      "shapes of two bodies that do not pass through each other; they touch, slip, stick and part")
          .keys({name_key("contact", "of the contact"), between_key()})
          .key(number("restitution", "share of the speed of approach that comes back, 0 to 1").within(Limit::fraction),
               &Shapes::restitution)
          .key(number("friction", "Coulomb's coefficient; left out: smooth").positive().optional(), &Shapes::friction)
          .key(text("kind", "of the second body's shape"))
          .variant("plane", balls_against("points or balls of the first against a plane of the second: a wall, a quay, "
                                          "a floor")
                                .part(half_space(), &Shapes::second))
          .variant(
              "box",
              balls_against("points or balls of the first against a box of the second").part(box(), &Shapes::second))
          .variant("rods", rods());
  return binding;
}

}  // namespace

const Table& contact_table() { return contact().table(); }

void build_contacts(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("contact")) {
    const Shapes made = contact().read(record);
    const auto pairs = read_between(record, scene.bodies, GroundFirst::refused);
    const auto name = names.of(record, pairs.size() * made.first.size());
    std::size_t n = 0;
    for (const Between& pair : pairs)
      for (const Shape& first : made.first)
        scene.contacts.push_back(
            {name[n++], *pair.first, pair.second, {first, made.second}, made.restitution, made.friction});
  }
}

}  // namespace froude::scene
