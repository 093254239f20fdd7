#include "answers/fit_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

std::vector<std::pair<std::string, std::string>> labels_of(const hydro::io::CsvTable& table, std::size_t row,
                                                           const std::vector<std::string>& taken) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& name : table.names())
    if (std::find(taken.begin(), taken.end(), name) == taken.end())
      out.push_back(
          {name, table.is_text(name) ? table.text_column(name)[row] : fmt::format("{:.6g}", table.column(name)[row])});
  return out;
}

/// There along the upper edge of a band about zero and back along the lower one: one line.
plot::Series band_outline(const std::string& name, const std::vector<double>& t, const std::vector<double>& half,
                          bool dashed) {
  plot::Series out{name, t, half, true, false, dashed};
  for (std::size_t i = t.size(); i-- > 0;) {
    out.x.push_back(t[i]);
    out.y.push_back(-half[i]);
  }
  return out;
}

}  // namespace

Measurements::Measurements(const FitScene& of, const std::filesystem::path& file)
    : scene(of), table(hydro::io::CsvTable::read(file)) {}

std::vector<double> Measurements::of_role(const char* role, const hydro::Dimension& dimension) const {
  const auto at = scene.channels.find(role);
  if (at == scene.channels.end()) return {};
  return table.column(at->second, dimension);
}

std::vector<double> Measurements::time() const { return of_role("time", dim::time); }

std::vector<double> Measurements::motion() const {
  return scene.turns() ? of_role("angle", dim::angle) : of_role("position", dim::length);
}

std::vector<double> Measurements::load() const {
  if (scene.force.empty()) return of_role("torque", dim::moment);
  return turned(table.column(scene.force[0].column, dim::force), scene.force[0].turned);
}

std::vector<double> turned(std::vector<double> values, bool turn) {
  if (turn)
    for (double& v : values) v = -v;
  return values;
}

std::vector<RunOfScene> runs_of(const FitScene& scene, const std::vector<std::string>& taken) {
  std::vector<RunOfScene> out;
  for (const auto& file : scene.files) out.push_back({{file.value}});
  if (!scene.run_table) return out;
  const auto table = hydro::io::CsvTable::read(scene.run_table->value);
  for (std::size_t row = 0; row < table.rows(); ++row)
    out.push_back(
        {{scene.run_table->value.parent_path() / table.text_column("file")[row], labels_of(table, row, taken)}, row});
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
