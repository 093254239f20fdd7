#pragma once
/// \file  From the tables of a fit scene to the model of each kind. Private to apps/scene.
#include "scene/fit_scene.hpp"
#include "scene/record.hpp"

namespace froude::scene {

/// The tables that every kind of fit has.
struct FitTables {
  const Record& root;
  const std::filesystem::path& file;  ///< the scene

  const Record& data() const { return root.table("data"); }
  const Record& channels() const { return data().table("channels"); }
  const Record& model() const { return root.table("model"); }
  const Record& ask() const { return root.table("ask"); }
  double confidence() const { return ask().table("intervals").si("level"); }
};

// Each reads [model] of its kind with what [prepare] and [ask] have of it, and the channels that only it knows the
// rules of. \throws hydro::InputError, placed in the scene
FitModel read_morison(const FitTables& tables);
FitModel read_towing(const FitTables& tables);
FitModel read_decay(const FitTables& tables);
FitModel read_radiation(const FitTables& tables);
FitModel read_friction_ramp(const FitTables& tables);
FitModel read_motion(const FitTables& tables);

}  // namespace froude::scene
