/// \file  Fits of kind "radiation": added mass and damping from forced oscillations.
#include <array>

#include "scene/fit_tables.hpp"

namespace froude::scene {

Binding<::fit::RestoredBody> restored_body() {
  using R = ::fit::RestoredBody;
  namespace dim = hydro::dim;
  return Binding<R>("[model.body]", "decay, radiation: what is known of the body, so that the water's part can be told")
      .optional(quantity("mass", dim::mass, "of the body, for a position").within(Limit::not_negative), &R::mass)
      .optional(
          quantity("inertia", dim::inertia, "of the body about its axis, for an angle").within(Limit::not_negative),
          &R::mass)
      .optional(
          quantity("stiffness", dim::stiffness, "of water and springs, for a position").within(Limit::not_negative),
          &R::stiffness)
      .optional(quantity("rotational_stiffness", dim::rotational_stiffness, "of water and springs, for an angle")
                    .within(Limit::not_negative),
                &R::stiffness)
      .optional(number("mass_error", "standard uncertainty of mass or inertia, relative").positive(), &R::mass_error)
      .optional(number("stiffness_error", "standard uncertainty of the stiffness, relative").positive(),
                &R::stiffness_error)
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

Binding<RadiationModel> radiation_keys() {
  return Binding<RadiationModel>("",
                                 "added mass and damping from forced oscillations in still water, one file each, and "
                                 "the poles of the memory that belongs to them")
      .table("body", restored_body(), &RadiationModel::body);
}

void finish(const FitTables& t, FitScene& scene, RadiationModel&) {
  read_channels(t, {"time", "position", "angle", "force", "torque"}, {"time"}, scene);
  const Record& channels = t.channels();
  if (channels.has("angle") == channels.has("position"))
    throw channels.refused("needs either position or angle for a fit of kind \"radiation\"",
                           "name the column of the motion");
  if (channels.has("position") != channels.has("force") || channels.has("angle") != channels.has("torque"))
    throw channels.refused("needs force beside a position, torque beside an angle", "name what moved the body");
  check_restored(t);
}

}  // namespace froude::scene
