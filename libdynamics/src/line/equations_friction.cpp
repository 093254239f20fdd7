/// What a bed does along itself to nodes that lie on it: it holds them by its shear until they slip. (D95)
#include "equations.hpp"

namespace dynamics::line {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// What the bed carries of the line at node i, N: its push, and what it takes off segments that rest in part.
double Equations::weight_on_bed(int i) const {
  double sum = push_[static_cast<std::size_t>(i)].force;
  if (const int j = line_.after(i); j >= 0) sum += sag_[static_cast<std::size_t>(j)].relief[0];
  if (const int j = line_.before(i); j >= 0) sum += sag_[static_cast<std::size_t>(j)].relief[1];
  return std::max(sum, 0.0);
}

namespace {

/// As much of a force as friction bears, and its derivatives by force and limit.
struct Capped {
  Vector2d value, by_limit = Vector2d::Zero();
  Matrix2d by_force = Matrix2d::Identity();

  Capped(const Vector2d& force, double limit) : value(force) {
    const double size = force.norm();
    if (size <= limit) return;
    by_limit = force / size;
    value = limit * by_limit;
    by_force = limit / size * (Matrix2d::Identity() - by_limit * by_limit.transpose());
  }
};

}  // namespace

// (D95)
void Equations::add_friction(const Stage& stage, const State& before, bool matrix) {
  const Bed& bed = line_.description().bed.front();
  friction_ = strain_ = Eigen::Matrix2Xd::Zero(2, line_.nodes());
  if (before.grip.cols() == 0) return;  // nothing has moved yet
  for (int i = 0; i < line_.nodes(); ++i) {
    const double limit = bed.friction * weight_on_bed(i), k = shear_stiffness(i), c = bed.damping * line_.bed_area(i);
    if (limit == 0 || line_.held(i) != nullptr) continue;
    const Vector2d start = before.position.col(i).head<2>();
    Vector2d end = x_.col(i).head<2>();
    if (stage.mean) end = 2 * end - start;  // x_ is in the middle of the step
    const Vector2d rate = stage.mean ? Vector2d((end - start) / stage.h) : Vector2d(v_.col(i).head<2>());
    const Capped spring(k * (end - before.grip.col(i)), limit), whole(spring.value + c * rate, limit);
    strain_.col(i) = spring.value / k;
    friction_.col(i) = -whole.value;
    residual_.col(i).head<2>() += whole.value;
    if (!matrix || stage.x_by == 0) continue;
    const double rate_by = stage.mean ? 1 / stage.h : stage.v_by;
    const Matrix2d by_end = whole.by_force * (k * spring.by_force + c * rate_by * Matrix2d::Identity());
    for (int r = 0; r < 2; ++r)
      for (int column = 0; column < 2; ++column)
        matrix_(place_index(i) + r, place_index(i) + column) += by_end(r, column);
    add_slip_derivatives(i, bed.friction * (whole.by_force * spring.by_limit + whole.by_limit));
  }
}

/// Of `along` times the weight on the bed, in the balance of node i, by heights and tensions.
void Equations::add_slip_derivatives(int i, const Vector2d& along) {
  for (int r = 0; r < 2; ++r) {
    const int row = place_index(i) + r;
    matrix_(row, place_index(i) + 2) -= along[r] * push_[static_cast<std::size_t>(i)].by_end;
    for (int side = 0; side < 2; ++side) {  // the segment after the node, and that before
      const int j = side == 0 ? line_.after(i) : line_.before(i);
      if (j < 0) continue;
      const Sag& s = sag_[static_cast<std::size_t>(j)];
      matrix_(row, tension_index(j)) += along[r] * scale_ * s.relief_by_tension[side];
      for (int k = 0; k < 2; ++k)
        matrix_(row, place_index(line_.first(j) + k) + 2) += along[r] * s.relief_by_height[side][k];
    }
  }
}

double Equations::stored_in_shear(const State& state) const {
  double sum = 0;
  if (!line_.rubs_on_bed() || state.grip.cols() == 0) return sum;
  for (int i = 0; i < line_.nodes(); ++i)
    if (line_.held(i) == nullptr)
      sum += shear_stiffness(i) / 2 * (state.position.col(i).head<2>() - state.grip.col(i)).squaredNorm();
  return sum;
}

void Equations::take_grip(State& state) const {
  if (line_.rubs_on_bed()) state.grip = state.position.topRows<2>() - strain_;
}

}  // namespace dynamics::line
