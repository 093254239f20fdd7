/// \file  Fits of kind "towing": drag of a cylinder at steady speed.
#include "scene/fit_tables.hpp"

namespace froude::scene {

Binding<::fit::Cylinder> cylinder_keys() {
  namespace dim = hydro::dim;
  using ::fit::Cylinder;
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

Binding<TowingModel> towing_keys() {
  return Binding<TowingModel>("", "drag at steady speed").part(cylinder_keys(), &TowingModel::cylinder);
}

void finish(const FitTables& t, FitScene& scene, TowingModel& towing) {
  towing.confidence = scene.confidence;
  read_channels(t, {"speed", "force", "speed_sd", "force_sd"}, {"speed", "force"}, scene);
  for (const auto& c : wanted(t, {"cd", "cm", "ca"}, "[\"cd\"]", "ask for cd, cm or ca"))
    if (c.value != "cd")
      throw hydro::InputError(
          fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value), c.place,
          "ask for \"cd\" alone");
}

}  // namespace froude::scene
