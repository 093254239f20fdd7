/// \file  `[joint.spring]`: a spring by a table of what was measured of it. (D50)
#include <fmt/format.h>

#include "dynamics/force/force_law.hpp"
#include "hydro/io/csv.hpp"
#include "scene/joint_property.hpp"

namespace froude::scene {
namespace {

using dynamics::LineLaw;

/// It may push and pull, and its load may fall: what has two places of rest turns over between them.
void read_spring(const Measure& m, const Record& record, LineLaw& out) {
  const auto table = hydro::io::CsvTable::read(beside(record.place().file, record.text("file")));
  out.table_x = table.column(m.coordinate_name, m.coordinate);
  out.table_force = table.column(m.load, m.force);
  const auto& x = out.table_x;
  if (x.size() < 2) throw record.wrong("file", "holds fewer than two points", "give two or more");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      throw record.wrong("file", fmt::format("has the {} {:g} after {:g}", m.coordinate_name, x[i], x[i - 1]),
                         fmt::format("let {} increase", m.coordinate_name));
}

Binding<LineLaw> spring_keys(const Measure& m) {
  return Binding<LineLaw>(m.of("[joint.spring]"),
                          "against the coordinate, by a table: air springs, magnets, springs "
                          "with two places of rest")
      .key(text("file", fmt::format("CSV beside the scene: columns {}, increasing, and {} against it; straight between "
                                    "points and beyond the ends",
                                    m.coordinate_name, m.load)))
      .then([m](const Record& record, LineLaw& out) { read_spring(m, record, out); });
}

}  // namespace

std::unique_ptr<const JointProperty> spring_of_joints() {
  return law_of_joints<LineLaw>(
      spring_keys, {.effect = "spring", .method = "straight between the points of a table", .thing = "the spring"});
}

}  // namespace froude::scene
