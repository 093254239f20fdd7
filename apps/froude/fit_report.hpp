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
struct FitVariant {
  std::string what;    ///< "low pass at 2.33 Hz"
  double cd, inertia;  ///< changes
};

/// Columns of a table of runs that are carried along: name and text.
using RunLabels = std::vector<std::pair<std::string, std::string>>;
/// Those of one row that are not `taken` by the fit.
RunLabels run_labels(const hydro::io::CsvTable& table, std::size_t row, const std::vector<std::string>& taken);

/// One file of a Morison fit.
struct FitRun {
  std::string name;  ///< of the file
  RunLabels labels;
  ::fit::Cylinder cylinder;
  ::fit::Prepared prepared;  ///< what was fitted, and the steps that led there
  ::fit::MorisonFit fit;
  ::fit::ResidualReport left;  ///< in the residuals
  ::fit::FourierAverages fourier;
  std::vector<::fit::CycleFit> cycles;  ///< where asked for
  std::vector<FitVariant> variants;     ///< where asked for
  std::vector<::fit::Coefficient> asked;
};

/// The law of one coefficient over all runs.
struct FitLaw {
  std::string coefficient;                 ///< "cd", "ca", "cm"
  std::vector<::fit::RandomEffects> laws;  ///< the one asked for, or all, best first
  std::size_t runs, left_out;              ///< fitted; not identifiable
};

/// Half the window of [prepare.outliers] in samples; 0 where outliers are not looked for.
int outlier_half_window(const scene::FitScene::Prepare& p, double step);
::fit::Cylinder cylinder_of(const scene::FitScene& scene);
/// Reads, prepares and fits all runs. \throws hydro::InputError with the file's name
std::vector<FitRun> fit_all(const scene::FitScene& scene);
std::vector<FitLaw> laws_of(const scene::FitScene& scene, const std::vector<FitRun>& runs);

FitJson as_json(const ::fit::Coefficient& c);
void tell_runs(const scene::FitScene& scene, const std::vector<FitRun>& runs, const Console& console);
void tell_laws(const std::vector<FitLaw>& laws, const Console& console);
FitJson runs_as_json(const scene::FitScene& scene, const std::vector<FitRun>& runs, const std::vector<FitLaw>& laws);
/// Force and residual of each run; of three runs and more, the coefficients over KC and the map of KC and Re.
plot::Figure runs_figure(const scene::FitScene& scene, const std::vector<FitRun>& runs,
                         const std::vector<FitLaw>& laws);
/// There along the upper edge of a band about zero and back along the lower one: one line.
plot::Series band_outline(const std::string& name, const std::vector<double>& t, const std::vector<double>& half,
                          bool dashed);
/// One row for each run, as CSV; cells of what is not identifiable are empty.
std::string runs_table(const std::vector<FitRun>& runs);

// The other kinds of fit.
void fit_decays(const scene::FitScene& scene, const FitArguments& arguments, const Console& console);
void fit_friction_ramps(const scene::FitScene& scene, const FitArguments& arguments, const Console& console);
void fit_radiations(const scene::FitScene& scene, const FitArguments& arguments, const Console& console);
void fit_motions(const scene::FitScene& scene, const FitArguments& arguments, const Console& console);
void fit_towed(const scene::FitScene& scene, const FitArguments& arguments, const Console& console);

/// Writes what the arguments ask for: TOML, picture, JSON.
void deliver(const FitArguments& arguments, const Console& console, const FitJson& results,
             const plot::Figure& picture);

}  // namespace froude
