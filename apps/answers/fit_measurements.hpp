#pragma once
/// \file  What kinds of fit share between a scene and libfit: columns by their roles, runs, and pictures of a record
///        with what was fitted to it. Private to apps.
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/fit_kind.hpp"
#include "fit/coefficient.hpp"
#include "fit/parts.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/source.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude::scene {

/// A file of measurements, by the roles that a scene gives its columns.
struct Measurements {
  const FitScene& scene;
  hydro::io::CsvTable table;

  /// A file that cannot be read is an error at `place`. \throws hydro::InputError as CsvTable::read, and for a column
  /// whose largest value is not measurable
  Measurements(const FitScene& of, const std::filesystem::path& file, const hydro::Place& place = {});
  /// SI, by the channel's line where it has one. \throws hydro::InputError as the table's column(), and for a line
  /// whose readings have another dimension than the column
  std::vector<double> column(const std::string& name) const;
  std::vector<double> column(const std::string& name, const hydro::Dimension& dimension) const;
  hydro::Dimension dimension(const std::string& name) const;
  /// The SI unit as the header writes it, "N", or else in base units.
  std::string unit(const std::string& name) const;

  /// SI; empty where no column has that role. \throws hydro::InputError for times that do not increase
  std::vector<double> of_role(const char* role, const hydro::Dimension& dimension) const;
  std::vector<double> time() const;
  std::vector<double> motion() const;  ///< angle, or else position
  std::vector<double> load() const;    ///< torque, or else the one force, with its sign as the scene has it
  /// All force channels with their calibrations, and the same of a run at rest.
  std::vector<::fit::ForceChannel> force_channels(const std::optional<Located<std::filesystem::path>>& zero_run) const;

 private:
  /// A force channel in the run at rest. \throws hydro::InputError for too few samples
  std::vector<double> rest_of(const std::string& name, const hydro::Dimension& dimension,
                              const Located<std::filesystem::path>& zero_run) const;
};
/// Error of the slope of a column's line, which is that of all files; zero where it has none.
::fit::SlopeError slope_error(const FitScene& scene, const std::string& column);
/// Of the column of the first of these roles that the scene names; zero where it names none.
::fit::SlopeError slope_error_of(const FitScene& scene, std::initializer_list<const char*> roles);
::fit::SlopeError motion_slope(const FitScene& scene);  ///< of Measurements::motion()
::fit::SlopeError load_slope(const FitScene& scene);    ///< of Measurements::load()

/// [data] calibration and zero, of kinds whose force may have several channels.
Key calibration_key();
Key zero_key();
std::vector<double> turned(std::vector<double> values, bool turn);

/// Runs of a scene: its files, or the rows of its table of runs, of which columns that are not `taken` are labels.
struct RunOfScene {
  ::fit::Source source;
  std::size_t row = 0;  ///< of the table of runs
};
std::vector<RunOfScene> runs_of(const FitScene& scene, const std::vector<std::string>& taken = {});

/// What was measured over time, what was fitted to it, and half widths of the bands about that, if it has any.
struct FittedRecord {
  std::string legend;  ///< of what was measured
  plot::Axis axis;
  double confidence;  ///< of the bands
  std::vector<double> time, measured, fitted, sample_band, fit_band;
};
/// A panel of both, and one of what is left.
Panels panels_of(const FittedRecord& record);
/// A long record as means over a 1000th of it each, which is all that a picture shows.
plot::Series thinned(const std::string& name, const std::vector<double>& x, const std::vector<double>& y);
/// Values with their intervals as bars, over `x`.
std::vector<plot::Series> with_bars(const std::string& name, double confidence, const std::vector<double>& x,
                                    const std::vector<const ::fit::Coefficient*>& y);

}  // namespace froude::scene
