#include <fmt/format.h>

#include <cmath>

#include "hydro/base/dense.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

using hydro::Mode;

/// Data are mostly rounded to three or four digits, and a flat plate meets the bound exactly.
constexpr double inertia_rounding = 1e-3;

/// A rigid body's principal moments are positive and none exceeds the sum of the other two, because
/// I₁ + I₂ − I₃ = 2 ∫ x₃² dm >= 0 (derived in docs/guide/scenes.md).
void check_inertia(const Record& record, std::string_view key, const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d principal = hydro::dense::symmetric_eigenvalues(inertia);
  if (!(principal[0] > 1e-12 * principal[2]))  // round-off of the eigenvalues
    throw record.wrong(key, fmt::format("gives a principal moment of inertia of {:.6g} kg m^2", principal[0]),
                       "a rigid body has three positive ones; check the products of inertia");
  if (principal[2] > (principal[0] + principal[1]) * (1 + inertia_rounding))
    throw record.wrong(
        key,
        fmt::format("gives principal moments {:.6g}, {:.6g}, {:.6g} kg m^2; of a rigid body none exceeds "
                    "the sum of the other two (by more than {} of it)",
                    principal[0], principal[1], principal[2], inertia_rounding),
        "check the order of the components and the unit");
}

bool any_rotation(const std::array<bool, 6>& free) { return free[3] || free[4] || free[5]; }

Eigen::Matrix3d read_inertia(const Record& record, double mass, bool needed) {
  Eigen::Matrix3d inertia = mass * Eigen::Matrix3d::Identity();
  std::string_view key = "radii_of_gyration";
  if (record.has(key)) {
    inertia = (mass * record.vector(key).array().square()).matrix().asDiagonal();
  } else if (record.has("inertia")) {
    key = record["products_of_inertia"].defaulted ? "inertia" : "products_of_inertia";
    inertia = record.vector("inertia").asDiagonal();
    const Eigen::Vector3d products = record.vector("products_of_inertia");  // I = ∫ (r² δ − r rᵀ) dm
    inertia(0, 1) = inertia(1, 0) = -products[0];
    inertia(0, 2) = inertia(2, 0) = -products[1];
    inertia(1, 2) = inertia(2, 1) = -products[2];
  } else if (needed) {
    throw record.refused("may rotate and needs radii_of_gyration or inertia",
                         "give one of them, or free only translations: free = [\"surge\", \"heave\"]");
  } else {
    return inertia;
  }
  check_inertia(record, key, inertia);
  return inertia;
}

std::array<bool, 6> read_mode_list(const Record& record, std::string_view key) {
  std::array<bool, 6> named{};
  for (const auto& word : record[key].texts) named[static_cast<std::size_t>(hydro::parse_mode(word.value))] = true;
  return named;
}

std::map<Mode, double> read_modes(const Record& body, std::string_view key, const std::array<bool, 6>& free) {
  std::map<Mode, double> out;
  if (!body.has(key)) return out;
  const Record& table = body.table(key);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string_view mode = hydro::mode_names[i];
    if (!table.has(mode)) continue;
    if (!free[i]) throw table.wrong(mode, "moves a mode that is held", "add the mode to `free`, or leave it out here");
    out[static_cast<Mode>(i)] = table.si(mode);
  }
  return out;
}

int small_integer(const Record& record, std::string_view key, std::int64_t most) {
  const std::int64_t value = record[key].integer;
  if (value > most) throw record.wrong(key, fmt::format("is more than {}", most));
  return static_cast<int>(value);
}

Memory read_memory(const Record& radiation) {
  using enum Memory::Method;
  static const std::map<std::string, Memory::Method, std::less<>> methods{{"automatic", automatic},
                                                                          {"direct", direct},
                                                                          {"partitioned", partitioned},
                                                                          {"poles", poles},
                                                                          {"constant", constant}};
  Memory out;
  out.method = methods.at(radiation.text("method"));
  out.place = radiation["method"].place;
  if (radiation.has("memory_tolerance")) out.tolerance = radiation.si("memory_tolerance");
  if (radiation.has("memory")) out.length = radiation.si("memory");
  if (radiation.has("accept_error")) out.accepted_error = radiation.si("accept_error");
  if (out.length && (out.method == poles || out.method == constant))
    throw radiation.wrong("method", "has no length of memory", "leave out `memory`, or take a convolution");
  return out;
}

/// The axes are given where they pierce still water, whose height in body axes is known.
Cylinders::Equal read_equal_cylinders(const Record& record, double height_of_origin) {
  Cylinders::Equal out{record["at"].points.front(), record.si("diameter"), {}, {}};
  if (record.text("draught").empty()) out.draught = record.si("draught");
  if (record.has("top")) out.top = record.si("top");
  if (out.top && out.draught && *out.top >= *out.draught)
    throw record.wrong("top", "is not above the bottom", "both are depths, from still water down");
  for (const Eigen::Vector3d& p : out.at)
    if (std::abs(p.z() + height_of_origin) > 1e-9)
      throw record.wrong(
          "at", fmt::format("has z = {:.6g} m; still water is at {:.6g} m in body axes", p.z(), -height_of_origin),
          "give the axes at the height of still water");
  return out;
}

Cylinders read_cylinders(const Record& record, double height_of_origin) {
  Cylinders out{{read_equal_cylinders(record, height_of_origin)}, record["frequencies"].range, {}};
  for (const Record& other : record.tables("others"))
    out.types.push_back(read_equal_cylinders(other, height_of_origin));
  if (record.has("headings")) out.headings = record["headings"].range;
  return out;
}

Turning read_turning(const Record& record) {
  Turning out{record.si("from"), record.si("to"), record.si("spacing"), record.si("slower_than"), record.place()};
  if (!(out.from < out.to)) throw record.wrong("to", "is not beyond `from`", "from = \"-30 deg\", to = \"30 deg\"");
  return out;
}

Hydrodynamics read_hydrodynamics(const Record& record, const std::filesystem::path& file, double height_of_origin) {
  Hydrodynamics out;
  if (record.has("file")) {
    out.file = {beside(file, record.text("file")), record["file"].place};
    if (record.has("ulen")) out.ulen = record.si("ulen");
  } else {
    out.file.place = record["cylinders"].place;
    out.cylinders = read_cylinders(record.table("cylinders"), height_of_origin);
  }
  if (record.has("body")) out.body = {small_integer(record, "body", 100'000), record["body"].place};
  if (record.has("reference_point")) out.reference_point = record.vector("reference_point");
  if (record.has("displaced_volume")) out.displaced_volume = record.si("displaced_volume");
  if (record.has("centre_of_buoyancy")) out.centre_of_buoyancy = record.vector("centre_of_buoyancy");
  if (record.has("iperout")) out.iperout = small_integer(record, "iperout", 4);
  if (record.has("accept"))
    for (const auto& check : record["accept"].texts) out.accept.push_back(check.value);
  out.excitation = record.has("excitation");
  if (record.has("excitation_modes")) out.excited = read_mode_list(record, "excitation_modes");
  if (record.has("turning")) out.turning = read_turning(record.table("turning"));
  out.hydrostatics = record.has("hydrostatics");
  out.radiation = record.has("radiation");
  if (out.radiation) {
    const Record& radiation = record.table("radiation");
    out.memory = read_memory(radiation);
  }
  out.interaction_place = out.file.place;
  if (out.makes_waves()) {
    const std::string& word = record.text("interaction");
    out.interaction = word == "full" ? Interaction::full : word == "file" ? Interaction::file : Interaction::self;
    if (!record["interaction"].defaulted) out.interaction_place = record["interaction"].place;
  }
  return out;
}

Buoyancy read_buoyancy(const Record& record, const std::filesystem::path& file) {
  Buoyancy out;
  out.place = record.place();
  if (record.has("mesh")) out.mesh = {beside(file, record.text("mesh")), record["mesh"].place};
  if (record.has("unit")) out.unit = record.si("unit");
  if (record.has("freeboard")) out.freeboard = record.si("freeboard");
  if (record.has("cylinders")) {
    const Record& cylinders = record.table("cylinders");
    const auto &from = cylinders["from"].points.front(), &to = cylinders["to"].points.front();
    if (from.size() != to.size())
      throw cylinders.wrong("to", fmt::format("gives {} points, `from` gives {}", to.size(), from.size()),
                            "each cylinder needs both ends");
    for (std::size_t i = 0; i < from.size(); ++i) {
      if ((to[i] - from[i]).norm() <= 1e-9 * cylinders.si("diameter"))
        throw cylinders.wrong("to", "is where the cylinder begins", "give the middle of the other end");
      out.cylinders.push_back({from[i], to[i], cylinders.si("diameter") / 2});
    }
  }
  if (record.has("spheres"))
    for (const Eigen::Vector3d& at : record.table("spheres")["at"].points.front())
      out.spheres.push_back({at, record.table("spheres").si("diameter") / 2});
  return out;
}

/// Linear hydrostatics hold buoyancy and weight already.
void require_nothing_twice(const Record& record, const Body& body) {
  if (!body.hydrodynamics || !body.hydrodynamics->hydrostatics) return;
  if (body.weight)
    throw record.wrong("weight", "would act twice: linear hydrostatics are about the balance of buoyancy and weight",
                       "leave out `weight`");
  if (body.buoyancy)
    throw record.table("buoyancy")
        .refused("would act twice: linear hydrostatics hold buoyancy and weight",
                 "leave out `hydrostatics` and add weight = true, or leave out buoyancy");
}

Body read_body(const Record& record, const std::filesystem::path& file) {
  Body body;
  body.name = body.family = record.text("name");
  body.place = record.place();
  body.position = record.vector("position");
  body.mass = record.si("mass");
  body.free = read_mode_list(record, "free");
  const bool rotates = any_rotation(body.free);
  if (rotates && !record.has("centre_of_gravity"))
    throw record.refused("may rotate and needs centre_of_gravity", "add centre_of_gravity = \"(0, 0, 1.31) m\"");
  body.centre_of_gravity =
      record.has("centre_of_gravity") ? record.vector("centre_of_gravity") : Eigen::Vector3d::Zero();
  body.inertia = read_inertia(record, body.mass, rotates);
  body.initial = read_modes(record, "initial", body.free);
  body.initial_velocity = read_modes(record, "initial_velocity", body.free);
  if (record.has("hydrodynamics"))
    body.hydrodynamics = read_hydrodynamics(record.table("hydrodynamics"), file, body.position.z());
  body.net_load = record.has("net_load");
  body.weight = record.has("weight");
  if (record.has("buoyancy")) body.buoyancy = read_buoyancy(record.table("buoyancy"), file);
  require_nothing_twice(record, body);
  return body;
}

}  // namespace

std::vector<Body> build_bodies(const Record& root, const std::filesystem::path& file, Names& names) {
  std::vector<Body> bodies;
  for (const Record& record : root.tables("body")) {
    const Body one = read_body(record, file);
    const int count = record.has("copies") ? small_integer(record.table("copies"), "count", 100'000) : 0;
    if (count == 0) {
      names.add(one.name, record["name"].place);
      bodies.push_back(one);
    }
    for (int i = 1; i <= count; ++i) {
      Body copy = one;
      copy.copy = i;
      copy.name = fmt::format("{}{}", one.family, i);
      copy.position += (i - 1) * record.table("copies").vector("step");
      names.add(copy.name, record["name"].place);
      bodies.push_back(std::move(copy));
    }
  }
  return bodies;
}

}  // namespace froude::scene
