#include "scene/fit_tables.hpp"

#include <algorithm>
#include <array>

namespace froude::scene {

namespace dim = hydro::dim;
using ::fit::Cylinder;
using ::fit::RestoredBody;

Binding<Cylinder> cylinder_keys() {
  const auto water =
      Binding<Cylinder>("[model.water]", "the water of the experiment")
          .key(positive("density", dim::density, "of the water"), &Cylinder::density)
          .optional(positive("viscosity", dim::kinematic_viscosity, "kinematic; gives the Reynolds number"),
                    &Cylinder::viscosity);
  return Binding<Cylinder>("", "")
      .key(positive("diameter", dim::length, "of the cylinder"), &Cylinder::diameter)
      .key(positive("length", dim::length, "of the cylinder in the water"), &Cylinder::length)
      .table("water", water)
      .needed();
}

Binding<RestoredBody> restored_body() {
  return Binding<RestoredBody>("[model.body]",
                               "decay, radiation: what is known of the body, so that the water's part can be told")
      .optional(quantity("mass", dim::mass, "of the body, for a position").within(Limit::not_negative),
                &RestoredBody::mass)
      .optional(
          quantity("inertia", dim::inertia, "of the body about its axis, for an angle").within(Limit::not_negative),
          &RestoredBody::mass)
      .optional(
          quantity("stiffness", dim::stiffness, "of water and springs, for a position").within(Limit::not_negative),
          &RestoredBody::stiffness)
      .optional(quantity("rotational_stiffness", dim::rotational_stiffness, "of water and springs, for an angle")
                    .within(Limit::not_negative),
                &RestoredBody::stiffness)
      .optional(number("mass_error", "standard uncertainty of mass or inertia, relative").positive(),
                &RestoredBody::mass_error)
      .optional(number("stiffness_error", "standard uncertainty of the stiffness, relative").positive(),
                &RestoredBody::stiffness_error)
      .exactly_one_of({"mass", "inertia"})
      .exactly_one_of({"stiffness", "rotational_stiffness"});
}

void check_restored(const FitTables& t) {
  const Record& body = t.model().table("body");
  const bool turns = t.channels().has("angle");
  for (const char* other : turns ? std::array{"mass", "stiffness"} : std::array{"inertia", "rotational_stiffness"})
    if (body.has(other))
      throw body.wrong(other, fmt::format("does not go with the channel {}", turns ? "angle" : "position"),
                       turns ? "give inertia and rotational_stiffness" : "give mass and stiffness");
}

const std::vector<Located<std::string>>& wanted(const FitTables& t, const std::vector<std::string>& known,
                                                const char* example, const char* remedy) {
  if (!t.ask().has("coefficients"))
    throw t.ask().refused("needs the key \"coefficients\"", fmt::format("add coefficients = {}", example));
  const Value& asked = t.ask()["coefficients"];
  for (const auto& one : asked.texts)
    if (std::find(known.begin(), known.end(), one.value) == known.end())
      throw hydro::InputError(fmt::format("{}: \"{}\" {}", asked.name, one.value, not_of_kind(t.model().text("kind"))),
                              one.place, remedy);
  return asked.texts;
}

}  // namespace froude::scene
