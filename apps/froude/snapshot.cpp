// `froude snapshot`: where lines and members of bodies are at chosen instants of a run.
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "answers/picture.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/record_file.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/io/hdf5.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

using Eigen::Vector3d;
using hydro::InputError;

/// The keys that acted in the run, as its result keeps them.
class RunSettings {
 public:
  explicit RunSettings(const Path& file) : file_(file) {}
  /// Empty where the scene said nothing.
  std::string of(const std::string& key) const {
    if (!file_.has_attribute(group, key)) return "";
    std::string text = file_.text_attribute(group, key);
    if (const std::size_t end = text.rfind(" (default)"); end != std::string::npos) text.erase(end);
    return text;
  }
  bool has(const std::string& key) const { return file_.has_attribute(group, key); }
  /// "line[2]" of the line of that name; empty: there is none.
  std::string table(const std::string& kind, const std::string& name) const {
    for (int i = 1; has(fmt::format("{}[{}].name", kind, i)); ++i)
      if (of(fmt::format("{}[{}].name", kind, i)) == name) return fmt::format("{}[{}]", kind, i);
    return "";
  }
  /// Texts of a list, or the one that stands alone.
  std::vector<std::string> texts(const std::string& key) const {
    std::string all = of(key);
    if (!all.empty() && all.front() == '[') all = all.substr(1, all.size() - 2);
    std::vector<std::string> out;
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t end = std::min(all.find(", ", at), all.size());
      out.push_back(all.substr(at, end - at));
      at = end + 2;
    }
    return out;
  }

 private:
  static constexpr const char* group = "/provenance/settings";
  hydro::io::Hdf5Reader file_;
};

/// A line, or a member of a body: points one after the other, each over the samples of the run.
struct Chain {
  std::string name;
  std::vector<std::function<Vector3d(std::size_t sample)>> points;
};

/// Three signals of the record that end in x, y and z.
std::function<Vector3d(std::size_t)> recorded_place(const RunResult& record, const std::string& point) {
  std::array<const Signal*, 3> of{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Signal& s : record.signals)
      if (s.name == fmt::format("{}.{}", point, "xyz"[axis])) of[axis] = &s;
  if (std::count(of.begin(), of.end(), nullptr) > 0) return {};
  return [of](std::size_t i) { return Vector3d(of[0]->values[i], of[1]->values[i], of[2]->values[i]); };
}

int segments_of(const RunSettings& settings, const std::string& table) {
  if (const std::string whole = settings.of(table + ".segments"); !whole.empty()) return std::stoi(whole);
  int sum = 0;
  for (int i = 1; settings.has(fmt::format("{}.part[{}].segments", table, i)); ++i)
    sum += std::stoi(settings.of(fmt::format("{}.part[{}].segments", table, i)));
  for (int i = 1; settings.has(fmt::format("{}.link[{}].length", table, i)); ++i) ++sum;
  return sum;
}

Chain line_in(const RunResult& record, const RunSettings& settings, const std::string& name, const Path& file) {
  const std::string table = settings.table("line", name);
  if (table.empty())
    throw InputError(fmt::format("the scene of this result has no line \"{}\"", name), {.file = file.string()},
                     "give the `name` of a [[line]]");
  Chain out{name, {}};
  const int last = segments_of(settings, table);
  for (int i = 0; i <= last; ++i) {
    auto place = recorded_place(record, fmt::format("{}.node{}", name, i));
    // What the ground holds still is no signal.
    const char* end = i == 0 ? "from" : i == last ? "to" : "";
    const std::string held = *end != 0 ? settings.of(fmt::format("{}.{}", table, end)) : "";
    const bool on_ground = !held.empty() && !settings.has(fmt::format("{}.on.{}", table, end));
    if (!place && on_ground) place = [at = hydro::parse_vector(held, hydro::dim::length)](std::size_t) { return at; };
    if (!place)
      throw InputError(
          fmt::format("the result keeps no place of node {} of \"{}\"", i, name), {.file = file.string()},
          fmt::format("ask for it with the others, [ask] run = {{ of = [\"{}.node*\"] }}, and run again", name));
    out.points.push_back(std::move(place));
  }
  return out;
}

/// A body where the scene places it.
struct PlacedBody {
  std::string name, table;  ///< "m3" of "body[1]"
  Vector3d at;              ///< m
};

/// Copies are m1, m2, …, in a grid m1_1, m1_2, ….
std::vector<PlacedBody> bodies_of(const RunSettings& settings) {
  const auto vector = [&](const std::string& key) { return hydro::parse_vector(settings.of(key), hydro::dim::length); };
  std::vector<PlacedBody> out;
  for (int b = 1; settings.has(fmt::format("body[{}].name", b)); ++b) {
    const std::string table = fmt::format("body[{}]", b), family = settings.of(table + ".name");
    const Vector3d first = vector(table + ".position");
    if (!settings.has(table + ".copies.count")) {
      out.push_back({family, table, first});
      continue;
    }
    const bool grid = settings.has(table + ".copies.rows");
    const int count = std::stoi(settings.of(table + ".copies.count")),
              rows = grid ? std::stoi(settings.of(table + ".copies.rows")) : 1;
    const Vector3d step = vector(table + ".copies.step"),
                   row_step = grid ? vector(table + ".copies.row_step") : Vector3d::Zero();
    for (int row = 1; row <= rows; ++row)
      for (int i = 1; i <= count; ++i)
        out.push_back({grid ? fmt::format("{}{}_{}", family, row, i) : fmt::format("{}{}", family, i), table,
                       first + (i - 1) * step + (row - 1) * row_step});
  }
  return out;
}

/// Those that a name or a pattern means. \throws InputError where there is none
std::vector<PlacedBody> bodies_named(const std::string& pattern, const RunSettings& settings, const Path& file) {
  std::vector<PlacedBody> out = bodies_of(settings);
  std::vector<std::string> names;
  for (const PlacedBody& body : out) names.push_back(body.name);
  std::erase_if(out, [&](const PlacedBody& body) { return !scene::matches(pattern, body.name); });
  if (out.empty())
    throw InputError(fmt::format("the scene of this result has no body \"{}\"", pattern), {.file = file.string()},
                     names.empty() ? "show lines, --line" : fmt::format("bodies are: {}", fmt::join(names, ", ")));
  return out;
}

/// Where a point of a body is, by the motions that the run keeps; modes that are not free stay at rest.
class BodyMotion {
 public:
  BodyMotion(const RunResult& record, const RunSettings& settings, const PlacedBody& body, const Path& file)
      : rest_(body.at) {
    const std::string& name = body.name;
    const auto free = settings.texts(body.table + ".free");
    for (std::size_t mode = 0; mode < 6; ++mode) {
      const std::string word(hydro::mode_names[mode]), signal = name + "." + word;
      for (const Signal& s : record.signals)
        if (s.name == signal) motions_[mode] = s.values;
      if (motions_[mode].empty() && std::find(free.begin(), free.end(), word) != free.end())
        throw InputError(
            fmt::format("the result keeps no {} of \"{}\"", word, name), {.file = file.string()},
            fmt::format("ask for all its motions, [ask] run = {{ of = [\"{}.*\"] }}, and run again", name));
    }
  }
  Vector3d place(std::size_t sample, const Vector3d& from_origin) const {
    std::array<double, 6> q{};
    for (std::size_t mode = 0; mode < 6; ++mode) q[mode] = motions_[mode].empty() ? 0 : motions_[mode][sample];
    return rest_ + Vector3d(q[0], q[1], q[2]) + dynamics::attitude_of({q[3], q[4], q[5]}) * from_origin;
  }

 private:
  Vector3d rest_;
  std::array<std::vector<double>, 6> motions_;
};

void add_members(const RunResult& record, const RunSettings& settings, const PlacedBody& body, const Path& file,
                 std::vector<Chain>& out) {
  const std::string& name = body.name;
  const auto motion = std::make_shared<const BodyMotion>(record, settings, body, file);
  const std::size_t before = out.size();
  for (int i = 1; settings.has(fmt::format("member[{}].on", i)); ++i) {
    const std::string table = fmt::format("member[{}]", i);
    const auto on = settings.texts(table + ".on");
    if (std::none_of(on.begin(), on.end(), [&](const auto& pattern) { return scene::matches(pattern, name); }))
      continue;
    const auto from = hydro::parse_vectors(settings.of(table + ".from"), hydro::dim::length),
               to = hydro::parse_vectors(settings.of(table + ".to"), hydro::dim::length);
    for (std::size_t k = 0; k < from.size(); ++k) {
      Chain member{name, {}};
      for (const Vector3d& end : {from[k], to[k]})
        member.points.push_back([motion, end](std::size_t sample) { return motion->place(sample, end); });
      out.push_back(std::move(member));
    }
  }
  if (out.size() == before)
    throw InputError(fmt::format("body \"{}\" has no [[member]], so there is nothing of it to draw", name),
                     {.file = file.string()}, "draw a body that has members, or a line");
}

/// The sample that is nearest to the time asked for. \throws InputError outside the record
std::size_t sample_at(const RunResult& record, const std::string& at, const Path& file) {
  const double t = hydro::parse_si(at, hydro::dim::time);
  constexpr double rounding = 1e-9;
  const double slack = rounding * (1 + std::abs(t));
  if (record.time.empty() || t < record.time.front() - slack || t > record.time.back() + slack)
    throw InputError(fmt::format("the run has no sample at {}", at), {.file = file.string()},
                     record.time.empty()
                         ? "run the scene again"
                         : fmt::format("give a time from {:.6g} to {:.6g} s", record.time.front(), record.time.back()));
  const auto after = std::lower_bound(record.time.begin(), record.time.end(), t);
  if (after == record.time.end()) return record.time.size() - 1;
  const auto i = static_cast<std::size_t>(after - record.time.begin());
  return i > 0 && t - record.time[i - 1] < record.time[i] - t ? i - 1 : i;
}

struct Snapshots {
  std::vector<Chain> chains;
  std::vector<std::size_t> samples;
  std::vector<double> times;  ///< of the samples, s
};

Snapshots snapshots_of(const SnapshotArguments& a) {
  if (a.lines.empty() && a.bodies.empty())
    throw InputError("a snapshot shows lines or bodies, and none is named", {.file = "command line"},
                     "give --line, or --body");
  if (a.file.extension() != ".h5" && a.file.extension() != ".nc")
    throw InputError("a snapshot needs the result itself, whose settings say what holds the ends of lines",
                     {.file = a.file.string()}, "give the .h5 of `froude run`");
  const RunResult record = read_run(a.file);
  const RunSettings settings(a.file);
  Snapshots out;
  for (const std::string& name : a.lines) out.chains.push_back(line_in(record, settings, name, a.file));
  for (const std::string& pattern : a.bodies)
    for (const PlacedBody& body : bodies_named(pattern, settings, a.file))
      add_members(record, settings, body, a.file, out.chains);
  for (const std::string& at : a.at) {
    out.samples.push_back(sample_at(record, at, a.file));
    out.times.push_back(record.time[out.samples.back()]);
  }
  // Points are read off here, while the record is there.
  for (Chain& chain : out.chains)
    for (auto& point : chain.points) {
      std::vector<Vector3d> places;
      for (const std::size_t sample : out.samples) places.push_back(point(sample));
      point = [places = std::move(places)](std::size_t k) { return places[k]; };
    }
  return out;
}

plot::Panel panel_of(const Snapshots& s, const std::string& plane) {
  const auto axis = [&](std::size_t i) { return static_cast<Eigen::Index>(plane[i] - 'x'); };
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();  // between one chain and the next
  plot::Panel out{.x = {.label = plane.substr(0, 1), .unit = "m"},
                  .y = {.label = plane.substr(1, 1), .unit = "m"},
                  .series = {},
                  .equal_scales = true};
  for (std::size_t k = 0; k < s.times.size(); ++k) {
    plot::Series one{.name = fmt::format("t = {:.6g} s", s.times[k]), .x = {}, .y = {}, .marks = true};
    for (const Chain& chain : s.chains) {
      for (const auto& point : chain.points) {
        const Vector3d at = point(k);
        one.x.push_back(at[axis(0)]);
        one.y.push_back(at[axis(1)]);
      }
      one.x.push_back(gap);
      one.y.push_back(gap);
    }
    out.series.push_back(std::move(one));
  }
  return out;
}

plot::Figure figure_of(const Snapshots& s, const SnapshotArguments& a) {
  plot::Figure out{.title = a.file.filename().string(), .panels = {}, .width = 800, .panel_height = 520};
  for (const std::string& plane : a.planes) out.panels.push_back(panel_of(s, plane));
  return out;
}

void write_table(const Snapshots& s, const Path& file) {
  std::vector<double> time, chain, point, x, y, z;
  for (std::size_t k = 0; k < s.times.size(); ++k)
    for (std::size_t c = 0; c < s.chains.size(); ++c)
      for (std::size_t i = 0; i < s.chains[c].points.size(); ++i) {
        const Vector3d at = s.chains[c].points[i](k);
        time.push_back(s.times[k]);
        chain.push_back(static_cast<double>(c + 1));
        point.push_back(static_cast<double>(i));
        x.push_back(at.x());
        y.push_back(at.y());
        z.push_back(at.z());
      }
  std::vector<std::string> names;
  for (std::size_t c = 0; c < s.chains.size(); ++c)
    names.push_back(fmt::format("chain {}: {}", c + 1, s.chains[c].name));
  hydro::io::write_csv(file,
                       {{"time", "s", &time},
                        {"chain", "", &chain},
                        {"point", "", &point},
                        {"x", "m", &x},
                        {"y", "m", &y},
                        {"z", "m", &z}},
                       names);
}

Report report_of(const Snapshots& s) {
  Report out;
  for (std::size_t k = 0; k < s.times.size(); ++k) {
    Report instant;
    instant.say("t = {:.6g} s", fact("time_s", s.times[k]));
    for (const Chain& chain : s.chains) {
      std::vector<Vector3d> places;
      Vector3d low = chain.points.front()(k), high = low;
      for (const auto& point : chain.points) {
        places.push_back(point(k));
        low = low.cwiseMin(places.back());
        high = high.cwiseMax(places.back());
      }
      Report one;
      one.say("  {}: {} points, x from {:.4g} to {:.4g}, y from {:.4g} to {:.4g}, z from {:.4g} to {:.4g} m",
              fact("name", chain.name), fact("points", places.size()), low.x(), high.x(), low.y(), high.y(), low.z(),
              high.z());
      Json list = Json::array();
      for (const Vector3d& at : places) list.push_back(json_of(at));
      one.keep("places_m", list);
      instant.one_of("shown", one);
    }
    out.one_of("instants", instant);
  }
  return out;
}

}  // namespace

void snapshot(const SnapshotArguments& arguments, const Console& console) {
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  {{"the result", arguments.file}});
  require_csv(arguments.output);
  require_picture(arguments.picture);
  const Snapshots found = snapshots_of(arguments);
  if (arguments.output) write_table(found, *arguments.output);
  if (arguments.picture) plot::write_picture(*arguments.picture, figure_of(found, arguments));
  tell(report_of(found).wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
