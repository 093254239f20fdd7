// What a fit tells and draws.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

#include "answers/plot.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "report/contents.hpp"

namespace froude::html {
namespace {

Json axis_told(const plot::Axis& axis) {
  Json out{{"label", axis.label}, {"unit", axis.unit}, {"log", axis.scale == plot::Scale::logarithmic}};
  if (axis.range) out["range"] = {axis.range->first, axis.range->second};
  return out;
}

Json panel_told(const plot::Panel& panel) {
  Json series = Json::array(), bands = Json::array();
  for (const plot::Series& s : panel.series)
    series.push_back({{"name", s.name},
                      {"x", single_array(s.x)},
                      {"y", single_array(s.y)},
                      {"line", s.line},
                      {"marks", s.marks},
                      {"dashed", s.dashed}});
  for (const plot::Band& b : panel.bands)
    bands.push_back(
        {{"name", b.name}, {"x", single_array(b.x)}, {"low", single_array(b.low)}, {"high", single_array(b.high)}});
  return {{"x", axis_told(panel.x)},
          {"y", axis_told(panel.y)},
          {"series", series},
          {"bands", bands},
          {"equal", panel.equal_scales}};
}

/// A value of TOML as JSON; what TOML knows beyond it, dates, is text.
Json json_of_toml(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Json out = Json::object();
    for (const auto& [key, value] : *table) out[std::string(key.str())] = json_of_toml(value);
    return out;
  }
  if (const auto* array = node.as_array()) {
    Json out = Json::array();
    for (const auto& value : *array) out.push_back(json_of_toml(value));
    return out;
  }
  if (const auto text = node.value<std::string>(); node.is_string()) return *text;
  if (const auto flag = node.value<bool>(); node.is_boolean()) return *flag;
  if (const auto whole = node.value<std::int64_t>(); node.is_integer()) return *whole;
  if (const auto number = node.value<double>(); node.is_number()) return *number;
  std::ostringstream other;
  node.visit([&](const auto& date) { other << date; });
  return other.str();
}

}  // namespace

Json fit_contents(const scene::FitScene& scene, const scene::FitAnswer& answer, const Json& facts) {
  Json out{{"kind", "fit"}, {"name", scene.file.filename().string()}, {"title", scene.title}};
  out["facts"] =
      Facts{{"Fit of kind", scene.kind()}, {"Confidence of intervals", fmt::format("{:g} %", 100 * scene.confidence)}};
  out["scene_text"] = scene.text;
  Json settings = Json::array();
  for (const scene::Echo& echo : scene.echo)
    settings.push_back({echo.key, echo.value + (echo.defaulted ? " (default)" : "")});
  out["settings"] = settings;
  if (answer.report.refused) out["refused"] = answer.report.refused->why;
  out["tree"] = facts;
  Json panels = Json::array();
  for (const plot::Panel& panel : answer.panels) panels.push_back(panel_told(panel));
  out["panels"] = panels;
  return out;
}

Json estimates_contents(const std::filesystem::path& path) {
  const std::string text = hydro::io::read_text(path);
  toml::table table;
  try {
    table = toml::parse(text, path.string());
  } catch (const toml::parse_error& e) {
    throw hydro::InputError(std::string(e.description()),
                            {.file = path.string(), .line = static_cast<int>(e.source().begin.line)},
                            "give what `froude fit -o` wrote");
  }
  if (!table.contains("kind") || !table.contains("confidence"))
    throw hydro::InputError("this is neither a fit scene nor what `froude fit` has written", {.file = path.string()},
                            "run a scene of motion first, and give the result: froude run SCENE -o run.h5");
  Json tree = json_of_toml(table);
  Json out{{"kind", "fit"}, {"name", path.filename().string()}, {"title", ""}};
  out["facts"] = Facts{{"Scene", tree.value("scene", "")}, {"Fit of kind", tree.value("kind", "")}};
  out["tree"] = tree;
  out["notes"] = {
      "These are estimates without the measurements. Give the fit scene itself, and the fit is made and its "
      "residuals are drawn."};
  return out;
}

}  // namespace froude::html
