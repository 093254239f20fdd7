#include "dynamics/force/field_at_one_place.hpp"

#include <algorithm>

namespace dynamics {

using hydro::waves::Kinematics;

double FieldAtOnePlace::elevation(double t, double, double) const {
  return field_->elevation(t, place_.x(), place_.y());
}

Kinematics FieldAtOnePlace::at(double t, const Eigen::Vector3d&) const {
  Kinematics k = field_->at(t, place_);
  k.gradient.setZero();
  return k;
}

void FieldAtOnePlace::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  if (!points.empty()) std::fill(out.begin(), out.end(), at(t, points.front()));
}

}  // namespace dynamics
