// `froude export`: results for other programs.
#include <algorithm>
#include <cmath>

#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/trial.hpp"
#include "interchange/csv.hpp"
#include "interchange/matlab.hpp"
#include "interchange/vtk.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;
using interchange::Content;

struct Form {
  const char *name, *ending;
};
constexpr Form forms[] = {{"csv", ".csv"}, {"matlab", ".mat"}, {"vtk", ".pvd"}};

/// One result, and the file that is to be made of it.
struct Export {
  Path result, output;
};

std::vector<Export> exports_of(const ExportArguments& a) {
  if (a.format.empty()) {
    if (a.results.size() > 1)
      throw InputError("several results do not go into one file", {.file = "command line"},
                       "name a folder with -o, and the form with --format: csv, matlab or vtk");
    const std::string ending = a.output.extension().string();
    if (std::none_of(std::begin(forms), std::end(forms), [&](const Form& f) { return ending == f.ending; }))
      throw InputError(fmt::format("\"{}\" ends in none of .csv, .mat (MATLAB) and .pvd (ParaView)", a.output.string()),
                       {.file = "command line"}, "choose one of these endings, or a folder with --format");
    return {{a.results.front(), a.output}};
  }
  const auto* form =
      std::find_if(std::begin(forms), std::end(forms), [&](const Form& f) { return a.format == f.name; });
  std::vector<Export> out;
  for (const Path& result : a.results) out.push_back({result, a.output / (result.stem().string() + form->ending)});
  return out;
}

/// The folder of --format is made, if it is not there.
void make_folder(const Path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || !fs::is_directory(folder, failed))
    throw InputError(fmt::format("with --format -o is a folder, and \"{}\" cannot be made one", folder.string()),
                     {.file = "command line"}, "choose another name");
}

void check(const std::vector<Export>& all) {
  std::vector<NamedFile> outputs, inputs;
  for (const Export& one : all) {
    inputs.push_back({"a result", one.result});
    outputs.push_back({all.size() == 1 ? "-o" : fmt::format("what is made of {}", one.result.string()), one.output});
  }
  require_outputs(outputs, inputs);
}

/// The part of a run that is asked for.
struct TimeWindow {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  std::optional<double> every;
  bool is_whole() const { return !every && std::isinf(from) && std::isinf(to); }
};

TimeWindow window_of(const ExportArguments& a) {
  TimeWindow out;
  if (a.from) out.from = option_si("--from", *a.from, hydro::dim::time);
  if (a.to) out.to = option_si("--to", *a.to, hydro::dim::time);
  if (a.every) {
    out.every = option_si("--every", *a.every, hydro::dim::time);
    hydro::require(*out.every > 0, "--every must be positive, got {} s", *out.every);
  }
  return out;
}

/// The samples within; of `every` those that are nearest to the first, and to so much later again and again.
std::vector<std::size_t> samples_of(const std::vector<double>& time, const TimeWindow& window, const Path& file) {
  const auto slack = [](double t) { return std::isfinite(t) ? 1e-9 * (1 + std::abs(t)) : 0; };
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] >= window.from - slack(window.from) && time[i] <= window.to + slack(window.to)) out.push_back(i);
  if (out.empty())
    throw InputError("no sample lies from --from to --to", {.file = file.string()},
                     time.empty()
                         ? "run the scene again"
                         : fmt::format("the result reaches from {:.6g} to {:.6g} s", time.front(), time.back()));
  if (!window.every) return out;
  std::vector<std::size_t> thinned;
  const double first = time[out.front()];
  for (const std::size_t i : out) {
    // The sample is the nearest one of the record to a multiple of `every` after the first.
    const double wanted = first + std::round((time[i] - first) / *window.every) * *window.every;
    const double off = std::abs(time[i] - wanted);
    const bool before_is_nearer = i > out.front() && std::abs(time[i - 1] - wanted) <= off * (1 + 1e-9);
    const bool after_is_nearer = i < out.back() && std::abs(time[i + 1] - wanted) < off * (1 - 1e-9);
    if (!before_is_nearer && !after_is_nearer) thinned.push_back(i);
  }
  return thinned;
}

bool is_named(const ExportArguments& a, const std::string& name) {
  return a.signals.empty() || std::any_of(a.signals.begin(), a.signals.end(),
                                          [&](const std::string& pattern) { return scene::matches(pattern, name); });
}

void require_named(const ExportArguments& a, const Content& content, const Path& file) {
  for (const std::string& pattern : a.signals)
    if (std::none_of(content.arrays.begin(), content.arrays.end(),
                     [&](const auto& array) { return scene::matches(pattern, array.name); })) {
      std::vector<std::string> known;
      for (const auto& array : content.arrays) known.push_back(array.name);
      const std::string near = hydro::nearest(pattern, known);
      throw InputError(fmt::format("no signal is called \"{}\"", pattern), {.file = file.string()},
                       near.empty() ? fmt::format("signals are: {}", fmt::join(known, ", "))
                                    : fmt::format("did you mean \"{}\"?", near));
    }
}

/// As a table or for MATLAB.
Report export_numbers(const ExportArguments& a, const Export& one, const TimeWindow& window) {
  Content content = interchange::read_content(one.result);
  const auto time = std::find_if(content.arrays.begin(), content.arrays.end(),
                                 [](const auto& array) { return array.name == "time" && array.is_axis(); });
  if (!window.is_whole()) {
    if (time == content.arrays.end())
      throw InputError("--from, --to and --every are times, and this result is none in time",
                       {.file = one.result.string()}, "leave them out");
    interchange::keep(content, "time", samples_of(time->values, window, one.result));
  }
  require_named(a, content, one.result);
  interchange::keep_named(content, [&](const std::string& name) { return is_named(a, name); });
  Report out;
  if (one.output.extension() == ".mat") {
    interchange::write_matlab(one.output, content);
    out.say("{}: {} variables", one.result.string(), fact("variables", content.arrays.size()));
  } else {
    if (one.result.extension() == ".csv")
      throw InputError("it is a table already", {.file = one.result.string()}, "copy it, or export it as .mat");
    const auto left_out = interchange::write_csv(one.output, content);
    out.say("{}: {} columns", one.result.string(), fact("columns", content.arrays.size() - left_out.size()));
    std::vector<std::string> notes;
    if (!left_out.empty())
      notes.push_back(fmt::format("the table leaves out what stands along other axes: {}; .mat has all of it",
                                  fmt::join(left_out, ", ")));
    out.sentences("notes", "note: {}", notes);
  }
  return out.wrote(one.output);
}

/// The scene of a run as its result keeps it, read where it stood or is said to stand.
scene::Scene scene_of(const ExportArguments& a, const Path& result) {
  const hydro::io::Hdf5Reader file(result);
  const bool has_text = file.has("/provenance/scene") && file.has_attribute("/", "scene_file");
  if (!has_text)
    throw InputError("the result keeps no scene, which tells what its bodies look like", {.file = result.string()},
                     "run the scene again with this version of froude");
  const Path scene_file = a.scene_folder.value_or(result.parent_path()) / file.text_attribute("/", "scene_file");
  try {
    return scene::parse(file.text("/provenance/scene"), scene_file);
  } catch (const InputError& e) {
    throw InputError(fmt::format("the scene of the result cannot be read where it is now: {}", e.rule()), e.where(),
                     "--scene-folder names the folder where it stood");
  }
}

bool is_field(const Path& result) {
  if (result.extension() != ".h5" && result.extension() != ".nc") return false;
  return hydro::io::read_tried(result, [&] {
    const hydro::io::Hdf5Reader file(result);
    return file.has_attribute("/", "kind") && file.text_attribute("/", "kind") == "froude field";
  });
}

Report export_field(const ExportArguments& a, const Export& one, const TimeWindow& window) {
  constexpr std::size_t instants = 24;  // 15 degrees of phase from one to the next
  if (!a.signals.empty() || !window.is_whole())
    throw InputError("--signal, --from, --to and --every do not apply to the .pvd of a field, which has one period",
                     {.file = "command line"}, "leave them out");
  const auto written = interchange::write_field_vtk(one.output, one.result, instants);
  Report out;
  out.say("{}: {} instants of one period, {} files with {:.1f} MB in {}", one.result.string(),
          fact("instants", instants), fact("files", written.files), fact("megabytes", written.megabytes),
          interchange::folder_of_instants(one.output).string());
  return out.wrote(one.output);
}

Report export_space(const ExportArguments& a, const Export& one, const TimeWindow& window) {
  if (!a.signals.empty())
    throw InputError("--signal chooses signals, and .pvd shows bodies, lines and waves", {.file = "command line"},
                     "leave it out");
  const RunResult run = read_run(one.result);
  scene::Scene scene = scene_of(a, one.result);
  view::Frames frames{samples_of(run.time, window, one.result)};
  constexpr std::size_t most = 10'000;  // a file each, and one for lines and for waves
  if (frames.count() > most)
    throw InputError(
        fmt::format("{} instants would be {} files for each kind of thing", frames.count(), frames.count()),
        {.file = one.result.string()}, "name fewer with --every \"0.5 s\", --from and --to");
  std::vector<double> time;
  for (const std::size_t sample : frames.samples) time.push_back(run.time[sample]);
  const view::View view(run, std::move(scene), std::move(frames), std::numeric_limits<std::size_t>::max());
  if (view.scene().bodies.empty() && view.lines().empty())
    throw InputError("the scene of this result has neither bodies nor lines, so there is nothing to show in space",
                     {.file = one.result.string()}, "export it as .csv or .mat");
  const auto written = interchange::write_vtk(one.output, view, time);
  Report out;
  out.say("{}: {} instants from {:.6g} to {:.6g} s, {} files with {:.1f} MB in {}", one.result.string(),
          fact("instants", time.size()), fact("from_s", time.front()), fact("to_s", time.back()),
          fact("files", written.files), fact("megabytes", written.megabytes),
          interchange::folder_of_instants(one.output).string());
  out.sentences("notes", "note: {}", view.notes());
  return out.wrote(one.output);
}

}  // namespace

void export_results(const ExportArguments& arguments, const Console& console) {
  const std::vector<Export> all = exports_of(arguments);
  const TimeWindow window = window_of(arguments);
  if (!arguments.format.empty()) make_folder(arguments.output);
  check(all);
  Report told;
  for (const Export& one : all)
    told.one_of("exports", one.output.extension() != ".pvd" ? export_numbers(arguments, one, window)
                           : is_field(one.result)           ? export_field(arguments, one, window)
                                                            : export_space(arguments, one, window));
  tell(told, console);
}

}  // namespace froude
