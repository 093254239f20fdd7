/// Bending stiffness, in the equations. (D106), (D107)
#include "equations.hpp"

namespace dynamics::line {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// What bends at node i: the energy is c/2 |Σ_k b_k x_k − e|² over the nodes from `first` on, e the direction of a
/// clamp.
struct Bend {
  int first, count;
  double b[3], c;
  Vector3d direction = Vector3d::Zero();
};

/// How the direction of a segment leaves a clamp at its node.
Bend clamped(const Line& line, int i, const Vector3d& direction) {
  const int j = line.before(i) < 0 ? line.after(i) : line.before(i);
  const double l = line.segment(j).length;
  return {.first = line.first(j), .count = 2, .b = {-1 / l, 1 / l, 0}, .c = line.bending(i), .direction = direction};
}

/// How the directions of both segments beside a node differ.
Bend between(const Line& line, int i) {
  const double l1 = line.segment(line.before(i)).length, l2 = line.segment(line.after(i)).length;
  return {.first = i - 1, .count = 3, .b = {1 / l1, -1 / l1 - 1 / l2, 1 / l2}, .c = line.bending(i)};
}

/// Calls f with what bends at each node that has stiffness.
template <class Function>
void each_bend(const Line& line, const Function& f) {
  for (int i = 0; i < line.nodes(); ++i) {
    if (line.bending(i) == 0) continue;
    const bool end = line.before(i) < 0 || line.after(i) < 0;
    f(end ? clamped(line, i, line.held(i)->clamp) : between(line, i));
  }
}

Vector3d strain(const Bend& bend, const Places& x) {
  Vector3d out = -bend.direction;
  for (int k = 0; k < bend.count; ++k) out += bend.b[k] * x.col(bend.first + k);
  return out;
}

}  // namespace

/// The energy is of second order in places, so that its forces in the middle of a step are also its means over it
/// (D79).
void Equations::add_bending(const Stage& stage, bool matrix) {
  if (!line_.bends()) return;
  each_bend(line_, [&](const Bend& bend) {
    const Vector3d pull = bend.c * strain(bend, x_);
    for (int k = 0; k < bend.count; ++k) {
      residual_.col(bend.first + k) += bend.b[k] * pull;
      if (!matrix) continue;
      for (int m = 0; m < bend.count; ++m)
        add_block(bend.first + k, bend.first + m, stage.x_by * bend.c * bend.b[k] * bend.b[m] * Matrix3d::Identity());
    }
  });
}

double Equations::stored_in_bending(const State& state) const {
  double sum = 0;
  each_bend(line_, [&](const Bend& bend) { sum += bend.c / 2 * strain(bend, state.position).squaredNorm(); });
  return sum;
}

}  // namespace dynamics::line
