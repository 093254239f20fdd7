// A run in time: series, their statistics and accuracy, and the plan of its scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "froude/scene.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/trial.hpp"
#include "hydro/signal/zero_crossings.hpp"
#include "report/contents.hpp"
#include "report/spectra_of_run.hpp"

namespace froude::html {
namespace {

namespace fs = std::filesystem;
namespace hs = hydro::signal;
using hydro::io::Hdf5Reader;

constexpr std::size_t fewest_points = 64;  // of a series: less shows nothing

/// Samples from which statistics count.
std::size_t first_counted(const RunResult& run, const Options& options, const fs::path& path) {
  const auto at = std::lower_bound(run.time.begin(), run.time.end(), options.from);
  if (run.time.end() - at < 2)
    throw hydro::InputError(
        fmt::format("--from {:g} s leaves fewer than two samples", options.from), {.file = path.string()},
        run.time.empty() ? "run the scene again" : fmt::format("the record ends at {:g} s", run.time.back()));
  return static_cast<std::size_t>(at - run.time.begin());
}

/// Mean, standard deviation, extremes, and those of single waves about the mean where there are three and more.
Json statistics_of(std::span<const double> time, std::span<const double> values) {
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) return {};
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double mean = sum / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Json out{{"mean", mean}, {"deviation", std::sqrt(squares / n)}, {"least", *low}, {"largest", *high}};
  const auto waves = hs::single_waves(time, values);
  if (waves.size() < 3) return out;
  const hs::WaveStatistics all = hs::wave_statistics(waves);
  out["waves"] = all.count;
  out["significant"] = all.h13;
  out["mean_period"] = all.mean_period;
  return out;
}

/// The estimated error of a signal, of all sources and of each.
Json error_of(const Hdf5Reader& file, const fs::path& path, const std::string& dataset) {
  if (!file.has_attribute(dataset, "error")) return {};
  Json sources = Json::object();
  for (const std::string& name : attribute_names(path, dataset))
    if (name.starts_with("error_")) sources[name.substr(6)] = file.number_attribute(dataset, name);
  Json out{{"total", file.number_attribute(dataset, "error")}, {"sources", sources}};
  if (file.has_attribute(dataset, "predictable_until_s"))
    out["predictable_until"] = file.number_attribute(dataset, "predictable_until_s");
  return out;
}

/// \throws hydro::InputError where the scene names files that are not there
Json plan_of(const std::string& scene_text, const fs::path& scene_file) {
  const Plan plan = parse(scene_text, scene_file).plan();
  Json sections = Json::array();
  for (const Plan::Section& section : plan.sections) {
    Json lines = Json::array();
    for (const PlanLine& line : section.lines) lines.push_back({line.effect, line.method, line.size, line.runs});
    sections.push_back({{"title", section.title}, {"lines", lines}});
  }
  return {{"sections", sections}, {"notes", plan.notes}};
}

Json signals_of(const RunResult& run, const fs::path& path, const Thinning& thinning, std::size_t first) {
  const Hdf5Reader file(path);
  Json out = Json::array();
  const std::span<const double> time = std::span(run.time).subspan(first);
  for (const Signal& s : run.signals) {
    Json one{{"name", s.name}, {"unit", s.units}, {"long_name", s.long_name}};
    one["values"] = single_array(thinning.values(s.values));
    one["statistics"] = statistics_of(time, std::span(s.values).subspan(first));
    one["error"] = error_of(file, path, "/" + s.name);
    out.push_back(std::move(one));
  }
  return out;
}

Json whole_run(const fs::path& path, const Options& options) {
  const RunResult run = read_run(path);
  const Hdf5Reader file(path);
  if (run.time.size() < 2)
    throw hydro::InputError("the run holds fewer than two samples, and there is nothing to show",
                            {.file = path.string()}, "run the scene again");
  const std::size_t first = first_counted(run, options, path);
  Json out{{"kind", "run"}};
  out.update(told_of(file, path));
  const Thinning thinning(run.time.size(),
                          std::max(fewest_points, options.points / std::max<std::size_t>(run.signals.size(), 1)));
  out["record"] = {{"begin", run.time.front()},         {"end", run.time.back()},    {"samples", run.time.size()},
                   {"from", run.time[first]},           {"shown", thinning.shown()}, {"piece", thinning.piece()},
                   {"counted", run.time.size() - first}};
  out["time"] = double_array(thinning.times(run.time));
  out["signals"] = signals_of(run, path, thinning, first);
  out["spectra"] = spectra_of(run, first);
  out["phase"] = phase_of(run, first);
  const std::string text = out.value("scene_text", "");
  const fs::path scene_file = options.scene_folder.value_or(path.parent_path()) / std::string(out["scene_file"]);
  if (text.empty()) return out;
  try {
    out["plan"] = plan_of(text, scene_file);
  } catch (const hydro::InputError& e) {
    out["plan"] = {{"missing", e.rule()}};
  }
  out["view"] = view_of(run, text, scene_file);
  return out;
}

}  // namespace

Json run_contents(const fs::path& path, const Options& options) { return whole_run(path, options); }

}  // namespace froude::html
