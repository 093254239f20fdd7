// How a result came about, as its file keeps it.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <string>

#include "report/contents.hpp"

namespace froude::html {
namespace {

namespace fs = std::filesystem;
using hydro::io::Hdf5Reader;

Json attributes_told(const Hdf5Reader& file, const fs::path& path, const std::string& group, bool texts) {
  Json out = Json::array();
  if (!file.has(group)) return out;
  for (const std::string& name : attribute_names(path, group))
    if (texts)
      out.push_back({name, file.text_attribute(group, name)});
    else
      out.push_back({name, file.number_attribute(group, name)});
  return out;
}

std::string day_and_time(const fs::path& path) {
  const auto changed = std::chrono::file_clock::to_sys(fs::last_write_time(path));
  const std::time_t seconds =
      std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::system_clock::duration>(changed));
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(seconds));
}

bool ends_in(const std::string& text, const std::string& word) {
  return text == word || text.ends_with("." + word) || text.ends_with("_" + word);
}

/// What a scene takes although it misses the accuracy asked, or a check, by the keys that say so.
bool is_acceptance(const std::string& key) {
  return ends_in(key, "accept") || ends_in(key, "accept_error") || ends_in(key, "accepted_error");
}

}  // namespace

Json told_of(const Hdf5Reader& file, const fs::path& path) {
  Json out{{"name", path.filename().string()}};
  Json facts = Json::array();
  const auto attribute = [&](const char* key) {
    return file.has_attribute("/", key) ? file.text_attribute("/", key) : std::string();
  };
  const Json settings = attributes_told(file, path, "/provenance/settings", true);
  std::string title;
  Json accepted = Json::array();
  for (const Json& setting : settings) {
    const std::string key = setting[0], value = setting[1];
    if (key == "title") title = value;
    if (key == "estimated.accuracy") out["accuracy_told"] = value;
    if (is_acceptance(key) && !value.ends_with("(default)")) accepted.push_back(key + " = " + value);
  }
  out["title"] = title;
  out["scene_file"] = attribute("scene_file");
  facts.push_back({"Scene", attribute("scene_file")});
  facts.push_back({"Made by", attribute("kind") + ", version " + attribute("froude_version") + ", " +
                                  attribute("build_type") + " build"});
  facts.push_back({"Written", day_and_time(path)});
  out["facts"] = facts;
  Json warnings = Json::array(), notes = Json::array();
  for (const Json& note : attributes_told(file, path, "/provenance/notes", true)) {
    const std::string key = note[0], text = note[1];
    if (key == "stopped")
      out["stopped"] = text;
    else if (key.starts_with("warning"))
      warnings.push_back(text.starts_with("warning: ") ? text.substr(9) : text);
    else
      notes.push_back(key.starts_with("note") ? text : key + ": " + text);
  }
  out["warnings"] = warnings;
  out["notes"] = notes;
  out["accepted"] = accepted;
  out["settings"] = settings;
  out["seeds"] = attributes_told(file, path, "/provenance/seeds", false);
  out["wall_time"] = attributes_told(file, path, "/provenance/wall_time", false);
  out["energy"] = attributes_told(file, path, "/provenance/energy", false);
  if (file.has("/provenance/scene")) out["scene_text"] = file.text("/provenance/scene");
  return out;
}

}  // namespace froude::html
