#pragma once
/// \file  A wave field that is the same everywhere: what it is at one place.
#include <memory>

#include "hydro/waves/kinematics/field.hpp"

namespace dynamics {

/// Every point has the water of `place`, waves and current, whose gradients are zero: for bodies that are small against
/// the waves, and for comparison with models that take waves at one place (D152).
class FieldAtOnePlace final : public hydro::waves::WaveField {
 public:
  FieldAtOnePlace(std::shared_ptr<const hydro::waves::WaveField> field, const Eigen::Vector3d& place)
      : field_(std::move(field)), place_(place) {}

  const hydro::Water& water() const noexcept override { return field_->water(); }
  bool is_still() const noexcept override { return field_->is_still(); }
  double elevation(double t_s, double x_m, double y_m) const override;
  /// \throws hydro::InputError if the place is below the bed
  hydro::waves::Kinematics at(double t_s, const Eigen::Vector3d& point) const override;
  void at(double t_s, std::span<const Eigen::Vector3d> points, std::span<hydro::waves::Kinematics> out) const override;

 private:
  std::shared_ptr<const hydro::waves::WaveField> field_;
  Eigen::Vector3d place_;
};

}  // namespace dynamics
