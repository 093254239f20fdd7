#include "answers/fit_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/channel_line.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/measurable.hpp"
#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

std::vector<std::pair<std::string, std::string>> labels_of(const hydro::io::CsvTable& table, std::size_t row,
                                                           const std::vector<std::string>& taken) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& name : table.names())
    if (std::find(taken.begin(), taken.end(), name) == taken.end())
      out.push_back(
          {name, table.is_text(name) ? table.text_column(name)[row] : fmt::format("{:.6g}", table.values(name)[row])});
  return out;
}

/// There along the upper edge of a band about zero and back along the lower one: one line.
plot::Series band_outline(const std::string& name, const std::vector<double>& t, const std::vector<double>& half,
                          bool dashed) {
  plot::Series out{name, t, half, true, false, dashed};
  out.x.push_back(t.back());
  out.y.push_back(std::numeric_limits<double>::quiet_NaN());  // the upper edge does not go on to the lower one
  for (std::size_t i = t.size(); i-- > 0;) {
    out.x.push_back(t[i]);
    out.y.push_back(-half[i]);
  }
  return out;
}

/// A table of measurements. \throws hydro::InputError, for a file that cannot be read at `place`, and for a column that
/// is beyond what is computed with
hydro::io::CsvTable read_measured(const std::filesystem::path& file, const hydro::Place& place = {}) {
  auto table = placed(place, [&] { return hydro::io::CsvTable::read(file); });
  for (const std::string& name : table.names()) {
    if (table.is_text(name) || !table.has_known_unit(name) || table.rows() == 0) continue;
    const std::vector<double>& values = table.column(name);
    const auto largest =
        std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (hydro::is_measurable(*largest)) continue;
    const auto row = static_cast<std::size_t>(largest - values.begin());
    throw hydro::InputError(fmt::format("the largest value of \"{}\" is {:.3g} {}: those that are computed with lie "
                                        "between 1e-30 and 1e30 in SI",
                                        name, *largest, table.dimension(name).si()),
                            table.place_of(name, row), "look at the exponents and at the unit of the column");
  }
  return table;
}

/// \throws hydro::InputError at the row whose time does not come after that of the row before
void require_increasing(const hydro::io::CsvTable& table, const std::string& column, const std::vector<double>& time) {
  const auto back = std::adjacent_find(time.begin(), time.end(), [](double a, double b) { return !(b > a); });
  if (back == time.end()) return;
  const auto row = static_cast<std::size_t>(back - time.begin()) + 1;
  throw hydro::InputError(
      fmt::format("the time \"{}\" does not increase: {:.6g} s comes after {:.6g} s", column, time[row], *back),
      table.place_of(column, row), "sort the rows, keep one of each instant, and write two runs in two files");
}

/// Loading cycles of a load cell: columns force and voltage, and cycle where there are several.
::fit::Calibration calibration_of(const Located<std::filesystem::path>& file, double confidence) {
  const auto table = read_measured(file.value, file.place);
  const auto &force = table.column("force", dim::force), &volt = table.column("voltage", dim::voltage);
  std::vector<::fit::LoadCycle> cycles(1);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (i > 0 && table.has("cycle") && table.column("cycle")[i] != table.column("cycle")[i - 1]) cycles.emplace_back();
    cycles.back().force.push_back(force[i]);
    cycles.back().voltage.push_back(volt[i]);
  }
  return placed({.file = file.value.string()}, [&] { return ::fit::calibrate(cycles, confidence); });
}

/// The line of a channel, with the dimensions of what it reads and what it gives.
struct LineOfChannel {
  ::fit::ChannelLine line;
  hydro::Dimension reading, reference;
  std::string reading_unit, reference_unit;  ///< SI, as the header writes them
};

const FitScene::Line* line_of(const FitScene& scene, const std::string& column) {
  for (const FitScene::Line& line : scene.lines)
    if (line.column == column) return &line;
  return nullptr;
}

std::string unit_of(const hydro::io::CsvTable& table, const std::string& column) {
  const std::string& text = table.unit_text(column);
  return !text.empty() && hydro::parse_unit(text).factor == 1 ? text : table.dimension(column).si();
}

/// As that of a load cell, so that a force counts all its errors.
::fit::Calibration calibration_of(const LineOfChannel& of) {
  const ::fit::ChannelLine& line = of.line;
  return {.slope = *line.slope.value,
          .offset = *line.offset.value,
          .slope_error = line.slope.standard_error,
          .offset_error = line.offset.standard_error,
          .slope_interval = line.slope.interval,
          .residual_deviation = line.residual_deviation,
          .nonlinearity = line.nonlinearity,
          .hysteresis = line.hysteresis.value_or(0),
          .pairs = line.pairs,
          .range = line.range,
          .unit = of.reading_unit + "/" + of.reference_unit};
}

LineOfChannel read_line(const FitScene::Line& of, double confidence) {
  return placed({.file = of.file.value.string()}, [&]() -> LineOfChannel {
    const auto table = read_measured(of.file.value, of.file.place);
    return {::fit::fit_channel_line({.reference = table.column(of.reference), .reading = table.column(of.reading)},
                                    confidence),
            table.dimension(of.reading), table.dimension(of.reference), unit_of(table, of.reading),
            unit_of(table, of.reference)};
  });
}

}  // namespace

std::vector<double> Measurements::column(const std::string& name) const {
  const FitScene::Line* of = line_of(scene, name);
  if (of == nullptr) return table.column(name);
  const LineOfChannel by = read_line(*of, scene.confidence);
  std::vector<double> out = table.column(name, by.reading);
  for (double& v : out) v = by.line.reference(v);
  return out;
}

std::vector<double> Measurements::column(const std::string& name, const hydro::Dimension& needed) const {
  const FitScene::Line* of = line_of(scene, name);
  if (of == nullptr) return table.column(name, needed);
  const hydro::Dimension given = dimension(name);
  if (!hydro::compatible(given, needed))
    throw hydro::InputError(
        fmt::format("the line of \"{}\" gives {}, and {} is needed", name, given.name(), needed.name()), of->place,
        fmt::format("its references want a unit such as {}", needed.si()));
  return column(name);
}

hydro::Dimension Measurements::dimension(const std::string& name) const {
  const FitScene::Line* of = line_of(scene, name);
  return of == nullptr ? table.dimension(name) : read_measured(of->file.value, of->file.place).dimension(of->reference);
}

std::string Measurements::unit(const std::string& name) const {
  const FitScene::Line* of = line_of(scene, name);
  return of == nullptr ? unit_of(table, name) : read_line(*of, scene.confidence).reference_unit;
}

::fit::SlopeError slope_error(const FitScene& scene, const std::string& column) {
  const FitScene::Line* of = line_of(scene, column);
  if (of == nullptr) return {};
  const ::fit::Coefficient slope = read_line(*of, scene.confidence).line.slope;
  const double size = std::abs(*slope.value);
  return {slope.standard_error / size, (slope.interval.high - slope.interval.low) / 2 / size};
}

::fit::SlopeError slope_error_of(const FitScene& scene, std::initializer_list<const char*> roles) {
  for (const char* role : roles)
    if (const auto at = scene.channels.find(role); at != scene.channels.end()) return slope_error(scene, at->second);
  return {};
}

::fit::SlopeError motion_slope(const FitScene& scene) { return slope_error_of(scene, {"angle", "position"}); }

::fit::SlopeError load_slope(const FitScene& scene) {
  return scene.force.empty() ? slope_error_of(scene, {"torque"}) : slope_error(scene, scene.force[0].column);
}

namespace {

struct Range {
  double low, high;
};

Range range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

/// Of the columns that have lines, in the order of these, over all runs.
std::vector<Range> ranges_met(const FitScene& scene) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<Range> out(scene.lines.size(), {none, -none});
  for (const auto& [source, row] : runs_of(scene)) {
    const Measurements run(scene, source.file);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Range one = range_of(run.table.column(scene.lines[i].column));
      out[i] = {std::min(out[i].low, one.low), std::max(out[i].high, one.high)};
    }
  }
  return out;
}

/// A caution where a column goes beyond the readings of its line by a tenth of their range; else "".
std::string beyond(const FitScene::Line& of, const Range& met, const std::string& unit) {
  const Range known = range_of(read_measured(of.file.value, of.file.place).column(of.reading));
  const double far = 0.1 * (known.high - known.low);
  if (met.low >= known.low - far && met.high <= known.high + far) return {};
  return fmt::format(
      "; caution: the line was taken from {:.4g} to {:.4g} {}, and the records go from {:.4g} to {:.4g}: beyond its "
      "points it is an extrapolation",
      known.low, known.high, unit, std::min(known.low, met.low), std::max(known.high, met.high));
}

}  // namespace

std::vector<std::string> told_lines(const FitScene& scene) {
  if (scene.lines.empty()) return {};
  const std::vector<Range> met = ranges_met(scene);
  std::vector<std::string> out;
  for (std::size_t i = 0; i < scene.lines.size(); ++i) {
    const FitScene::Line& of = scene.lines[i];
    const auto [line, reading, reference, reading_unit, reference_unit] = read_line(of, scene.confidence);
    out.push_back(fmt::format(
        "{} by {}: {:.5g} ± {:.2g} {}/{}{}; the error of the slope, {:.2g} %, is the same in all runs{}{}", of.column,
        of.file.value.filename().string(), *line.slope.value, line.slope.standard_error, reading_unit, reference_unit,
        line.hysteresis ? fmt::format(", hysteresis {:.2g} % of its range", 100 * *line.hysteresis) : std::string(),
        100 * line.slope.standard_error / std::abs(*line.slope.value), scene.of->said_of_line(scene, of.column),
        beyond(of, met[i], reading_unit)));
  }
  return out;
}

Measurements::Measurements(const FitScene& of, const std::filesystem::path& file, const hydro::Place& place)
    : scene(of), table(read_measured(file, place)) {}

std::vector<double> Measurements::of_role(const char* role, const hydro::Dimension& dimension) const {
  const auto at = scene.channels.find(role);
  if (at == scene.channels.end()) return {};
  std::vector<double> out = column(at->second, dimension);
  if (dimension == dim::time) require_increasing(table, at->second, out);
  return out;
}

std::vector<double> Measurements::time() const { return of_role("time", dim::time); }

std::vector<double> Measurements::motion() const {
  return scene.turns() ? of_role("angle", dim::angle) : of_role("position", dim::length);
}

std::vector<double> Measurements::load() const {
  if (scene.force.empty()) return of_role("torque", dim::moment);
  return turned(column(scene.force[0].column, dim::force), scene.force[0].turned);
}

std::vector<double> Measurements::rest_of(const std::string& name, const hydro::Dimension& dimension,
                                          const Located<std::filesystem::path>& zero_run) const {
  constexpr std::size_t fewest = 16;  // below, the scatter of the mean is not known
  std::vector<double> out = Measurements(scene, zero_run.value, zero_run.place).table.column(name, dimension);
  if (out.size() < fewest)
    throw hydro::InputError(
        fmt::format("the run at rest has {} samples, and a zero with its error needs {} at least", out.size(), fewest),
        {.file = zero_run.value.string()}, "record the channels at rest for some seconds");
  return out;
}

std::vector<::fit::ForceChannel> Measurements::force_channels(
    const std::optional<Located<std::filesystem::path>>& zero_run) const {
  std::vector<::fit::ForceChannel> out;
  for (const auto& f : scene.force) {
    const FitScene::Line* of = line_of(scene, f.column);
    if (of != nullptr) column(f.column, dim::force);  // refuses another dimension
    const hydro::Dimension dimension = of != nullptr   ? read_line(*of, scene.confidence).reading
                                       : f.calibration ? dim::voltage
                                                       : dim::force;
    ::fit::ForceChannel channel{f.column, turned(table.column(f.column, dimension), f.turned), {}};
    if (f.calibration) channel.calibration = calibration_of(*f.calibration, scene.confidence);
    if (of != nullptr) channel.calibration = calibration_of(read_line(*of, scene.confidence));
    // A channel that is turned round has its line through the same points with the voltage's sign changed.
    if (channel.calibration && f.turned) channel.calibration->offset *= -1;
    if (zero_run) channel.zero_run = turned(rest_of(f.column, dimension, *zero_run), f.turned);
    out.push_back(std::move(channel));
  }
  return out;
}

Key calibration_key() {
  return texts(
      "calibration",
      "one CSV for each force channel, with columns force and voltage (and cycle, where there are several): the "
      "channel is then in volts");
}

Key zero_key() { return text("zero", "CSV of a run at rest, with the same force channels: its mean is taken off"); }

std::vector<double> turned(std::vector<double> values, bool turn) {
  if (turn)
    for (double& v : values) v = -v;
  return values;
}

std::vector<RunOfScene> runs_of(const FitScene& scene, const std::vector<std::string>& taken) {
  std::vector<RunOfScene> out;
  for (const auto& file : scene.files) out.push_back({{file.value}});
  if (!scene.run_table) return out;
  const auto table = read_measured(scene.run_table->value, scene.run_table->place);
  if (table.rows() == 0)
    throw hydro::InputError("the table of runs has no rows", {.file = table.file()}, "write a row for each run");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& name = table.text_column("file")[row];
    const std::filesystem::path file = scene.run_table->value.parent_path() / name;
    if (!std::filesystem::is_regular_file(file))
      throw hydro::InputError(fmt::format("\"{}\" is no file", name), table.place_of("file", row),
                              fmt::format("files stand beside the table of runs, in {}", file.parent_path().string()));
    out.push_back({{file, labels_of(table, row, taken)}, row});
  }
  return out;
}

Panels panels_of(const FittedRecord& r) {
  std::vector<double> left = r.measured;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= r.fitted[i];
  plot::Panel both{.x = {"time", "s"},
                   .y = r.axis,
                   .series = {{r.legend, r.time, r.measured}, {"fitted", r.time, r.fitted, true, false, true}}};
  plot::Panel residual{
      .x = {"time", "s"}, .y = {"residual", r.axis.unit}, .series = {{"measured − fitted", r.time, left}}};
  if (!r.fit_band.empty()) {
    const std::string level = fmt::format("{:g} % band", 100 * r.confidence);
    residual.series.push_back(band_outline(level + " of a sample", r.time, r.sample_band, true));
    residual.series.push_back(band_outline(level + " of the fit", r.time, r.fit_band, false));
  }
  return {std::move(both), std::move(residual)};
}

plot::Series thinned(const std::string& name, const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t block = std::max<std::size_t>(1, x.size() / 1000);
  plot::Series out{name, {}, {}};
  for (std::size_t from = 0; from + block <= x.size(); from += block) {
    double sum_x = 0, sum_y = 0;
    for (std::size_t i = from; i < from + block; ++i) {
      sum_x += x[i];
      sum_y += y[i];
    }
    out.x.push_back(sum_x / static_cast<double>(block));
    out.y.push_back(sum_y / static_cast<double>(block));
  }
  return out;
}

std::vector<plot::Series> with_bars(const std::string& name, double confidence, const std::vector<double>& x,
                                    const std::vector<const ::fit::Coefficient*>& y) {
  plot::Series values{name, x, {}, false, true}, bars{fmt::format("{:g} % interval", 100 * confidence), {}, {}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    values.y.push_back(*y[i]->value);
    for (const double end : {y[i]->interval.low, y[i]->interval.high, std::numeric_limits<double>::quiet_NaN()}) {
      bars.x.push_back(x[i]);
      bars.y.push_back(end);
    }
  }
  return {values, bars};
}

}  // namespace froude::scene
