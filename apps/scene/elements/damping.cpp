/// \file  `[[damping]]`: linear and quadratic damping of a body's modes, as a decay tells them. (D136)
#include "dynamics/force/mode_damping.hpp"
#include "scene/element.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using dynamics::Vector6;

struct Damping {
  Vector6 linear = Vector6::Zero(), quadratic = Vector6::Zero();
};

/// Six numbers, one a mode; `translation` is the dimension of the first three.
Binding<Vector6> by_mode(const std::string& title, const std::string& meaning, const hydro::Dimension& translation,
                         const hydro::Dimension& rotation, const std::string& per) {
  Binding<Vector6> out(title, meaning);
  out.then([](const Record&, Vector6& values) { values.setZero(); });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < hydro::mode_names.size(); ++i) {
    const std::string name(hydro::mode_names[i]);
    const bool rotates = hydro::is_rotation(static_cast<hydro::Mode>(i));
    names.push_back(name);
    out.optional(positive(name, rotates ? rotation : translation, "load in " + name + " per " + per),
                 [i](const Value& v, Vector6& values) { values[static_cast<Eigen::Index>(i)] = v.number; });
  }
  return out.at_least_one_of(names);
}

const Binding<Damping>& damping_keys() {
  static const auto binding =
      Binding<Damping>(
          "[[damping]]",
          "linear and quadratic damping of a body's modes, forces at its origin: what a decay told, beside "
          "what other elements damp")
          .table("linear",
                 by_mode("[damping.linear]", "against the velocity of a mode", dim::damping, dim::rotational_damping,
                         "velocity"),
                 &Damping::linear)
          .optional()
          .table("quadratic",
                 by_mode("[damping.quadratic]", "against the velocity of a mode times its size",
                         dim::damping / dim::velocity, dim::rotational_damping / dim::angular_velocity,
                         "velocity times its size"),
                 &Damping::quadratic)
          .optional()
          .at_least_one_of({"linear", "quadratic"});
  return binding;
}

}  // namespace

std::unique_ptr<const ElementTable> damping_element() {
  return on_bodies<Damping>("damping", damping_keys(), [](const std::vector<OnBody<Damping>>& all, const Site& site) {
    std::vector<dynamics::ModeDamping> out;
    for (const auto& [name, body, value] : all)
      out.push_back({body, -site.bodies[static_cast<std::size_t>(body)].properties().centre_of_gravity.xyz,
                     value.linear, value.quadratic});
    return std::make_unique<dynamics::ModeDampingKind>(std::move(out));
  });
}

}  // namespace froude::scene
