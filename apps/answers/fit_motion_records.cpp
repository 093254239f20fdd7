#include "answers/fit_motion_records.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "hydro/io/atomic_file.hpp"
#include "scene/override.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
namespace fs = std::filesystem;
using hydro::InputError;

std::vector<Key> parameter_keys() {
  return {text("key", "its path: \"line.damping.linear\", \"body[1].initial.heave\", \"load.at.x\""),
          text("first", "where the search begins, \"0.001 kg/s\"; left out: what the scene writes").optional(),
          text("lowest", "bound, with its unit").optional(), text("highest", "bound, with its unit").optional()};
}

const Table& record_parameter() {
  static const Table table{.title = "[[data.record.parameter]]",
                           .meaning = "a number of the scene that is fitted to this record alone: how it began",
                           .keys = parameter_keys()};
  return table;
}

const Table& record_set() {
  static const Table table{.title = "[[data.record.set]]",
                           .meaning = "a number that the scene has otherwise in this record",
                           .keys = {text("key", "its path, as of a parameter: \"waves.period\""),
                                    text("value", "with its unit, \"1.4 s\"")}};
  return table;
}

/// "0.001 kg/s" in the unit that the scene writes at that place.
double in_unit(const Record& record, const char* key, const std::string& unit) {
  const hydro::Unit written = hydro::parse_unit(unit);
  try {
    const hydro::Quantity q = hydro::parse_quantity(record.text(key));
    if (hydro::compatible(q.dimension, written.dimension)) return q.si / written.factor;
  } catch (const InputError& e) {
    throw e.at(record[key].place);
  }
  throw record.wrong(key, fmt::format("has another dimension than the scene's {}", unit.empty() ? "number" : unit),
                     "write it in that unit");
}

/// The numbers that a record has otherwise.
std::vector<MotionModel::Parameter> read_set(const Record& of, const fs::path& scene) {
  const std::string text = hydro::io::read_text(scene);
  std::vector<MotionModel::Parameter> out;
  for (const Record& one : of.tables("set")) {
    const auto written = number_at(text, scene, one.text("key"), one["key"].place);
    out.push_back({{one.text("key"), in_unit(one, "value", written.unit)}, written.unit, one["key"].place});
  }
  return out;
}

void refuse_twice(const std::vector<MotionModel::Parameter>& first, const std::vector<MotionModel::Parameter>& second,
                  const char* rule, const char* remedy) {
  for (const auto& b : second)
    for (const auto& a : first)
      if (a.number.name == b.number.name && &a != &b)
        throw InputError(fmt::format("\"{}\" {}", b.number.name, rule), b.place, remedy);
}

/// Parameters that all share must be the same numbers, in the same units, in the scene of this record.
void check_shared(const MotionModel::Record& record, const std::vector<MotionModel::Parameter>& shared) {
  if (!record.scene) return;
  const std::string text = hydro::io::read_text(record.scene->value);
  for (const auto& q : shared)
    if (const auto written = number_at(text, record.scene->value, q.number.name, record.scene->place);
        written.unit != q.unit)
      throw InputError(
          fmt::format("\"{}\" is in {} in the scene of this record and in {} in that of [model]", q.number.name,
                      written.unit.empty() ? "no unit" : written.unit, q.unit.empty() ? "no unit" : q.unit),
          record.scene->place, "write it in the same unit in both");
}

void read_numbers(const Record& table, const MotionModel& motion, MotionModel::Record& out) {
  const fs::path& scene = out.scene ? out.scene->value : motion.scene.value;
  out.set = read_set(table, scene);
  out.parameters = read_parameters(table, scene);
  check_shared(out, motion.parameters);
  refuse_twice(out.set, out.set, "is set twice in this record", "set each number once");
  refuse_twice(motion.parameters, out.set, "is set in this record, and fitted to all", "set it, or fit it");
  refuse_twice(out.parameters, out.set, "is set in this record, and fitted", "set it, or fit it");
  refuse_twice(motion.parameters, out.parameters, "is fitted to all records already, by a [[model.parameter]]",
               "take it out there, and each record may have its own");
}

void refuse_same_names(const std::vector<MotionModel::Record>& records) {
  std::map<std::string, Place> known;
  for (const auto& r : records)
    if (!known.emplace(r.name, r.place).second)
      throw InputError(fmt::format("two records are called \"{}\"", r.name), r.place,
                       "give one a name of its own: name = \"second\"");
}

}  // namespace

const Table& model_parameter() {
  static const Table table{.title = "[[model.parameter]]",
                           .meaning = "motion: a number of the scene that is fitted, the same in all records",
                           .keys = parameter_keys()};
  return table;
}

std::vector<MotionModel::Parameter> read_parameters(const Record& of, const fs::path& scene) {
  const std::string text = hydro::io::read_text(scene);
  std::vector<MotionModel::Parameter> out;
  for (const Record& p : of.tables("parameter")) {
    const auto written = number_at(text, scene, p.text("key"), p["key"].place);
    MotionModel::Parameter q{{p.text("key"), written.value}, written.unit, p.place()};
    for (const auto& other : out)
      if (other.number.name == q.number.name) throw p.wrong("key", "stands twice", "fit each number once");
    const auto take = [&](const char* key, double& value) {
      if (p.has(key)) value = in_unit(p, key, q.unit);
    };
    take("first", q.number.first);
    take("lowest", q.number.lowest);
    take("highest", q.number.highest);
    if (q.number.first < q.number.lowest || q.number.first > q.number.highest)
      throw p.refused(fmt::format("begins at {} {}, outside its bounds", q.number.first, q.unit),
                      "widen them, or give first");
    out.push_back(std::move(q));
  }
  return out;
}

const Binding<MotionModel::Record>& motion_record() {
  using R = MotionModel::Record;
  static const auto table =
      Binding<R>("[[data.record]]",
                 "motion: one of several records, to which the same parameters are fitted; instead of `files`")
          .key(text("file", "CSV, relative to the scene; need not be evenly sampled"), &R::file)
          .optional(text("name", "of the record in the report; left out: that of its file"), &R::name)
          .optional(quantity("start", dim::time,
                             "time in the file at which the run begins; rows before are not fitted; left out: 0, of a "
                             "track [camera] from, or its first frame"),
                    [](const Value& v, R& out) {
                      out.start = v.number;
                      out.start_place = v.place;
                    })
          .optional(quantity("end", dim::time, "time in the file after which no row is fitted"), &R::end)
          .optional(text("scene", "that is run for this record, relative to the fit; left out: that of [model]"),
                    &R::scene)
          .table("camera", camera_binding(), &R::camera)
          .optional()
          .key(inner_tables("set", record_set()).optional())
          .key(inner_tables("parameter", record_parameter()).optional())
          .place(&R::place)
          .then([](const Record& record, R& out) {
            std::error_code unknown;
            if (!fs::is_regular_file(out.file.value, unknown))
              throw record.wrong("file", "is no file", fmt::format("looked for {}", out.file.value.string()));
            if (out.scene && !fs::is_regular_file(out.scene->value, unknown))
              throw record.wrong("scene", "is no file", fmt::format("looked for {}", out.scene->value.string()));
            if (out.end && out.start && *out.end <= *out.start)
              throw record.wrong("end", "must be later than the start", "give it in the file's own time");
            if (out.name.empty()) out.name = out.file.value.stem().string();
          });
  return table;
}

void read_records(const FitTables& t, const FitScene& scene, MotionModel& motion) {
  const auto& tables = t.data().tables("record");
  for (std::size_t i = 0; i < tables.size(); ++i) read_numbers(tables[i], motion, motion.records[i]);
  for (const auto& file : scene.files) {
    MotionModel::Record record;
    record.name = file.value.stem().string();
    record.file = file;
    record.place = file.place;
    motion.records.push_back(std::move(record));
  }
  refuse_same_names(motion.records);
}

}  // namespace froude::scene
