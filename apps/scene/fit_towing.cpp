/// \file  Fits of kind "towing": drag at steady speed.
#include "scene/fit_tables.hpp"

namespace froude::scene {

Binding<TowingModel> towing_keys() {
  return Binding<TowingModel>("", "drag at steady speed").part(cylinder_keys(), &TowingModel::cylinder);
}

void finish(const FitTables& t, FitScene& scene, TowingModel&) {
  read_channels(t, {"speed", "force", "speed_sd", "force_sd"}, {"speed", "force"}, scene);
  for (const auto& c : wanted(t, {"cd", "cm", "ca"}, "[\"cd\"]", "ask for cd, cm or ca"))
    if (c.value != "cd")
      throw hydro::InputError(
          fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value), c.place,
          "ask for \"cd\" alone");
}

}  // namespace froude::scene
