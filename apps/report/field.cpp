// The free surface about bodies in one regular wave, with what is seen of the bodies from above.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "hydro/base/error.hpp"
#include "hydro/io/trial.hpp"
#include "report/contents.hpp"
#include "view/outlines.hpp"

namespace froude::html {
namespace {

namespace fs = std::filesystem;
using hydro::io::Array;
using hydro::io::Hdf5Reader;

constexpr std::array<const char*, 4> parts_of_field{"elevation", "incident", "scattered", "radiated"};
constexpr std::array<const char*, 4> means_of_field{"drift_x", "drift_y", "power_taken", "power_sent_out"};

Json segments_told(const std::vector<view::Segment>& segments) {
  std::vector<double> flat;
  for (const auto& [from, to] : segments) flat.insert(flat.end(), {from.x(), from.y(), to.x(), to.y()});
  return single_array(flat);
}

/// The scene is read as if it stood in the folder of `scene_file`; where that cannot be, {"missing": why}.
Json outlines_told(const std::string& scene_text, const fs::path& scene_file) {
  try {
    Json out = Json::array();
    for (const view::Outline& one : view::outlines_of(scene::parse(scene_text, scene_file)))
      out.push_back(
          {{"name", one.body}, {"pierced", segments_told(one.pierced)}, {"submerged", segments_told(one.submerged)}});
    return out;
  } catch (const hydro::InputError& e) {
    return {{"missing", fmt::format("The scene cannot be read where it is now ({}), so bodies have no outlines; "
                                    "--scene-folder names the folder where it stood.",
                                    e.rule())}};
  }
}

std::string meaning_of(const Hdf5Reader& file, const std::string& dataset) {
  return file.text_attribute(dataset, "long_name");
}
std::string unit_of_field(const Hdf5Reader& file, const std::string& dataset) {
  return file.text_attribute(dataset, "units");
}

Json parts_told(const Hdf5Reader& file, const fs::path& path, std::size_t points) {
  Json out = Json::array();
  for (const std::string name : parts_of_field) {
    const std::string dataset = "/" + name;
    const Array values = file.numbers(dataset);
    if (values.values.size() != 2 * points)
      throw hydro::InputError(name + " has not one complex number for each point of the grid", {.file = path.string()},
                              "answer the scene again");
    Json one{{"name", name}, {"unit", unit_of_field(file, dataset)}, {"long_name", meaning_of(file, dataset)}};
    one.update(complex_array(values.values));
    out.push_back(std::move(one));
  }
  return out;
}

Json means_told(const Hdf5Reader& file) {
  Json out = Json::object();
  for (const std::string name : means_of_field) {
    const std::string dataset = "/" + name;
    out[name] = {{"value", file.scalar(dataset)},
                 {"unit", unit_of_field(file, dataset)},
                 {"long_name", meaning_of(file, dataset)}};
  }
  return out;
}

/// A row for each body: its name and what is told of it; empty where the field was not asked for it.
Json body_drift_told(const Hdf5Reader& file) {
  Json out = Json::array();
  if (!file.has("/body_drift_x")) return out;
  const std::vector<std::string> names = file.texts("/body");
  for (const std::string name : {"body_drift_x", "body_drift_y", "body_drift_moment"}) {
    const std::string dataset = "/" + name;
    const std::vector<double> values = file.numbers(dataset).values;
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
      if (out.size() <= i) out.push_back({{"body", names[i]}});
      out[i][name] = {{"value", values[i]}, {"unit", unit_of_field(file, dataset)}};
    }
  }
  return out;
}

Json field_in(const fs::path& path, const Options& options) {
  const Hdf5Reader file(path);
  Json out{{"kind", "field"}};
  out.update(told_of(file, path));
  const auto x = file.numbers("/x").values, y = file.numbers("/y").values;
  out["x"] = double_array(x);
  out["y"] = double_array(y);
  out["omega"] = file.scalar("/omega");
  out["heading"] = file.scalar("/heading");
  out["bodies"] = file.text_attribute("/", "bodies");
  out["error"] = file.number_attribute("/", "error");
  out["parts"] = parts_told(file, path, x.size() * y.size());
  out["means"] = means_told(file);
  out["body_drift"] = body_drift_told(file);
  const fs::path scene_file = options.scene_folder.value_or(path.parent_path()) / std::string(out["scene_file"]);
  out["outlines"] = outlines_told(out.value("scene_text", ""), scene_file);
  return out;
}

}  // namespace

Json field_contents(const fs::path& path, const Options& options) {
  return hydro::io::read_tried(path, [&] { return field_in(path, options); });
}

}  // namespace froude::html
