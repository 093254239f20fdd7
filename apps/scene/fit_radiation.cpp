/// \file  Fits of kind "radiation": added mass and damping from forced oscillations.
#include "scene/fit_tables.hpp"

namespace froude::scene {

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
