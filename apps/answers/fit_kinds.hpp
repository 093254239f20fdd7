#pragma once
/// \file  Between a fit scene and libfit: what was measured becomes a problem of its kind, and a solution becomes
///        pictures, a table and, where it is refused, a remedy in the words of the scene. Private to apps.
#include <filesystem>
#include <string>
#include <vector>

#include "answers/plot.hpp"
#include "fit/problem/any.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "scene/fit_scene.hpp"

namespace froude {

// The measurements that a scene names, with what it knows and how it asks to fit them.
// \throws hydro::InputError with the file's name
::fit::morison::Problem problem_of(const scene::FitScene& scene, const scene::MorisonModel& model);
::fit::towing::Problem problem_of(const scene::FitScene& scene, const scene::TowingModel& model);
::fit::decay::Problem problem_of(const scene::FitScene& scene, const scene::DecayModel& model);
::fit::radiation::Problem problem_of(const scene::FitScene& scene, const scene::RadiationModel& model);
::fit::friction::Problem problem_of(const scene::FitScene& scene, const scene::FrictionRampModel& model);
::fit::motion::Problem problem_of(const scene::FitScene& scene, const scene::MotionModel& model);

// What was measured, what was fitted to it and what is left. No panel: there is nothing to see.
using Panels = std::vector<plot::Panel>;
Panels panels_of(const ::fit::morison::Problem& problem, const ::fit::morison::Solution& solution);
Panels panels_of(const ::fit::towing::Problem& problem, const ::fit::towing::Solution& solution);
Panels panels_of(const ::fit::decay::Problem& problem, const ::fit::decay::Solution& solution);
Panels panels_of(const ::fit::radiation::Problem& problem, const ::fit::radiation::Solution& solution);
Panels panels_of(const ::fit::friction::Problem& problem, const ::fit::friction::Solution& solution);
Panels panels_of(const ::fit::motion::Problem& problem, const ::fit::motion::Solution& solution);

// One row for each run of a solution that is not refused, as CSV; cells of what is not identifiable are empty. Kinds
// without a table have none.
std::string table_of(const ::fit::morison::Problem& problem, const ::fit::morison::Solution& solution);
std::string table_of(const ::fit::decay::Problem& problem, const ::fit::decay::Solution& solution);
std::string table_of(const ::fit::radiation::Problem& problem, const ::fit::radiation::Solution& solution);
std::string table_of(const auto&, const auto&) { return {}; }

/// Where in a scene a refusal has its cause, and what to write there.
struct Remedy {
  hydro::Place place = {};
  std::string text = {};
};
Remedy remedy_of(const scene::FitScene& scene, const ::fit::morison::Problem& problem,
                 const ::fit::morison::Solution& solution);
Remedy remedy_of(const scene::FitScene& scene, const ::fit::towing::Problem& problem,
                 const ::fit::towing::Solution& solution);
Remedy remedy_of(const scene::FitScene& scene, const ::fit::decay::Problem& problem,
                 const ::fit::decay::Solution& solution);
Remedy remedy_of(const scene::FitScene& scene, const ::fit::motion::Problem& problem,
                 const ::fit::motion::Solution& solution);
Remedy remedy_of(const scene::FitScene&, const auto&, const auto&) { return {}; }

/// A file of measurements, by the roles that a scene gives its columns.
struct Measurements {
  const scene::FitScene& scene;
  hydro::io::CsvTable table;

  Measurements(const scene::FitScene& of, const std::filesystem::path& file);
  /// SI; empty where no column has that role.
  std::vector<double> of_role(const char* role, const hydro::Dimension& dimension) const;
  std::vector<double> time() const;
  std::vector<double> motion() const;  ///< angle, or else position
  std::vector<double> load() const;    ///< torque, or else the one force, with its sign as the scene has it
};
std::vector<double> turned(std::vector<double> values, bool turn);

/// Runs of a scene: its files, or the rows of its table of runs, of which columns that are not `taken` are labels.
struct RunOfScene {
  ::fit::Source source;
  std::size_t row = 0;  ///< of the table of runs
};
std::vector<RunOfScene> runs_of(const scene::FitScene& scene, const std::vector<std::string>& taken = {});

/// What was measured over time, what was fitted to it, and half widths of the bands about that, if it has any.
struct FittedRecord {
  std::string legend;  ///< of what was measured
  plot::Axis axis;
  double confidence;  ///< of the bands
  std::vector<double> time, measured, fitted, sample_band, fit_band;
};
/// A panel of both, and one of what is left.
Panels panels_of(const FittedRecord& record);
/// Values with their intervals as bars, over `x`.
std::vector<plot::Series> with_bars(const std::string& name, double confidence, const std::vector<double>& x,
                                    const std::vector<const ::fit::Coefficient*>& y);

}  // namespace froude
