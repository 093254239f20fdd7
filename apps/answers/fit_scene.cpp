/// \file  A scene that fits: its measurements and what is asked of them, as far as all kinds of fit have it, and the
///        keys of the kinds.
#include "answers/fit_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "answers/film.hpp"
#include "answers/fit_kind.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"

namespace froude::scene {

// Each of the kinds that are listed in CMakeLists.txt.
#define FROUDE_PART(name) std::unique_ptr<const FitKind> name##_fit();
#include "fit_kinds.inc"
#undef FROUDE_PART

const std::vector<std::unique_ptr<const FitKind>>& fit_kinds() {
  static const auto kinds = [] {
    std::vector<std::unique_ptr<const FitKind>> all;
#define FROUDE_PART(name) all.push_back(name##_fit());
#include "fit_kinds.inc"
#undef FROUDE_PART
    return all;
  }();
  return kinds;
}

namespace {

namespace fs = std::filesystem;
using hydro::InputError;

const Key* find(const std::vector<Key>& keys, const std::string& name) {
  const auto at = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
  return at == keys.end() ? nullptr : &*at;
}

/// What a key means to one kind or several, and which.
using Meanings = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Adds what a key means to one more kind, and the words that this kind knows.
void add_meaning(const Key& key, const std::string& kind, Key& whole, Meanings& meanings) {
  const auto same = std::find_if(meanings.begin(), meanings.end(), [&](auto& m) { return m.first == key.meaning; });
  if (same == meanings.end())
    meanings.push_back({key.meaning, {kind}});
  else
    same->second.push_back(kind);
  if (key.holds == Holds::texts) whole.holds = Holds::texts;
  for (const std::string& word : key.words)
    if (std::find(whole.words.begin(), whole.words.end(), word) == whole.words.end()) whole.words.push_back(word);
  whole.meaning.clear();
  for (const auto& [meaning, kinds] : meanings)
    whole.meaning += fmt::format("{}{}: {}", whole.meaning.empty() ? "" : "; ", fmt::join(kinds, ", "), meaning);
}

/// The keys of all kinds in one table. What a kind needs is left to its reader: in others the key is not there.
void append_of_kinds(std::vector<Key> FitKeys::*part, std::vector<Key>& out) {
  std::map<std::string, Meanings> meanings;
  for (const auto& kind : fit_kinds())
    for (const Key& key : kind->keys().*part) {
      if (find(out, key.name) == nullptr) {
        out.push_back(key);
        if (key.need == Need::required) out.back().optional();
      }
      Key& whole = *std::find_if(out.begin(), out.end(), [&](const Key& k) { return k.name == key.name; });
      add_meaning(key, kind->word(), whole, meanings[key.name]);
    }
}

/// \throws hydro::InputError for a key that other kinds have and this one has not
void check_keys(const Record& record, std::vector<Key> FitKeys::*part, const FitKind& kind) {
  for (const auto& other : fit_kinds())
    for (const Key& key : other->keys().*part) {
      if (find(kind.keys().*part, key.name) != nullptr || !record.has(key.name) || record[key.name].defaulted) continue;
      std::vector<std::string> owners;
      for (const auto& owner : fit_kinds())
        if (find(owner->keys().*part, key.name) != nullptr) owners.push_back(fmt::format("\"{}\"", owner->word()));
      throw record[key.name].wrong(not_of_kind(kind.word()), fmt::format("leave it out: it belongs to fits of kind {}",
                                                                         fmt::join(owners, " and ")));
    }
}

/// Files that fit one entry of `files`, in alphabetical order. A `*` may stand in the file's name, not in a folder's.
void expand(const Value& files, const Located<std::string>& entry, std::vector<Located<fs::path>>& out) {
  const fs::path path = beside(entry.place.file, entry.value);
  const std::string pattern = path.filename().string(), folder = path.parent_path().string();
  const auto refuse = [&](const std::string& rule, const std::string& remedy) {
    throw InputError(fmt::format("{}: \"{}\" {}", files.name, entry.value, rule), entry.place, remedy);
  };
  if (fs::path(entry.value).parent_path().string().find('*') != std::string::npos)
    refuse("has a * in the name of a folder", "list the folders one by one");
  std::error_code failed;
  std::vector<fs::path> found;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    std::error_code unknown;
    if (at->is_regular_file(unknown) && matches(pattern, at->path().filename().string())) found.push_back(at->path());
  }
  if (failed) refuse(fmt::format("cannot be looked up: {}", failed.message()), fmt::format("the folder is {}", folder));
  if (found.empty()) refuse("is no file", fmt::format("looked in {}", folder));
  std::sort(found.begin(), found.end());
  for (const fs::path& file : found) out.push_back({file, entry.place});
}

void put_files(const Value& given, FitScene& scene) {
  auto& out = scene.files;
  for (const auto& entry : given.texts) expand(given, entry, out);
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  const auto twice =
      std::adjacent_find(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value == b.value; });
  if (twice != out.end())
    throw InputError(fmt::format("{} holds {} twice", given.name, twice->value.string()), std::next(twice)->place,
                     "name each file once, or the fit counts it twice");
}

const Table& data_channels() {
  static const Table table = [] {
    Table all{.title = "[data.channels]", .meaning = "which column of the files plays which part", .keys = {}};
    append_of_kinds(&FitKeys::channels, all.keys);
    return all;
  }();
  return table;
}

Binding<FitScene::Line> channel_line() {
  using L = FitScene::Line;
  return Binding<L>("[[data.line]]",
                    "a channel that stands in the files as readings, volts of a gauge or potentiometer: its line gives "
                    "what was measured")
      .key(text("column", "of the data files"), &L::column)
      .key(text("file", "CSV of points at known references, as a fit of kind \"calibration\" takes it"), &L::file)
      .key(text("reading", "column of that file: what the channel gave, in the unit of the data"), &L::reading)
      .key(text("reference", "column of that file: what was set, in the unit that the channel measures"), &L::reference)
      .place(&L::place);
}

/// A line that nothing reads would be left out in silence.
void check_lines(const FitTables& tables, const FitScene& scene) {
  const std::string& kind = scene.kind();
  for (const FitScene::Line& line : scene.lines) {
    if (kind == "calibration")
      throw InputError(fmt::format("[[data.line]] {}", not_of_kind(kind)), line.place,
                       "leave it out: write the column in the unit that is measured");
    if (tables.root.has("camera"))
      throw InputError("[[data.line]] does not go with [camera]: a track has a scale of its own", line.place,
                       "leave it out");
    std::vector<std::string> read;
    for (const auto& [role, column] : scene.channels) read.push_back(column);
    for (const auto& force : scene.force) read.push_back(force.column);
    if (tables.channels().has("response"))
      for (const auto& one : tables.channels()["response"].texts) read.push_back(one.value);
    if (kind == "motion")
      for (const Record& signal : tables.data().tables("signal")) read.push_back(signal.text("column"));
    if (std::find(read.begin(), read.end(), line.column) == read.end())
      throw InputError(fmt::format("[[data.line]] column = \"{}\" is no channel of this fit", line.column), line.place,
                       fmt::format("the channels are {}", fmt::join(read, ", ")));
    for (const auto& force : scene.force)
      if (force.column == line.column && force.calibration)
        throw InputError(fmt::format("\"{}\" has a calibration and a line", line.column), line.place,
                         "keep one of the two: a calibration counts its errors in the intervals");
    if (std::count_if(scene.lines.begin(), scene.lines.end(), [&](const auto& l) { return l.column == line.column; }) >
        1)
      throw InputError(fmt::format("\"{}\" has two lines", line.column), line.place, "keep one of them");
  }
}

/// Without the keys of the kinds.
const Binding<FitScene>& data_of_all() {
  static const auto table =
      Binding<FitScene>("[data]", "the measurements")
          .optional(texts("files", "CSV, relative to the scene; * stands for any characters of a file's name"),
                    put_files)
          .key(inner_table("channels", data_channels()).or_default("", "see its keys"))
          .tables("line", channel_line(), &FitScene::lines)
          .optional();
  return table;
}

const Binding<FitScene>& intervals_of_all() {
  static const auto table = Binding<FitScene>("[ask.intervals]", "how sure to be")
                                .key(number("level", "probability that the interval covers the truth")
                                         .within(Limit::open_fraction)
                                         .or_default("0.95", "the usual level"),
                                     [](const Value& v, FitScene& out) {
                                       // Beyond, an interval is made of tails that no record of scatter tells.
                                       if (v.number < 0.01 || v.number > 0.9999)
                                         throw v.wrong("must lie between 0.01 and 0.9999");
                                       out.confidence = v.number;
                                     });
  return table;
}

const Table& fit_data() {
  static const Table table = [] {
    Table all = data_of_all().table();
    append_of_kinds(&FitKeys::data, all.keys);
    all.groups.push_back({Group::Count::exactly_one, {"files", "runs", "record"}});
    return all;
  }();
  return table;
}

const Table& fit_ask() {
  static const Table intervals = [] {
    Table all = intervals_of_all().table();
    append_of_kinds(&FitKeys::intervals, all.keys);
    return all;
  }();
  static const Table table = [] {
    Table all{.title = "[ask]", .meaning = "what is wanted of a fit", .keys = {}};
    append_of_kinds(&FitKeys::ask, all.keys);
    all.keys.push_back(inner_table("intervals", intervals).or_default("", "see its keys"));
    return all;
  }();
  return table;
}

const Table& fit_model() {
  static const Table table = [] {
    Table all{.title = "[model]",
              .meaning = "what the measurement is taken for",
              .keys = {text("kind", "of experiment")},
              .chosen_by = "kind"};
    for (const auto& kind : fit_kinds()) all.variants.push_back(kind->keys().model);
    return all;
  }();
  return table;
}

const Binding<FitScene>& fit_picture() {
  static const auto table =
      Binding<FitScene>("[picture]", "what is drawn upon the picture of the fit")
          .tables("upon",
                  panel_overlay_binding("[[picture.upon]]",
                                        "a table drawn upon one of its panels: another campaign, published points"),
                  &FitScene::overlays);
  return table;
}

/// The columns and their roles, but the force, of which there may be several. \throws hydro::InputError for a role that
/// the kind does not know, or needs and has not
void read_channels(const Record& channels, FitScene& scene) {
  const std::vector<Key>& roles = scene.of->keys().channels;
  for (const Key& key : data_channels().keys) {
    const std::string& role = key.name;
    if (!channels.has(role)) continue;
    if (find(roles, role) == nullptr) {
      std::vector<std::string> names;
      for (const Key& own : roles) names.push_back(own.name);
      throw channels.wrong(role, not_of_kind(scene.kind()), fmt::format("its channels are {}", fmt::join(names, ", ")));
    }
    if (key.holds == Holds::texts) continue;  // may be several: the kind reads them, the force read_force()
    if (channels.text(role).empty()) throw channels.wrong(role, "is empty", "write the name of a column");
    scene.channels[role] = channels.text(role);
  }
  for (const Key& key : roles)
    if (key.need == Need::required && !channels.has(key.name))
      throw channels.refused(fmt::format("needs \"{}\" for a fit of kind \"{}\"", key.name, scene.kind()),
                             fmt::format("add {} = \"name of a column\"", key.name));
}

/// The force channels, each with its sign and, where they are given, its calibration.
std::vector<FitScene::ForceChannel> read_force(const Record& data, const FitScene& scene) {
  const Record& channels = data.table("channels");
  std::vector<FitScene::ForceChannel> out;
  if (!channels.has("force")) return out;
  for (const auto& name : channels["force"].texts) {
    const bool turned = name.value.starts_with('-');
    const std::string column = turned ? name.value.substr(1) : name.value;
    if (column.empty()) throw channels.wrong("force", "is empty", "write the name of a column");
    for (const auto& other : out)
      if (other.column == column) throw channels.wrong("force", fmt::format("holds \"{}\" twice", column));
    out.push_back({column, turned, {}});
  }
  if (out.empty()) throw channels.wrong("force", "is empty", "write the name of a column");
  if (find(scene.of->keys().channels, "force")->holds != Holds::texts && out.size() > 1)
    throw channels.wrong("force", fmt::format("may hold one column only in a fit of kind \"{}\"", scene.kind()));
  if (!data.has("calibration")) return out;
  const auto& files = data["calibration"].texts;
  if (files.size() != out.size())
    throw data.wrong("calibration", fmt::format("names {} files for {} force channels", files.size(), out.size()),
                     "name one for each, in the order of the channels");
  for (std::size_t i = 0; i < files.size(); ++i)
    out[i].calibration = {{beside(scene.file, files[i].value), files[i].place}};
  return out;
}

/// What all kinds have.
void read_measurements(const FitTables& tables, FitScene& scene) {
  const Record &data = tables.data(), &intervals = tables.ask().table("intervals");
  check_keys(data, &FitKeys::data, *scene.of);
  check_keys(intervals, &FitKeys::intervals, *scene.of);
  check_keys(tables.ask(), &FitKeys::ask, *scene.of);
  data_of_all().read_into(data, scene);
  intervals_of_all().read_into(intervals, scene);
  if (data.has("runs")) detail::put(data["runs"], scene.run_table);
  read_channels(tables.channels(), scene);
}

}  // namespace

FitAnswer FitKind::predict(const FitScene& scene, const std::optional<std::filesystem::path>&) const {
  throw InputError(fmt::format("a fit of kind \"{}\" has no scene that tells a record by itself", scene.kind()),
                   scene.model_place, "--predict is for kind \"motion\"");
}

std::string not_of_kind(std::string_view kind) { return fmt::format("does not apply to a fit of kind \"{}\"", kind); }

Key accept_key(const std::string& meaning) { return texts("accept", meaning).optional().one_of({"residuals"}); }

hydro::InputError prepares_nothing(const FitTables& tables) {
  return tables.root.table("prepare").refused(not_of_kind(tables.model().text("kind")),
                                              "leave it out: its steps are those of a force, or of a decay");
}

hydro::InputError films_nothing(const FitTables& tables) {
  return tables.root.table("camera").refused(not_of_kind(tables.model().text("kind")),
                                             "leave it out: a track is fitted by running a scene, in kind \"motion\"");
}

const std::vector<Located<std::string>>& wanted(const FitTables& t, const std::vector<std::string>& known,
                                                const char* example, const char* remedy) {
  if (!t.ask().has("coefficients"))
    throw t.ask().refused("needs the key \"coefficients\"", fmt::format("add coefficients = {}", example));
  const Value& asked = t.ask()["coefficients"];
  for (const auto& one : asked.texts)
    if (std::find(known.begin(), known.end(), one.value) == known.end())
      throw hydro::InputError(fmt::format("{}: \"{}\" {}", asked.name, one.value, not_of_kind(t.model().text("kind"))),
                              one.place, remedy);
  return asked.texts;
}

const std::string& FitScene::kind() const { return of->word(); }

const Table& fit_schema() {
  static const Table table{
      .title = "a fit",
      .meaning = "coefficients from measurements",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               inner_table("data", fit_data()), inner_table("camera", camera_binding().table()).optional(),
               inner_table("prepare", prepare_binding().table()).optional(), inner_table("model", fit_model()),
               inner_table("ask", fit_ask()), inner_table("picture", fit_picture().table()).optional()}};
  return table;
}

std::string key_reference() {
  return "# Keys of a scene\n\n"
         "Written by `froude new --keys` from the tables that the reader itself uses; `scenes.md` explains how they go "
         "together.\n"
         "A quantity is text with its unit, any unit of its kind; the unit named here is SI. A default stands with its "
         "reason. A table that several others hold is told once, where the first of them is.\n"
         "\n## Scenes of motion\n" +
         reference_of(motion_schema()) + "\n## Scenes of fits\n" + reference_of(fit_schema()) +
         "\n## Scenes of films\n" + reference_of(film_schema()) + "\n## Calibrations\n" +
         reference_of(calibration_binding().table());
}

bool is_fit(const fs::path& file) {
  return parse_document(hydro::io::read_text(file), file.string()).find("model") != nullptr;
}

FitScene parse_fit(std::string_view text, const fs::path& file, const std::vector<OverriddenValue>& values) {
  Node document = parse_document(text, file.string());
  check_version(document);
  override_values(document, values);
  if (const auto* body = document.find("body"); body != nullptr && document.find("model") == nullptr)
    throw InputError("this scene has a [[body]] and no [model]: it asks for motion, not for a fit", body->place,
                     "use `froude rao` or `froude run`");
  FitScene scene;
  scene.file = file;
  scene.text = text;
  const Record root = read_record(document, fit_schema(), scene.echo);
  if (root.has("title")) scene.title = root.text("title");
  const FitTables tables{root};
  scene.model_place = tables.model().place();
  for (const auto& kind : fit_kinds())
    if (kind->word() == tables.model().text("kind")) scene.of = kind.get();
  read_measurements(tables, scene);
  scene.settings = scene.of->read(tables, scene);
  scene.force = read_force(tables.data(), scene);
  check_lines(tables, scene);
  if (root.has("picture")) fit_picture().read_into(root.table("picture"), scene);
  for (const Overlay& over : scene.overlays) check_overlay(over);
  return scene;
}

FitScene read_fit(const fs::path& file) { return parse_fit(hydro::io::read_text(file), file); }

}  // namespace froude::scene
