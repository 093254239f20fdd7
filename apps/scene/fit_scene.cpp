#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"
#include "scene/fit_models.hpp"

namespace froude::scene {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

const std::vector<std::string> all_channels{
    "time",      "force", "angle",    "velocity", "acceleration",   "position",           "cross_velocity",
    "elevation", "speed", "speed_sd", "force_sd", "water_velocity", "water_acceleration", "torque"};

/// Files that fit one entry of `files`, in alphabetical order. A `*` may stand in the file's name, not in a folder's.
void expand(const Record& data, const Located<std::string>& entry, const fs::path& scene,
            std::vector<Located<fs::path>>& out) {
  const fs::path path = beside(scene, entry.value);
  const std::string pattern = path.filename().string(), folder = path.parent_path().string();
  const auto refuse = [&](const std::string& rule, const std::string& remedy) {
    throw InputError(fmt::format("{} files: \"{}\" {}", data.title(), entry.value, rule), entry.place, remedy);
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

std::vector<Located<fs::path>> read_files(const Record& data, const fs::path& scene) {
  std::vector<Located<fs::path>> out;
  if (!data.has("files")) return out;
  for (const auto& entry : data["files"].texts) expand(data, entry, scene, out);
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  const auto twice =
      std::adjacent_find(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value == b.value; });
  if (twice != out.end())
    throw InputError(fmt::format("{} files holds {} twice", data.title(), twice->value.string()),
                     std::next(twice)->place, "name each file once, or the fit counts it twice");
  return out;
}

/// A kind of fit: its word in a scene, the roles that columns may and must play, and the reader of its model.
struct KindOfFit {
  std::string word;
  std::vector<std::string> channels, needed;
  FitModel (*read)(const FitTables&);
};

/// In the order of FitModel.
const std::vector<KindOfFit>& kinds_of_fit() {
  static const std::vector<KindOfFit> kinds{
      {"morison",
       {"time", "force", "velocity", "acceleration", "position", "cross_velocity", "elevation", "water_velocity",
        "water_acceleration"},
       {"time", "force"},
       read_morison},
      {"towing", {"speed", "force", "speed_sd", "force_sd"}, {"speed", "force"}, read_towing},
      {"decay", {"time", "position", "angle"}, {"time"}, read_decay},
      {"radiation", {"time", "position", "angle", "force", "torque"}, {"time"}, read_radiation},
      {"friction ramp", {"time", "torque", "force"}, {"time"}, read_friction_ramp},
      {"motion", {"time"}, {"time"}, read_motion}};
  return kinds;
}

/// Keys of a table that act in some kinds of fit only; without keys the table itself.
struct KeysOfSomeKinds {
  std::string_view table;
  std::vector<std::string_view> keys, kinds;
  const char* remedy = "leave it out";
};

const std::vector<KeysOfSomeKinds>& keys_of_some_kinds() {
  static const std::vector<KeysOfSomeKinds> all{
      {"prepare", {}, {"morison", "decay"}, "leave it out: its steps are those of a force, or of a decay"},
      {"prepare",
       {"resample", "delay", "derivative_bandwidth", "derivative_method", "low_pass", "notch", "moving_average",
        "mean_cycle"},
       {"morison"},
       "leave it out: what is fitted is the motion as it was recorded"},
      {"data", {"runs"}, {"morison", "decay"}},
      {"data", {"calibration", "zero"}, {"morison"}},
      {"data", {"signal"}, {"motion"}, "name [data.channels] instead"},
      {"ask",
       {"coefficients"},
       {"morison", "towing", "decay", "radiation", "friction ramp"},
       "leave it out: what is fitted are the [[model.parameter]]"},
      {"ask", {"coefficients"}, {"morison", "towing", "decay", "motion"}},
      {"ask", {"robust", "cycles", "law"}, {"morison"}},
      {"ask", {"sensitivity"}, {"morison", "decay"}},
      {"ask", {"together"}, {"decay"}},
      {"intervals", {"method"}, {"morison"}},
      {"ask",
       {"profile"},
       {"decay", "motion"},
       "leave it out: that model is linear, and its intervals are those of the likelihood"},
      {"ask", {"accept"}, {"motion", "towing", "decay"}, "leave it out: nothing is kept back there for its residuals"}};
  return all;
}

void check_keys(const FitTables& t, const std::string& kind) {
  const std::string rule = fmt::format("does not apply to a fit of kind \"{}\"", kind);
  for (const KeysOfSomeKinds& some : keys_of_some_kinds()) {
    const Record& outer = some.table == "intervals" ? t.ask() : t.root;
    if (!outer.has(some.table) || std::find(some.kinds.begin(), some.kinds.end(), kind) != some.kinds.end()) continue;
    const Record& table = outer.table(some.table);
    if (some.keys.empty()) throw table.refused(rule, some.remedy);
    for (const std::string_view key : some.keys)
      if (table.has(key) && !table[key].defaulted) throw table.wrong(key, rule, some.remedy);
  }
}

std::map<std::string, std::string> read_channels(const Record& channels, const KindOfFit& kind) {
  std::map<std::string, std::string> out;
  for (const std::string& role : all_channels) {
    if (!channels.has(role)) continue;
    if (std::find(kind.channels.begin(), kind.channels.end(), role) == kind.channels.end())
      throw channels.wrong(role, fmt::format("does not apply to a fit of kind \"{}\"", kind.word),
                           fmt::format("its channels are {}", fmt::join(kind.channels, ", ")));
    if (role == "force") continue;  // may be several, see read_force()
    if (channels.text(role).empty()) throw channels.wrong(role, "is empty", "write the name of a column");
    out[role] = channels.text(role);
  }
  for (const std::string& role : kind.needed)
    if (!channels.has(role))
      throw channels.refused(fmt::format("needs \"{}\" for a fit of kind \"{}\"", role, kind.word),
                             fmt::format("add {} = \"name of a column\"", role));
  return out;
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
  if (!std::holds_alternative<MorisonModel>(scene.model) && out.size() > 1)
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

}  // namespace

std::string FitScene::kind() const { return kinds_of_fit().at(model.index()).word; }

bool is_fit(const fs::path& file) {
  return parse_document(hydro::io::read_text(file), file.string()).find("model") != nullptr;
}

FitScene parse_fit(std::string_view text, const fs::path& file) {
  const Node document = parse_document(text, file.string());
  check_version(document);
  if (const auto* body = document.find("body"); body != nullptr && document.find("model") == nullptr)
    throw InputError("this scene has a [[body]] and no [model]: it asks for motion, not for a fit", body->place,
                     "use `froude rao` or `froude run`");
  FitScene scene;
  scene.file = file;
  scene.text = text;
  const Record root = read_record(document, fit_schema(), scene.echo);
  const FitTables tables{root, file};
  const Record &data = tables.data(), &ask = tables.ask();
  const KindOfFit& kind = *std::find_if(kinds_of_fit().begin(), kinds_of_fit().end(),
                                        [&](const KindOfFit& k) { return k.word == tables.model().text("kind"); });
  if (root.has("title")) scene.title = root.text("title");
  check_keys(tables, kind.word);
  scene.channels = read_channels(tables.channels(), kind);
  scene.model = kind.read(tables);
  scene.model_place = tables.model().place();
  scene.confidence = tables.confidence();
  scene.force = read_force(data, scene);
  scene.files = read_files(data, file);
  if (data.has("runs")) scene.run_table = {{beside(file, data.text("runs")), data["runs"].place}};
  if (const auto* decay = std::get_if<DecayModel>(&scene.model))
    if (decay->together && data.has("files") && scene.files.size() < 2)
      throw ask.wrong("together", "needs two files at least", "name more files, or leave it out");
  return scene;
}

FitScene read_fit(const fs::path& file) { return parse_fit(hydro::io::read_text(file), file); }

}  // namespace froude::scene
