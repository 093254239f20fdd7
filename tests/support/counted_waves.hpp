#pragma once
/// \file  Waves that count how often they are asked.
#include <span>

#include "hydro/waves/kinematics/field.hpp"

namespace support {

/// Waves that count how often they are asked at a point.
class CountedWaves final : public hydro::waves::WaveField {
 public:
  explicit CountedWaves(hydro::waves::HarmonicField field) : field_(std::move(field)) {}
  const hydro::Water& water() const noexcept override { return field_.water(); }
  double elevation(double t, double x, double y) const override { return field_.elevation(t, x, y); }
  hydro::waves::Kinematics at(double t, const Eigen::Vector3d& point) const override {
    return ++asked, field_.at(t, point);
  }
  void at(double t, std::span<const Eigen::Vector3d> points, std::span<hydro::waves::Kinematics> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(t, points[i]);
  }
  mutable std::size_t asked = 0;

 private:
  hydro::waves::HarmonicField field_;
};

}  // namespace support
