#pragma once
/// \file  What fits of all kinds tell, in one form, and how it is printed. Private to apps/froude.
#include <fmt/format.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/diagnose.hpp"
#include "fit/runs.hpp"
#include "froude/commands.hpp"
#include "froude/plot.hpp"
#include "hydro/io/csv.hpp"
#include "scene/fit_scene.hpp"

namespace froude {

using FitJson = nlohmann::ordered_json;  ///< results keep the order in which they are told

/// A number that a fit tells: value, errors, interval, and why there is no value.
struct Estimate {
  ::fit::Coefficient coefficient;
  std::string unit = {};
  std::optional<::fit::Interval> profile = {};  ///< by profile likelihood, where asked for
  std::string key = {};                         ///< in the tree; empty: the coefficient's name
  FitJson facts = FitJson::object();            ///< beside it in the tree
  std::string more = {};                        ///< said of it in the text beside value and interval
};

/// What a fit tells, or a part of it: a run, runs together, the water. print() makes text of it, tree_of() the tree
/// that JSON and TOML are written from; each fact stands here once.
struct FitSummary {
  std::string key = {};      ///< in the tree of the whole; empty: what it tells stands there itself
  bool one_of_many = false;  ///< there the key is that of a list
  std::string heading = {};
  FitJson facts = FitJson::object();
  std::string group = {};  ///< under which the estimates stand in the tree; empty: beside the facts
  std::vector<Estimate> estimates = {};
  std::vector<std::string> remarks = {};            ///< lines of the text: correlation, residuals, the search
  std::optional<std::vector<std::string>> steps{};  ///< of the preparation
  std::vector<std::string> cautions = {};
  std::vector<FitSummary> parts = {};

  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    remarks.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  void warn(const std::string& caution) {
    if (!caution.empty()) cautions.push_back(caution);
  }
};

/// All that comes of a fit. Where it is `refused`, text and picture are all that is told.
struct FitOutcome {
  FitSummary summary;
  plot::Figure picture;
  std::string table = {};           ///< CSV
  std::exception_ptr refused = {};  ///< why no value may be told; null where they may
};

// Each reads the measurements, fits its model and tells what came of it. \throws hydro::InputError with the file's name
FitOutcome fit_model(const scene::FitScene& scene, const scene::MorisonModel& model);
FitOutcome fit_model(const scene::FitScene& scene, const scene::TowingModel& model);
FitOutcome fit_model(const scene::FitScene& scene, const scene::DecayModel& model);
FitOutcome fit_model(const scene::FitScene& scene, const scene::RadiationModel& model);
FitOutcome fit_model(const scene::FitScene& scene, const scene::FrictionRampModel& model);
FitOutcome fit_model(const scene::FitScene& scene, const scene::MotionModel& model);

/// The summary of a whole scene begins with what every kind has.
FitSummary begin_summary(const scene::FitScene& scene);
/// Harmonics and whiteness of the residuals; harmonics one by one where they have a `unit`.
void add_residuals(FitSummary& summary, const ::fit::ResidualReport& left, const std::string& unit = {});
/// One coefficient over several runs, tests …, each fitted alone, without a law.
FitSummary over_runs(const std::string& name, const std::string& unit, const ::fit::RandomEffects& law,
                     const std::string& runs, std::size_t count, double confidence);

void print(const FitSummary& summary, double confidence, std::ostream& out);
FitJson tree_of(const FitSummary& summary);
FitJson tree_of(const Estimate& estimate);

/// Columns of a table of runs that are carried along: name and text.
using RunLabels = std::vector<std::pair<std::string, std::string>>;
/// Those of one row that are not `taken` by the fit.
RunLabels run_labels(const hydro::io::CsvTable& table, std::size_t row, const std::vector<std::string>& taken);

std::string title_of(const scene::FitScene& scene);
/// There along the upper edge of a band about zero and back along the lower one: one line.
plot::Series band_outline(const std::string& name, const std::vector<double>& t, const std::vector<double>& half,
                          bool dashed);
/// Values with their intervals as bars, over `x`.
std::vector<plot::Series> with_bars(const std::string& name, double confidence, const std::vector<double>& x,
                                    const std::vector<const ::fit::Coefficient*>& y);

/// Prints, and writes what the arguments ask for: TOML, table, picture. \throws what `outcome` was refused for
void deliver(const FitOutcome& outcome, double confidence, const FitArguments& arguments, const Console& console);

}  // namespace froude
