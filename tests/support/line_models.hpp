#pragma once
/// \file  Small lines for tests.
#include <cmath>
#include <vector>

#include "dynamics/line/line.hpp"

namespace support {

using namespace dynamics::line;  // NOLINT: for tests alone

/// Segments one after the other in the plane y = 0, from a held origin, by angles below the horizontal.
inline State in_plane(const Line& line, const std::vector<double>& angles) {
  State s{.position = Places::Zero(3, line.nodes()), .velocity = Places::Zero(3, line.nodes()), .tension = {}};
  s.tension = Eigen::VectorXd::Zero(line.segments());
  for (int j = 0; j < line.segments(); ++j) {
    const double a = angles[static_cast<std::size_t>(j)];
    s.position.col(j + 1) = s.position.col(j) + line.segment(j).length * Eigen::Vector3d(std::cos(a), 0, -std::sin(a));
  }
  return s;
}

/// `n` massless links with bobs at their lower ends, hung at the origin.
inline Description pendulums(int n, double length = 1, double mass = 1) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{.mass = mass});
  d.nodes.front().mass = 0;
  d.segments.assign(static_cast<std::size_t>(n), Segment{.length = length});
  d.held = {{.node = 0}};
  return d;
}

/// Huijgen's model dropper: seven rigid links with pins, both ends held where the angles of scenario A leave them.
inline Description dropper() {
  Description d;
  d.nodes.assign(8, Node{.mass = 0.01385});
  for (int j = 0; j < 7; ++j) d.segments.push_back(Segment::rod(0.15, j % 2 == 0 ? 0.0195 : 0.0186));
  d.held = {{.node = 0}, {.node = 7}};
  return d;
}
inline const std::vector<double> dropper_angles{0.1559, 1.4463, 1.3535, 0.8355, -1.1678, -1.3835, -1.4650};

/// `n` segments of a line of 17 m and 14 kg/m, held at both ends; those `apart` stand in the state.
inline Description loop(int n) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{});
  d.segments.assign(static_cast<std::size_t>(n), Segment::bobs(17.0 / n, 14 * 17.0 / n));
  d.held = {{.node = 0}, {.node = n}};
  return d;
}
inline State ends_at(const Line& line, const Eigen::Vector3d& last) {
  State s{.position = Places::Zero(3, line.nodes()),
          .velocity = Places::Zero(3, line.nodes()),
          .tension = Eigen::VectorXd::Zero(line.segments())};
  s.position.col(line.nodes() - 1) = last;
  return s;
}

/// The largest difference of a segment from its length at rest, m.
inline double worst_length(const Line& line, const State& s) {
  double worst = 0;
  for (int j = 0; j < line.segments(); ++j)
    worst = std::max(worst, std::abs((s.position.col(j + 1) - s.position.col(j)).norm() - line.segment(j).length));
  return worst;
}

}  // namespace support
