/// \file  `[[connector]]`
#include <fmt/format.h>

#include <numbers>

#include "hydro/io/csv.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using dynamics::BushingConnector;
using Axial = AxialConnector;

Binding<StiffnessSwitch> switching() {
  using S = StiffnessSwitch;
  using dynamics::PeriodSetting;
  const auto setting = Binding<PeriodSetting>("[[connector.switch.settings]]", "a stiffness from some period on")
                           .key(quantity("from", dim::time, "period; the first is \"0 s\"").within(Limit::not_negative),
                                &PeriodSetting::from)
                           .key(positive("stiffness", dim::stiffness, "of each connector"), &PeriodSetting::value);
  return Binding<S>("[connector.switch]",
                    "sets the stiffness by the period that dominates a signal, once two checks in turn agree")
      .key(text("watch", "a signal of the run: \"m2.surge\", \"wave.elevation\", \"spring1.force\""), &S::watch)
      .key(positive("every", dim::time, "from one check to the next"), &S::every)
      .key(positive("window", dim::time,
                    "of the signal that a check looks at; some periods; the first check is when it is full"),
           &S::window)
      .key(positive("hysteresis", dim::angular_velocity,
                    "by which the frequencies of two checks in turn may differ: \"0.001 Hz\""),
           &S::hysteresis)
      .key(quantity("dwell", dim::time, "least time between two switches")
               .within(Limit::not_negative)
               .or_default("0 s", "two checks that agree are enough"),
           &S::dwell)
      .tables("settings", setting, &S::settings)
      .then([](const Record& record, S& out) {
        out.hysteresis /= 2 * std::numbers::pi;
        for (std::size_t i = 0; i < out.settings.size(); ++i)
          if (i == 0 ? out.settings[i].from != 0 : !(out.settings[i].from > out.settings[i - 1].from))
            throw record.tables("settings")[i].wrong(
                "from", i == 0 ? "is not 0 s in the first setting" : "does not ascend",
                "give settings from short periods to long ones, the first from \"0 s\"");
      });
}

Key stiffness() { return positive("stiffness", dim::stiffness, "tension per elongation"); }
Key damping(const std::string& meaning) { return positive("damping", dim::damping, meaning); }
Key rest_length() {
  return positive("rest_length", dim::length, "without tension, or \"as placed\": the distance of the ends at rest")
      .one_of({"as placed"})
      .or_default("as placed", "so that the scene is at rest where it is placed");
}

Binding<Axial> axial() {
  return Binding<Axial>("", "a load along the line between its ends")
      .optional(stiffness(), &Axial::stiffness)
      .optional(quantity("cubic", dim::stiffness / dim::area, "tension per elongation cubed, beside stiffness"),
                &Axial::cubic)
      .only_beside({"stiffness"})
      .optional(damping("tension per rate of elongation"), &Axial::damping)
      .optional(positive("quadratic_damping", dim::force / (dim::velocity * dim::velocity),
                         "tension per rate of elongation times its size"),
                &Axial::quadratic_damping)
      .key(rest_length(), &Axial::rest_length)
      .only_beside({"stiffness"})
      .table("switch", switching(), &Axial::switching)
      .only_beside({"stiffness"})
      .at_least_one_of({"stiffness", "damping", "quadratic_damping"});
}

/// Elongations increase and tensions do not fall: what gives way as it is pulled has no place that it stays at.
void read_tension_table(const Record& record, Axial& out) {
  const auto table = hydro::io::CsvTable::read(beside(record.place().file, record.text("table")));
  const auto& x = out.table_x = table.column("elongation", dim::length);
  const auto& f = out.table_force = table.column("tension", dim::force);
  if (x.size() < 2) throw record.wrong("table", "holds fewer than two points", "give two or more");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]) || !(f[i] >= f[i - 1]))
      throw record.wrong(
          "table", fmt::format("has the point ({:g} m, {:g} N) after ({:g} m, {:g} N)", x[i], f[i], x[i - 1], f[i - 1]),
          "elongations must increase, and tensions must not fall");
}

Binding<Axial> tabulated() {
  return Binding<Axial>("", "as axial, with a spring by a table")
      .key(text("table",
                "CSV beside the scene: columns elongation [m], increasing, and tension [N], not falling; straight "
                "between points and beyond the ends"))
      .optional(damping("tension per rate of elongation"), &Axial::damping)
      .key(rest_length(), &Axial::rest_length)
      .then(read_tension_table);
}

Binding<Axial> cable() {
  return Binding<Axial>("", "as axial, but it never pushes: slack where it is shorter than its rest length")
      .key(stiffness(), &Axial::stiffness)
      .optional(damping("c: of D = cv acts S/(S + abs D) beside the spring's tension S, nearly nothing as it tightens"),
                &Axial::damping)
      .key(rest_length(), &Axial::rest_length)
      .then([](const Record&, Axial& out) { out.tension_only = true; });
}

Binding<BushingConnector> bushing() {
  Binding<BushingConnector> out("", "loads and moments along the axes of the first body");
  std::vector<std::string> names;
  const auto three = [&](const std::string& name, const hydro::Dimension& dimension, const std::string& axes,
                         Eigen::Vector3d BushingConnector::*member) {
    names.push_back(name);
    out.optional(vector(name, dimension, axes).within(Limit::not_negative), member)
        .then([name](const Record& record, BushingConnector&) {
          if (record.has(name) && record.vector(name).isZero(0))
            throw record.wrong(name, "is zero throughout", "leave the key out: what is not named does not act");
        });
  };
  three("stiffness", dim::stiffness, "along x, y, z", &BushingConnector::stiffness);
  three("damping", dim::damping, "along x, y, z", &BushingConnector::damping);
  three("rotational_stiffness", dim::rotational_stiffness, "about x, y, z", &BushingConnector::rotational_stiffness);
  three("rotational_damping", dim::rotational_damping, "about x, y, z", &BushingConnector::rotational_damping);
  return out.at_least_one_of(names);
}

const Binding<Connector>& connector() {
  static const auto binding =
      Binding<Connector>("[[connector]]", "joins a point of one body to a point of another, or to the ground")
          .keys({name_key("connector", "of the connector"), between_key(),
                 ends("ends",
                      "[end on the first, end on the second], body axes (ground: global axes); ± makes several, taken "
                      "in pairs"),
                 text("kind", "of connector")})
          .variant("axial", axial(), &Connector::kind)
          .variant("tabulated", tabulated(), &Connector::kind)
          .variant("cable", cable(), &Connector::kind)
          .variant("bushing", bushing(), &Connector::kind)
          .place(&Connector::place);
  return binding;
}

/// A load along the line between two points needs two points.
void check_apart(const Record& record, const Connector& c, const std::vector<Body>& bodies) {
  if (!std::holds_alternative<Axial>(c.kind)) return;
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

}  // namespace

const Table& connector_table() { return connector().table(); }

void build_connectors(const Record& root, Names& names, Scene& scene) {
  for (const Record& record : root.tables("connector")) {
    Connector made = connector().read(record);
    for (PointPair& pair : read_point_pairs(record, names, scene.bodies)) {
      static_cast<PointPair&>(made) = std::move(pair);
      check_apart(record, made, scene.bodies);
      scene.connectors.push_back(made);
    }
  }
}

}  // namespace froude::scene
