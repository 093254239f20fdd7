#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/io/csv.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
constexpr std::string_view neighbours = "neighbours of ";

/// "m1" and "m2", "m2" and "m3" … of the copies of one body.
std::vector<Between> neighbour_pairs(const Record& record, const Located<std::string>& text,
                                     const std::vector<Body>& bodies) {
  const std::string family = text.value.substr(neighbours.size());
  std::vector<Between> pairs;
  std::vector<std::string> families;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].copy > 0) families.push_back(bodies[i].family);
    if (bodies[i].family == family && bodies[i].copy > 1)
      pairs.push_back({static_cast<int>(i) - 1, static_cast<int>(i)});
  }
  if (!pairs.empty()) return pairs;
  const std::string near = hydro::nearest(family, families);
  const bool known = std::find(families.begin(), families.end(), family) != families.end();
  throw record.wrong(
      "between",
      fmt::format("names no neighbours: \"{}\" {}", family, known ? "has one copy only" : "is not a body with copies"),
      near.empty() || known ? "give the body copies = { count = 2, step = \"(13, 0, 0) m\" }"
                            : fmt::format("did you mean \"{}{}\"?", neighbours, near));
}

Eigen::Vector3d vector_or_zero(const Record& record, std::string_view key) {
  if (!record.has(key)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d value = record.vector(key);
  if (value.isZero(0))
    throw record.wrong(key, "is zero throughout", "leave the key out: what is not named does not act");
  return value;
}

/// Elongations increase and tensions do not fall: what gives way as it is pulled has no place that it stays at.
void check_table(const Record& record, const AxialConnector& axial) {
  const auto& x = axial.elongations;
  const auto& f = axial.tensions;
  if (x.size() < 2) throw record.wrong("table", "holds fewer than two points", "give two or more");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]) || !(f[i] >= f[i - 1]))
      throw record.wrong(
          "table", fmt::format("has the point ({:g} m, {:g} N) after ({:g} m, {:g} N)", x[i], f[i], x[i - 1], f[i - 1]),
          "elongations must increase, and tensions must not fall");
}

StiffnessSwitch read_switch(const Record& record, const std::vector<Body>& bodies) {
  const std::string& watch = record.text("watch");
  const auto dot = watch.rfind('.');
  const auto mode = dot == std::string::npos
                        ? hydro::mode_names.end()
                        : std::find(hydro::mode_names.begin(), hydro::mode_names.end(), watch.substr(dot + 1));
  if (mode == hydro::mode_names.end())
    throw record.wrong("watch", "is not a motion", "write a body and a mode, like \"m2.surge\"");
  StiffnessSwitch out{body_named(record, {watch.substr(0, dot), record["watch"].place}, bodies),
                      static_cast<hydro::Mode>(mode - hydro::mode_names.begin()),
                      record.si("every"),
                      record.si("window"),
                      record.si("hysteresis"),
                      record.si("dwell"),
                      {}};
  for (const Record& setting : record.tables("settings")) {
    const double from = setting.si("from");
    if (out.settings.empty() ? from != 0 : !(from > out.settings.back().from))
      throw setting.wrong("from", out.settings.empty() ? "is not 0 s in the first setting" : "does not ascend",
                          "give settings from short periods to long ones, the first from \"0 s\"");
    out.settings.push_back({from, setting.si("stiffness")});
  }
  return out;
}

std::variant<AxialConnector, BushingConnector> read_kind(const Record& record, const std::filesystem::path& file,
                                                         const std::vector<Body>& bodies) {
  if (record.text("kind") == "bushing")
    return BushingConnector{vector_or_zero(record, "stiffness"), vector_or_zero(record, "damping"),
                            vector_or_zero(record, "rotational_stiffness"),
                            vector_or_zero(record, "rotational_damping")};
  AxialConnector axial;
  const auto number = [&](std::string_view key) { return record.has(key) ? record.si(key) : 0.0; };
  axial.stiffness = number("stiffness");
  axial.cubic = number("cubic");
  axial.damping = number("damping");
  axial.quadratic_damping = number("quadratic_damping");
  axial.tension_only = record.text("kind") == "cable";
  if (record.has("table")) {
    const auto table = hydro::io::CsvTable::read(beside(file, record.text("table")));
    axial.elongations = table.column("elongation", hydro::dim::length);
    axial.tensions = table.column("tension", hydro::dim::force);
    check_table(record, axial);
  }
  if (record.has("rest_length") && record.text("rest_length").empty()) axial.rest_length = record.si("rest_length");
  if (record.has("switch")) axial.switching = read_switch(record.table("switch"), bodies);
  return axial;
}

/// A load along the line between two points needs two points.
void check_apart(const Record& record, const Connector& c, const std::vector<Body>& bodies) {
  if (!std::holds_alternative<AxialConnector>(c.kind)) return;
  const auto& first = bodies[static_cast<std::size_t>(c.first)];
  const Eigen::Vector3d a = first.position + c.first_end;
  const Eigen::Vector3d origin =
      c.second ? bodies[static_cast<std::size_t>(*c.second)].position : Eigen::Vector3d::Zero();
  const Eigen::Vector3d b = origin + c.second_end;
  if ((b - a).norm() > 1e-9 * (1 + a.norm() + b.norm())) return;  // round-off of the positions
  throw record.wrong(
      "ends",
      fmt::format("of \"{}\" coincide at ({:g}, {:g}, {:g}) m; an axial connector has no direction there", c.name,
                  a.x(), a.y(), a.z()),
      "move the ends apart, or use kind = \"bushing\"");
}

double entry_of(const Record& matrix, const std::string& key, bool diagonal) {
  if (!matrix.has(key)) return 0;
  const double value = matrix.si(key);
  if (value == 0) throw matrix.wrong(key, "is zero", "leave the key out: what is not named does not act");
  if (diagonal && value < 0)
    throw matrix.wrong(key, "is negative: it would push the body away from rest",
                       "give it without the minus; what restores or damps is positive");
  return value;
}

Matrix6 read_matrix(const Record& mooring, std::string_view key) {
  Matrix6 out = Matrix6::Zero();
  if (!mooring.has(key)) return out;
  const Record& table = mooring.table(key);
  for (int i = 0; i < 6; ++i) {
    const std::string row(hydro::mode_names[static_cast<std::size_t>(i)]);
    out(i, i) = entry_of(table, row, true);
    for (int j = i + 1; j < 6; ++j)
      out(i, j) = out(j, i) =
          entry_of(table, row + "_" + std::string(hydro::mode_names[static_cast<std::size_t>(j)]), false);
  }
  return out;
}

/// v·Dv >= 0 for every v, or the mooring would be a source of power. Scaled to a unit diagonal, as the units differ.
void check_dissipates(const Record& mooring, const Matrix6& damping) {
  if (!mooring.has("damping")) return;
  Matrix6 scaled = damping;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(damping(i, i) * damping(j, j));
      if (scale > 0) scaled(i, j) /= scale;
    }
  const double least = hydro::dense::symmetric_eigenvalues(scaled)[0];
  if (least < -1e-9)  // round-off of numbers of order one
    throw mooring.table("damping").refused(
        "gives power to some motion",
        "every entry a_b must keep a_b² <= a · b, and the whole must be positive semidefinite");
}

}  // namespace

void Names::add(const std::string& name, const Place& place) {
  const auto [at, fresh] = taken_.try_emplace(name, place);
  if (fresh) return;
  throw hydro::InputError(fmt::format("the name \"{}\" is taken at {}", name, at->second.str()), place,
                          "choose another name");
}

std::vector<std::string> Names::of(const Record& record, std::size_t count) {
  const std::string& base = record.text("name");
  std::vector<std::string> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (record["name"].defaulted)
      out.push_back(fmt::format("{}{}", base, ++unnamed_[base]));
    else
      out.push_back(count == 1 ? base : fmt::format("{}{}", base, i + 1));
    add(out.back(), record["name"].place);
  }
  return out;
}

std::vector<Between> read_between(const Record& record, const std::vector<Body>& bodies, GroundFirst ground_first) {
  const auto& texts = record["between"].texts;
  if (texts.size() == 1 && texts[0].value.starts_with(neighbours)) return neighbour_pairs(record, texts[0], bodies);
  if (texts.size() != 2)
    throw record.wrong("between", "does not name two ends",
                       "write [\"a\", \"b\"], [\"a\", \"ground\"] or \"neighbours of m\"");
  if (texts[0].value == "ground" && ground_first == GroundFirst::refused)
    throw record.wrong("between", "begins with the ground", "write the body first, then \"ground\"");
  const auto end = [&](const Located<std::string>& name) {
    return name.value == "ground" ? std::nullopt : std::optional<int>(body_named(record, name, bodies));
  };
  return {{end(texts[0]), end(texts[1])}};
}

int body_named(const Record& record, const Located<std::string>& name, const std::vector<Body>& bodies) {
  std::vector<std::string> known{"ground"};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name.value) return static_cast<int>(i);
    known.push_back(bodies[i].name);
  }
  const std::string near = hydro::nearest(name.value, known);
  throw hydro::InputError(fmt::format("{} refers to \"{}\", but there is no such body", record.title(), name.value),
                          name.place,
                          near.empty() ? "give a [[body]] this name" : fmt::format("did you mean \"{}\"?", near));
}

std::vector<int> bodies_on(const Record& record, std::string_view key, const std::vector<Body>& bodies) {
  std::vector<bool> chosen(bodies.size());
  for (const auto& pattern : record[key].texts) {
    bool any = false;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (matches(pattern.value, bodies[i].name)) any = chosen[i] = true;
    if (!any) body_named(record, pattern, bodies);  // throws with the nearest name
  }
  std::vector<int> out;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (chosen[i]) out.push_back(static_cast<int>(i));
  return out;
}

namespace {

void build_lines(const Record& record, Names& names, Scene& scene) {
  const auto& from = record["from"].points.front();
  const auto& to = record["to"].points.front();
  if (from.size() != to.size())
    throw record.wrong("to", fmt::format("stands for {} points and from for {}", to.size(), from.size()),
                       "use as many ± in one as in the other");
  const double displaced = scene.water.density * std::numbers::pi / 4 * std::pow(record.si("diameter"), 2);
  if (!(record.si("mass_per_length") > displaced))
    throw record.wrong(
        "mass_per_length",
        fmt::format("is less than the {:.4g} kg/m of water that the line displaces: it floats", displaced),
        "a catenary hangs; give a heavier or a thinner line");
  std::optional<CatenaryLine::Table> table;
  if (record.has("table")) {
    const Record& of = record.table("table");
    table = {of.si("reach"), of.si("tolerance"), of.place()};
  }
  const auto on = bodies_on(record, "on", scene.bodies);
  const auto name = names.of(record, on.size() * from.size());
  for (std::size_t b = 0, n = 0; b < on.size(); ++b)
    for (std::size_t k = 0; k < from.size(); ++k, ++n)
      scene.lines.push_back({name[n], on[b], from[k], to[k], record.si("length"), record.si("mass_per_length"),
                             record.si("diameter"), record.si("axial_stiffness"), record.has("on_bed"), table,
                             record.place()});
}

}  // namespace

void build_moorings(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("mooring")) {
    if (record.text("kind") == "catenary") {
      build_lines(record, names, scene);
      continue;
    }
    const Matrix6 stiffness = read_matrix(record, "stiffness"), damping = read_matrix(record, "damping");
    check_dissipates(record, damping);
    const auto on = bodies_on(record, "on", scene.bodies);
    const auto name = names.of(record, on.size());
    for (std::size_t b = 0; b < on.size(); ++b)
      scene.moorings.push_back({name[b], on[b], stiffness, damping, record.place()});
  }
}

void build_connectors(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("connector")) {
    const auto pairs = read_between(record, scene.bodies, GroundFirst::refused);
    if (pairs.front().second == pairs.front().first)
      throw record.wrong("between", "joins a body to itself", "name two bodies, or a body and the ground");
    const auto& ends = record["ends"].points;
    const auto kind = read_kind(record, scene.file, scene.bodies);
    const auto name = names.of(record, pairs.size() * ends[0].size());
    for (std::size_t p = 0, n = 0; p < pairs.size(); ++p)
      for (std::size_t k = 0; k < ends[0].size(); ++k, ++n) {
        scene.connectors.push_back(
            {name[n], *pairs[p].first, pairs[p].second, ends[0][k], ends[1][k], kind, record.place()});
        check_apart(record, scene.connectors.back(), scene.bodies);
      }
  }
}

}  // namespace froude::scene
