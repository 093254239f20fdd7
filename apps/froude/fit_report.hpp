#pragma once
/// \file  One run of a Morison fit, and how fits are told, drawn and written. Private to apps/froude.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "froude/commands.hpp"
#include "froude/plot.hpp"
#include "scene/scene.hpp"

namespace froude {

using FitJson = nlohmann::ordered_json;  ///< results keep the order in which they are told

/// One file of a Morison fit.
struct FitRun {
  std::string name;          ///< of the file
  ::fit::Prepared prepared;  ///< what was fitted, and the steps that led there
  ::fit::MorisonFit fit;
  std::vector<::fit::Coefficient> asked;
};

::fit::Cylinder cylinder_of(const scene::FitScene& scene);
/// Reads, prepares and fits one file. \throws hydro::InputError with the file's name
FitRun fit_run(const scene::FitScene& scene, const std::filesystem::path& file);

FitJson as_json(const ::fit::Coefficient& c);

// The two kinds of fit.
void tell_runs(const scene::FitScene& scene, const std::vector<FitRun>& runs, const Console& console);
FitJson runs_as_json(const scene::FitScene& scene, const std::vector<FitRun>& runs);
plot::Figure runs_figure(const scene::FitScene& scene, const std::vector<FitRun>& runs);
void fit_towed(const scene::FitScene& scene, const FitArguments& arguments, const Console& console);

/// Writes what the arguments ask for: TOML, picture, JSON.
void deliver(const FitArguments& arguments, const Console& console, const FitJson& results,
             const plot::Figure& picture);

}  // namespace froude
