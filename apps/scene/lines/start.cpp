/// \file  `[line.start]`: a shape that was measured, with its velocities. (D114)
#include <fmt/format.h>

#include "scene/line_property.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

std::vector<Eigen::Vector3d> vectors_in(const Value& list, const hydro::Dimension& dimension) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& text : list.texts)
    out.push_back(placed(text.place, [&] { return hydro::parse_vector(text.value, dimension); }));
  return out;
}

const Binding<Line::Start>& line_start() {
  static const Binding<Line::Start> binding =
      Binding<Line::Start>("[line.start]",
                           "the line starts in this shape and with these velocities, as a film or a sensor told them; "
                           "links are brought to their lengths by the least motion")
          .key(texts("at",
                     "of its nodes, in their order, global: [\"(0.3, 0, -0.4) m\", ...]; without the ends that "
                     "are held"),
               [](const Value& list, Line::Start& out) { out.at = vectors_in(list, dim::length); })
          .optional(texts("velocity", "of the same nodes: [\"(0.1, 0, 0) m/s\", ...]; left out: at rest"),
                    [](const Value& list, Line::Start& out) { out.velocity = vectors_in(list, dim::velocity); })
          .place(&Line::Start::place);
  return binding;
}

void read_start(const Record& record, const Record& whole, Line& out) {
  if (out.from.meets || out.to.meets || out.fastened())
    throw record.refused("starts a line that is on a body or meets others, which begins with them",
                         "leave it out, or hold the line by the ground");
  for (const char* other : {"release", "prescribed"})
    if (whole.has(other))
      throw record.refused(fmt::format("says where the line starts, and so does [line.{}]", other),
                           "leave out one of them");
  Line::Start start = line_start().read(record);
  const std::size_t nodes = out.segments.size() - (out.to.at ? 1 : 0);
  for (const auto& [key, list] : {std::pair{"at", &start.at}, std::pair{"velocity", &start.velocity}})
    if (record.has(key) && list->size() != nodes)
      throw record.wrong(key, fmt::format("has {} nodes, the line has {} that are not held", list->size(), nodes),
                         "name all of them, in their order, without those that are held");
  if (start.velocity.empty()) start.velocity.assign(nodes, Eigen::Vector3d::Zero());
  out.start = std::move(start);
}

}  // namespace

LineProperty start_of_lines() { return {inner_table("start", line_start().table()).optional(), read_start}; }

}  // namespace froude::scene
