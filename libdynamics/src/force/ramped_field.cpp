#include "dynamics/force/ramped_field.hpp"

#include "dynamics/time/ramp.hpp"

namespace dynamics {

using hydro::waves::Kinematics;

RampedField::RampedField(std::shared_ptr<const hydro::waves::WaveField> field, double over,
                         hydro::waves::Current current)
    : field_(std::move(field)), over_(over), current_(std::move(current)) {}

double RampedField::elevation(double t, double x, double y) const {
  return ramp(t, over_).value * field_->elevation(t, x, y);
}

// (D41)
void RampedField::grow(double t, double z, Kinematics& k) const {
  if (t >= over_) return;
  const Ramp r = ramp(t, over_);
  const Eigen::Vector2d U = current_.at(z), shear = current_.gradient(z);
  Eigen::Vector3d steady(U.x(), U.y(), 0);
  Eigen::Matrix3d steady_gradient = Eigen::Matrix3d::Zero();
  steady_gradient.topRightCorner<2, 1>() = shear;
  const Eigen::Vector3d waves = k.velocity - steady;
  k.elevation *= r.value;
  k.velocity = steady + r.value * waves;
  k.acceleration = r.value * k.acceleration + r.rate * waves;
  k.gradient = steady_gradient + r.value * (k.gradient - steady_gradient);
  k.dynamic_pressure *= r.value;
}

Kinematics RampedField::at(double t, const Eigen::Vector3d& point) const {
  Kinematics k = field_->at(t, point);
  grow(t, point.z(), k);
  return k;
}

void RampedField::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  field_->at(t, points, out);
  for (std::size_t i = 0; i < points.size(); ++i) grow(t, points[i].z(), out[i]);
}

}  // namespace dynamics
