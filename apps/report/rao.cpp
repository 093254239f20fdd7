// Answers in the frequency domain: response amplitude operators, free motions, spectra in HDF5.
#include <fmt/format.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/io/trial.hpp"
#include "report/contents.hpp"

namespace froude::html {
namespace {

namespace fs = std::filesystem;
using hydro::io::Array;
using hydro::io::Hdf5Reader;

std::string unit_of(const Hdf5Reader& file, const std::string& dataset) {
  const std::string unit = file.has_attribute(dataset, "units") ? file.text_attribute(dataset, "units") : "";
  return unit == "1" ? "" : unit;
}

constexpr const char* sections_group = "section_at_rest";

/// Sections of hulls whose loads are among the responses, with what they carry at rest.
Json sections_in(const Hdf5Reader& file) {
  const std::string group = std::string("/") + sections_group;
  Json out = Json::array();
  if (!file.has(group)) return out;
  const std::vector<std::string> names = file.texts(group + "/section");
  std::vector<Json> rest(names.size(), Json::object());
  for (const std::string& name : file.children(group)) {
    if (name == "section") continue;
    const std::string dataset = group + "/" + name;
    const auto values = file.numbers(dataset).values;
    for (std::size_t i = 0; i < names.size(); ++i)
      rest[i][name] = {{"unit", unit_of(file, dataset)}, {"value", values[i]}};
  }
  for (std::size_t i = 0; i < names.size(); ++i) out.push_back({{"name", names[i]}, {"at_rest", rest[i]}});
  return out;
}

Json rao_in(const fs::path& path) {
  const Hdf5Reader file(path);
  Json out{{"kind", "rao"}};
  out.update(told_of(file, path));
  const auto omega = file.numbers("/omega").values, heading = file.numbers("/heading").values;
  out["omega"] = double_array(omega);
  out["heading"] = heading;
  Json signals = Json::array();
  for (const std::string& name : file.children("/")) {
    if (name == "omega" || name == "heading" || name == "complex" || name == "provenance" || name == sections_group)
      continue;
    const std::string dataset = "/" + name;
    const Array values = file.numbers(dataset);
    if (values.values.size() != 2 * omega.size() * heading.size())
      throw hydro::InputError(name + " has not one complex number for each heading and frequency",
                              {.file = path.string()}, "answer the scene again");
    Json one{
        {"name", name}, {"unit", unit_of(file, dataset)}, {"long_name", file.text_attribute(dataset, "long_name")}};
    one.update(complex_array(values.values));
    if (file.has_attribute(dataset, "error")) one["error"] = file.number_attribute(dataset, "error");
    signals.push_back(std::move(one));
  }
  out["signals"] = signals;
  if (Json sections = sections_in(file); !sections.empty()) out["sections"] = std::move(sections);
  return out;
}

Json modes_in(const fs::path& path) {
  const Hdf5Reader file(path);
  Json out{{"kind", "modes"}};
  out.update(told_of(file, path));
  out["period"] = file.numbers("/period").values;
  out["omega"] = file.numbers("/omega").values;
  out["motions"] = file.texts("/motion");
  out["shape"] = file.numbers("/shape").values;
  const Array s = file.numbers("/s");
  Json damping = Json::array();
  for (std::size_t i = 0; i + 1 < s.values.size(); i += 2)
    damping.push_back(-s.values[i] / std::hypot(s.values[i], s.values[i + 1]));
  out["damping"] = damping;
  return out;
}

Json spectra_in(const fs::path& path) {
  const Hdf5Reader file(path);
  Json out{{"kind", "table"}, {"name", path.filename().string()}, {"title", "Spectra"}};
  out["facts"] =
      Facts{{"Made by", file.text_attribute("/", "kind") + ", version " + file.text_attribute("/", "froude_version")},
            {"Confidence of the intervals", fmt::format("{:g} %", 100 * file.number_attribute("/", "confidence"))},
            {"Degrees of freedom", fmt::format("{:.3g}", file.number_attribute("/", "degrees_of_freedom"))}};
  Json columns = Json::array();
  const auto add = [&](const std::string& name) {
    const auto values = file.numbers("/" + name);
    if (values.shape.size() == 1)
      columns.push_back({{"name", name}, {"unit", unit_of(file, "/" + name)}, {"values", double_array(values.values)}});
  };
  add("frequency");
  for (const std::string& name : file.children("/"))
    if (name != "frequency" && !file.is_text("/" + name)) add(name);
  out["columns"] = columns;
  return out;
}

}  // namespace

Json rao_contents(const fs::path& path) {
  return hydro::io::read_tried(path, [&] { return rao_in(path); });
}
Json modes_contents(const fs::path& path) {
  return hydro::io::read_tried(path, [&] { return modes_in(path); });
}
Json spectra_contents(const fs::path& path) {
  return hydro::io::read_tried(path, [&] { return spectra_in(path); });
}

}  // namespace froude::html
