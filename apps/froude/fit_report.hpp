#pragma once
/// \file  One run of a Morison fit, and how fits are told, drawn and written. Private to apps/froude.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fit/diagnose.hpp"
#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "fit/runs.hpp"
#include "froude/commands.hpp"
#include "froude/plot.hpp"
#include "hydro/io/csv.hpp"
#include "scene/fit_scene.hpp"

namespace froude {

using FitJson = nlohmann::ordered_json;  ///< results keep the order in which they are told

/// A fit repeated with one choice made otherwise.
struct MorisonVariant {
  std::string what;    ///< "low pass at 2.33 Hz"
  double cd, inertia;  ///< changes
};

/// Columns of a table of runs that are carried along: name and text.
using RunLabels = std::vector<std::pair<std::string, std::string>>;
/// Those of one row that are not `taken` by the fit.
RunLabels run_labels(const hydro::io::CsvTable& table, std::size_t row, const std::vector<std::string>& taken);

/// One file of a Morison fit.
struct MorisonRun {
  std::string name;  ///< of the file
  RunLabels labels;
  ::fit::Cylinder cylinder;
  ::fit::Prepared prepared;  ///< what was fitted, and the steps that led there
  ::fit::MorisonFit fit;
  ::fit::ResidualReport left;  ///< in the residuals
  ::fit::FourierAverages fourier;
  std::vector<::fit::CycleFit> cycles;   ///< where asked for
  std::vector<MorisonVariant> variants;  ///< where asked for
  std::vector<::fit::Coefficient> asked;
};

/// The law of one coefficient over all runs.
struct CoefficientLaw {
  std::string coefficient;                 ///< "cd", "ca", "cm"
  std::vector<::fit::RandomEffects> laws;  ///< the one asked for, or all, best first
  std::size_t runs, left_out;              ///< fitted; not identifiable
};

FitJson as_json(const ::fit::Coefficient& c);
void tell_runs(const scene::MorisonModel& model, const std::vector<MorisonRun>& runs, const Console& console);
void tell_laws(const std::vector<CoefficientLaw>& laws, const Console& console);
FitJson runs_as_json(const scene::FitScene& scene, const scene::MorisonModel& model,
                     const std::vector<MorisonRun>& runs, const std::vector<CoefficientLaw>& laws);
/// Force and residual of each run; of three runs and more, the coefficients over KC and the map of KC and Re.
plot::Figure runs_figure(const scene::FitScene& scene, const std::vector<MorisonRun>& runs,
                         const std::vector<CoefficientLaw>& laws);
/// There along the upper edge of a band about zero and back along the lower one: one line.
plot::Series band_outline(const std::string& name, const std::vector<double>& t, const std::vector<double>& half,
                          bool dashed);
/// One row for each run, as CSV; cells of what is not identifiable are empty.
std::string runs_table(const std::vector<MorisonRun>& runs);

// Each reads the measurements, fits its model and tells what came of it. \throws hydro::InputError with the file's name
void fit_model(const scene::FitScene& scene, const scene::MorisonModel& model, const FitArguments& arguments,
               const Console& console);
void fit_model(const scene::FitScene& scene, const scene::TowingModel& model, const FitArguments& arguments,
               const Console& console);
void fit_model(const scene::FitScene& scene, const scene::DecayModel& model, const FitArguments& arguments,
               const Console& console);
void fit_model(const scene::FitScene& scene, const scene::RadiationModel& model, const FitArguments& arguments,
               const Console& console);
void fit_model(const scene::FitScene& scene, const scene::FrictionRampModel& model, const FitArguments& arguments,
               const Console& console);
void fit_model(const scene::FitScene& scene, const scene::MotionModel& model, const FitArguments& arguments,
               const Console& console);

/// Writes what the arguments ask for: TOML, picture, JSON.
void deliver(const FitArguments& arguments, const Console& console, const FitJson& results,
             const plot::Figure& picture);

}  // namespace froude
