#pragma once
/// \file  Small networks of lines for tests.
#include "support/line_models.hpp"

namespace support {

/// Puts `more` behind the chains of `d`, and tells the number of its first node.
inline int append(Description& d, const Description& more) {
  const int first = static_cast<int>(d.nodes.size());
  d.begins.push_back(first);
  d.nodes.insert(d.nodes.end(), more.nodes.begin(), more.nodes.end());
  d.segments.insert(d.segments.end(), more.segments.begin(), more.segments.end());
  for (Held h : more.held) {
    h.node += first;
    d.held.push_back(h);
  }
  return first;
}

/// The same line as two, which meet at `node`: what that has of its own stays with the first.
inline Description cut_at(const Description& whole, int node) {
  Description out = whole;
  const auto at = out.nodes.begin() + node;
  out.nodes.insert(at + 1, Node{});
  out.begins = {node + 1};
  out.ties = {{node, node + 1}};
  for (Held& h : out.held)
    if (h.node > node) ++h.node;
  return out;
}

/// Places of the uncut line for the cut one.
inline Places cut_at(const Places& whole, int node) {
  Places out(3, whole.cols() + 1);
  out << whole.leftCols(node + 1), whole.rightCols(whole.cols() - node);
  return out;
}

/// `n` rods of a line, its ends free.
inline Description rods(int n, double length, double mass, double axial_stiffness) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{});
  Segment s = Segment::rod(length / n, mass / n);
  s.axial_stiffness = axial_stiffness;
  d.segments.assign(static_cast<std::size_t>(n), s);
  return d;
}
inline constexpr double stiff = std::numeric_limits<double>::infinity();

/// Two legs of 4 m from (±3, 0, 0) and a third of 2 m below them, which meet: nodes `n`, 2n + 1, and the third's first.
/// Returned with the places of what is held.
struct Bridle {
  Description d;
  State places;
  int knot;
};
inline Bridle bridle(int n, double axial_stiffness, double bob = 5) {
  Bridle out{rods(n, 4, 8, axial_stiffness), {}, n};
  const int second = append(out.d, rods(n, 4, 8, axial_stiffness)),
            third = append(out.d, rods(n, 2, 4, axial_stiffness));
  out.d.held = {{.node = 0}, {.node = second}};
  out.d.ties = {{n, second + n, third}};
  out.d.nodes.back().mass = bob;
  out.places = {.position = Places::Zero(3, std::ssize(out.d.nodes)),
                .velocity = Places::Zero(3, std::ssize(out.d.nodes)),
                .tension = Eigen::VectorXd::Zero(std::ssize(out.d.segments))};
  out.places.position.col(0) << 3, 0, 0;
  out.places.position.col(second) << -3, 0, 0;
  return out;
}

/// The largest difference of a kept segment from its length, m, of a network too.
inline double worst_length_of(const Line& line, const State& s) {
  double worst = 0;
  for (int j = 0; j < line.segments(); ++j)
    worst = std::max(worst, std::abs((s.position.col(line.first(j) + 1) - s.position.col(line.first(j))).norm() -
                                     line.segment(j).length));
  return worst;
}

}  // namespace support
