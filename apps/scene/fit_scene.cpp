/// \file  A scene that fits: its measurements, what is asked of them, and the kinds of fit there are.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"
#include "scene/fit_tables.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
namespace fs = std::filesystem;
using hydro::InputError;

const Table& data_channels() {
  static const Table table{
      .title = "[data.channels]",
      .meaning = "which column of the files plays which part",
      .keys = {
          text("time", "all but towing: time").optional(),
          texts("force",
                "morison, towing, radiation with a position, friction ramp of a slider: measured force, positive along "
                "positive velocity: of the water on a fixed body, or what load cells carry; several columns are added "
                "up, and \"-F2\" is F2 turned round")
              .optional(),
          text("velocity", "morison: of the water, or of the body, whichever moves; where both move, of the body")
              .optional(),
          text("acceleration", "morison: as velocity; left out: from the velocity or position").optional(),
          text("position", "morison: as velocity, instead of it; decay, radiation: the motion").optional(),
          text(
              "cross_velocity",
              "morison, where water moves: velocity across both the force and the axis: drag is then sqrt(u^2 + w^2) u")
              .optional(),
          text("elevation",
               "morison, where water moves: surface at a probe, in place of the water's velocity; needs [model] wave")
              .optional(),
          text("water_velocity", "morison, both move: of the water where the body is").optional(),
          text("water_acceleration", "morison, both move: as water_velocity; left out: from it").optional(),
          text("angle", "decay, radiation: the motion, in place of a position").optional(),
          text("torque", "friction ramp of a hinge, and radiation with an angle: the measured torque").optional(),
          text("speed", "towing: speed of the carriage").optional(),
          text("speed_sd", "towing: standard deviation of the speed").optional(),
          text("force_sd", "towing: standard deviation of the force").optional()}};
  return table;
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

void check_signal(const Record& record, MotionModel::Signal& out) {
  if (record.has("column") != record.has("deviation"))
    throw record.has("column")
        ? record.refused("needs the key \"deviation\"", "add deviation = \"0.5 deg\": it weighs the columns")
        : record.wrong("deviation", "does not go with a track", "the track's own covariances weigh it: leave it out");
  if (record.has("between") && out.between.size() != 2)
    throw record.wrong("between", "must name two markers",
                       "the angle is that of the line from the first to the second");
  if (record.has("marker") && !record.has("along"))
    throw record.refused("needs the key \"along\"", "add along = \"x\", \"y\" or \"z\"");
  if (!record.has("deviation")) out.deviation.place = record.place();
}

const Table& track_units() {
  static const Table table{
      .title = "[data.units]",
      .meaning = "of a track whose columns do not say",
      .keys = {text("time", "\"s\", \"ms\"").optional(), text("position", "\"px\", or a length: \"mm\"").optional()}};
  return table;
}

const Binding<MotionModel::Signal>& data_signal() {
  using Signal = MotionModel::Signal;
  static const auto table =
      Binding<Signal>("[[data.signal]]", "motion: a column of the files, and what of a run it should be")
          .optional(text("column", "of the files, with its unit"), &Signal::column)
          .optional(
              texts("between",
                    "two markers of a track: the signal is the angle of the line from the first to the second, "
                    "counted as that signal is: below the horizontal (polar), or about the axis across the picture"),
              &Signal::between)
          .optional(text("marker", "a marker of a track: the signal is one of its coordinates"), &Signal::marker)
          .key(text("of", "signal of the run: \"buoy.heave\", \"dropper.link2.polar\""), &Signal::of)
          .optional(text("deviation",
                         "standard deviation of the noise, \"0.5 deg\": weighs the columns; a track has its own"),
                    &Signal::deviation)
          .optional(text("along", "which coordinate").one_of({"x", "y", "z"}).only_beside("marker"), &Signal::along)
          .optional(quantity("zero", dim::angle, "direction of the line where the signal is zero; left out: 0")
                        .only_beside("between"),
                    &Signal::zero)
          .exactly_one_of({"column", "between", "marker"})
          .then(check_signal);
  return table;
}

const Binding<FitScene>& fit_data() {
  static const auto table =
      Binding<FitScene>("[data]", "the measurements")
          .optional(texts("files", "CSV, relative to the scene; * stands for any characters of a file's name"),
                    put_files)
          .optional(
              text("runs",
                   "morison, decay: CSV with one row for each run: the column file, and of morison any of zero, "
                   "delay, diameter, length, density, viscosity and mass_beyond_load_cells, which then hold for that "
                   "run; other columns are carried into the results"),
              [](const Value& runs, FitScene& scene) {
                check_kind<MorisonModel, DecayModel>(scene, runs);
                detail::put(runs, scene.run_table);
              })
          .key(inner_table("channels", data_channels()).or_default("", "see its keys"))
          .optional(texts("columns", "motion, of a track: names of all its columns, where the file has none"),
                    [](const Value& names, FitScene& scene) {
                      only_in_fits_of<MotionModel>(scene, names).columns = names.texts;
                    })
          .optional(inner_table("units", track_units()),
                    [](const Value& units, FitScene& scene) {
                      auto& motion = only_in_fits_of<MotionModel>(scene, units, "write units in the header: force [N]");
                      const Record& record = units.records.front();
                      if (record.has("time")) motion.time_unit = record.text("time");
                      if (record.has("position")) motion.position_unit = record.text("position");
                    })
          .optional(inner_tables("signal", data_signal().table()),
                    [](const Value& signals, FitScene& scene) {
                      auto& out = only_in_fits_of<MotionModel>(scene, signals, "name [data.channels] instead").signals;
                      for (const Record& signal : signals.records) out.push_back(data_signal().read(signal));
                    })
          .optional(
              texts("calibration",
                    "morison: one CSV for each force channel, with columns force and voltage (and cycle, where there "
                    "are several): the channel is then in volts"),
              [](const Value& files, FitScene& scene) { check_kind<MorisonModel>(scene, files); })
          .optional(text("zero", "morison: CSV of a run at rest, with the same force channels: its mean is taken off"),
                    to_models("leave it out", &MorisonModel::zero_run))
          .exactly_one_of({"files", "runs"});
  return table;
}

const Words<::fit::IntervalMethod> interval_methods{{"effective samples", ::fit::IntervalMethod::effective_samples},
                                                    {"cycle clusters", ::fit::IntervalMethod::cycle_clusters},
                                                    {"block bootstrap", ::fit::IntervalMethod::block_bootstrap}};
const Words<std::optional<::fit::Law>> laws{
    {"constant", ::fit::Law::constant},   {"kc", ::fit::Law::kc}, {"re", ::fit::Law::re}, {"beta", ::fit::Law::beta},
    {"kc and re", ::fit::Law::kc_and_re}, {"best", std::nullopt}};

Binding<FitScene> intervals() {
  return Binding<FitScene>("[ask.intervals]", "how sure to be")
      .key(number("level", "probability that the interval covers the truth")
               .within(Limit::open_fraction)
               .or_default("0.95", "the usual level"),
           &FitScene::confidence)
      .key(text("method", "morison: how the residuals' memory is counted")
               .one_of(words_of(interval_methods))
               .or_default("effective samples", "sharpest where residuals are stationary"),
           [](const Value& method, FitScene& scene) {
             check_kind<MorisonModel>(scene, method);
             if (auto* morison = std::get_if<MorisonModel>(&scene.model))
               morison->force.method = value_for(interval_methods, method.text);
           });
}

/// What the several kinds of fit leave out.
void check_coefficients(const Value& coefficients, FitScene& scene) {
  check_kind<MorisonModel, TowingModel, DecayModel>(scene, coefficients,
                                                    std::holds_alternative<MotionModel>(scene.model)
                                                        ? "leave it out: what is fitted are the [[model.parameter]]"
                                                        : "leave it out");
}

const Binding<FitScene>& fit_ask() {
  const std::string leave = "leave it out";
  static const auto table =
      Binding<FitScene>("[ask]", "what is wanted of a fit")
          .optional(
              texts("coefficients",
                    "all but motion, where they are the parameters: drag cd, inertia cm, added mass ca; towing knows "
                    "cd alone; decay: the damping terms that act, linear, quadratic, cubic, coulomb, and memory: a "
                    "pair of poles of the water's")
                  .one_of({"cd", "cm", "ca", "linear", "quadratic", "cubic", "coulomb", "memory"}),
              check_coefficients)
          .table("intervals", intervals())
          .or_default()
          .optional(
              texts("accept",
                    "motion, towing, decay: checks whose failure shall not keep values back. \"residuals\": larger "
                    "than the stated deviations allow, or of a decay than half of its variance; intervals are then as "
                    "wide as the residuals make them, and the report says by how much")
                  .one_of({"residuals"}),
              to_models(leave + ": nothing is kept back there for its residuals", &MotionModel::accept_residuals,
                        &TowingModel::accept_residuals, &DecayModel::accept_residuals))
          .key(effect("robust", "morison: wild samples of the force pull less (Huber)"),
               [](const Value& v, FitScene& scene) { only_in_fits_of<MorisonModel>(scene, v).force.robust = true; })
          .key(effect("profile",
                      "decay, motion: intervals of damping or parameters from the likelihood itself, which need not be "
                      "symmetric"),
               to_models(leave + ": that model is linear, and its intervals are those of the likelihood",
                         &DecayModel::profile, &MotionModel::profile))
          .key(effect("together",
                      "decay: one set of coefficients for all runs, with a start and a rest position for each, beside "
                      "the fit of each run alone"),
               to_models(leave, &DecayModel::together))
          .key(effect("cycles", "morison: coefficients of each cycle too; needs [prepare] window in full cycles"),
               to_models(leave, &MorisonModel::cycles))
          .optional(
              text("law",
                   "morison: coefficients of all runs against KC, Re or beta = Re/KC, with runs that differ by chance")
                  .one_of(words_of(laws)),
              [](const Value& law, FitScene& scene) {
                only_in_fits_of<MorisonModel>(scene, law).law = {value_for(laws, law.text)};
              })
          .key(effect("sensitivity",
                      "morison: the fit repeated with other cutoffs, bandwidths and halves of the window; decay: with "
                      "each half of the record"),
               to_models(leave, &MorisonModel::sensitivity, &DecayModel::sensitivity));
  return table;
}

/// In the order of the reference. A further kind is a line here and an alternative of FitModel.
const Binding<FitScene>& fit_model() {
  static const auto table = Binding<FitScene>("[model]", "what the measurement is taken for")
                                .key(text("kind", "of experiment"))
                                .place(&FitScene::model_place)
                                .variant(MorisonModel::kind, morison_keys(), &FitScene::model)
                                .variant(TowingModel::kind, towing_keys(), &FitScene::model)
                                .variant(MotionModel::kind, motion_keys(), &FitScene::model)
                                .variant(DecayModel::kind, decay_keys(), &FitScene::model)
                                .variant(RadiationModel::kind, radiation_keys(), &FitScene::model)
                                .variant(FrictionRampModel::kind, friction_ramp_keys(), &FitScene::model);
  return table;
}

void read_prepare(const Record& prepare, FitScene& scene) {
  const auto read = [&](auto& model) {
    if constexpr (requires { model.prepare; })
      prepare_binding().read_into(prepare, model.prepare);
    else
      throw prepare.refused(not_of_kind(model.kind), "leave it out: its steps are those of a force, or of a decay");
  };
  std::visit(read, scene.model);
}

}  // namespace

void read_channels(const FitTables& tables, const std::vector<std::string>& roles,
                   const std::vector<std::string>& needed, FitScene& scene) {
  const Record& channels = tables.channels();
  for (const Key& key : data_channels().keys) {
    const std::string& role = key.name;
    if (!channels.has(role)) continue;
    if (std::find(roles.begin(), roles.end(), role) == roles.end())
      throw channels.wrong(role, not_of_kind(scene.kind()), fmt::format("its channels are {}", fmt::join(roles, ", ")));
    if (role == "force") continue;  // may be several, see read_force()
    if (channels.text(role).empty()) throw channels.wrong(role, "is empty", "write the name of a column");
    scene.channels[role] = channels.text(role);
  }
  for (const std::string& role : needed)
    if (!channels.has(role))
      throw channels.refused(fmt::format("needs \"{}\" for a fit of kind \"{}\"", role, scene.kind()),
                             fmt::format("add {} = \"name of a column\"", role));
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

std::string word_of(::fit::IntervalMethod method) { return word_for(interval_methods, method); }

const Table& fit_schema() {
  static const Table table{
      .title = "a fit",
      .meaning = "coefficients from measurements",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               inner_table("data", fit_data().table()), inner_table("camera", camera_binding().table()).optional(),
               inner_table("prepare", prepare_binding().table()).optional(), inner_table("model", fit_model().table()),
               inner_table("ask", fit_ask().table())}};
  return table;
}

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
  if (root.has("title")) scene.title = root.text("title");
  fit_model().read_into(root.table("model"), scene);
  if (root.has("camera"))
    only_in_fits_of<MotionModel>(scene, root["camera"], "leave it out: a track is fitted by running a scene").camera =
        camera_binding().read(root.table("camera"));
  if (root.has("prepare")) read_prepare(root.table("prepare"), scene);
  fit_data().read_into(root.table("data"), scene);
  fit_ask().read_into(root.table("ask"), scene);
  const FitTables tables{root};
  std::visit([&](auto& model) { finish(tables, scene, model); }, scene.model);
  scene.force = read_force(tables.data(), scene);
  return scene;
}

FitScene read_fit(const fs::path& file) { return parse_fit(hydro::io::read_text(file), file); }

}  // namespace froude::scene
