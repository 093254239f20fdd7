// `froude report`: results as one HTML file, for the eye.
#include <algorithm>
#include <chrono>

#include <fmt/chrono.h>

#include "answers/fit_scene.hpp"
#include "froude/fit_facts.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/trial.hpp"
#include "report/contents.hpp"
#include "report/page.hpp"
#include "sweep/store.hpp"

namespace froude {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

std::string kind_of_hdf5(const Path& path) {
  return hydro::io::read_tried(path, [&] {
    const hydro::io::Hdf5Reader file(path);
    return file.has_attribute("/", "kind") ? file.text_attribute("/", "kind") : std::string();
  });
}

Json contents_of_hdf5(const Path& path, const html::Options& options) {
  const std::string kind = kind_of_hdf5(path);
  if (kind == "froude run") return html::run_contents(path, options);
  if (kind == "froude rao") return html::rao_contents(path);
  if (kind == "froude modes") return html::modes_contents(path);
  if (kind == "froude field") return html::field_contents(path, options);
  if (kind == "froude psd") return html::spectra_contents(path);
  if (kind == "froude stability")
    throw InputError("a report does not draw the map of `froude stability`", {.file = path.string()},
                     "give its table, which it draws: froude stability SCENE --csv map.csv");
  throw InputError(
      kind.empty() ? "this is no result of froude" : fmt::format("a report does not show results of `{}`", kind),
      {.file = path.string()}, "give results of `froude run`, `rao`, `modes`, `field`, `waves make` or `psd`");
}

/// A fit scene is fitted now: its file of estimates holds no measurements to draw.
Json contents_of_fit(const Path& path) {
  const scene::FitScene scene = scene::read_fit(path);
  const scene::FitAnswer answer = scene.of->answer(scene);
  return html::fit_contents(scene, answer, facts_of_fit(answer.report, scene.confidence));
}

Json contents_of(const Path& path, const html::Options& options) {
  std::error_code unknown;
  if (!fs::exists(path, unknown))
    throw InputError(fmt::format("cannot read \"{}\": no such file", path.string()), {}, "check the path");
  if (fs::is_directory(path, unknown)) return html::sweep_contents(path);
  const std::string ending = path.extension().string();
  if (ending == ".h5" || ending == ".nc") return contents_of_hdf5(path, options);
  if (ending == ".csv") return html::table_contents(path);
  if (ending == ".toml") return scene::is_fit(path) ? contents_of_fit(path) : html::estimates_contents(path);
  throw InputError(fmt::format("a report shows results, and \"{}\" ends like none", path.filename().string()),
                   {.file = path.string()}, "give files that end in .h5, .nc, .csv or .toml, or the folder of a sweep");
}

std::vector<NamedFile> inputs_of(const ReportArguments& arguments) {
  std::vector<NamedFile> out;
  std::error_code unknown;
  for (const Path& path : arguments.results) {
    if (fs::is_directory(path, unknown)) {
      const auto files = files_below("the sweep", path);
      out.insert(out.end(), files.begin(), files.end());
    } else {
      out.push_back({"a result", path});
      if (path.extension() == ".toml" && scene::is_fit(path)) {
        const auto files = files_of_scene(path);
        out.insert(out.end(), files.begin(), files.end());
      }
    }
  }
  return out;
}

/// Each run against the first.
Json differences_of(const std::vector<Path>& results, const Json& contents, const html::Options& options) {
  Json out = Json::array();
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (contents[i]["kind"] != "run") continue;
    if (first)
      out.push_back(html::run_difference(results[*first], results[i], options));
    else
      first = i;
  }
  return out;
}

/// Files of one name in different folders are told apart by their folders.
void name_apart(const std::vector<Path>& results, Json& contents) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto same = std::count_if(contents.begin(), contents.end(),
                                    [&](const Json& one) { return one["name"] == contents[i]["name"]; });
    contents[i]["label"] = same > 1 ? Json(results[i].string()) : contents[i]["name"];
  }
}

}  // namespace

void report_results(const ReportArguments& arguments, const Console& console) {
  if (!html::has_page()) html::page_with("", {});
  if (arguments.output.extension() != ".html" && arguments.output.extension() != ".htm")
    throw InputError(
        fmt::format("a report is HTML, so its file cannot end in \"{}\"", arguments.output.extension().string()),
        {.file = arguments.output.string()}, "end it in .html");
  html::Options options;
  if (arguments.from) options.from = option_si("--from", *arguments.from, hydro::dim::time);
  options.scene_folder = arguments.scene_folder;
  require_outputs({{"-o", arguments.output}}, inputs_of(arguments));
  options.points /= arguments.results.size();
  Json contents = Json::array();
  for (const Path& path : arguments.results) contents.push_back(contents_of(path, options));
  name_apart(arguments.results, contents);
  const std::string title =
      contents[0].value("title", "").empty() ? std::string(contents[0]["label"]) : std::string(contents[0]["title"]);
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const Json data{{"version", FROUDE_VERSION},
                  {"made", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now))},
                  {"title", title},
                  {"differences", differences_of(arguments.results, contents, options)},
                  {"results", contents}};
  const std::string page = html::page_with(title, data);
  hydro::io::write_atomically(arguments.output, page);
  Report told;
  told.say("{} results in {:.1f} MB", fact("results", arguments.results.size()),
           fact("megabytes", static_cast<double>(page.size()) / 1e6));
  tell(told.wrote(arguments.output), console);
}

}  // namespace froude
