#pragma once
/// \file  Waves that grow from nothing at the beginning of a run, as moving members meet them.
#include <memory>

#include "hydro/waves/kinematics/field.hpp"

namespace dynamics {

/// The field with its waves, not its current, times r(t) of ramp() (D41). Immutable.
class RampedField final : public hydro::waves::WaveField {
 public:
  /// `current`: that of the field.
  RampedField(std::shared_ptr<const hydro::waves::WaveField> field, double over_s, hydro::waves::Current current);

  const hydro::Water& water() const noexcept override { return field_->water(); }
  double elevation(double t_s, double x_m, double y_m) const override;
  hydro::waves::Kinematics at(double t_s, const Eigen::Vector3d& point) const override;
  void at(double t_s, std::span<const Eigen::Vector3d> points, std::span<hydro::waves::Kinematics> out) const override;

 private:
  void grow(double t_s, double z_m, hydro::waves::Kinematics& k) const;

  std::shared_ptr<const hydro::waves::WaveField> field_;
  double over_;
  hydro::waves::Current current_;
};

}  // namespace dynamics
