#pragma once
/// \file  Waves for structures that stay near a place: from a table there where that pays, summed everywhere else.
#include <memory>

#include "hydro/waves/synthesis/field_choice.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"

namespace hydro::waves {

/// A sum of harmonics that answers from a table inside a box, if choose_field() finds that cheaper. Nothing is refused:
/// outside the box and its times the harmonics are summed, and there the values change by no more than error_bound() of
/// the table. Immutable, and may be shared between threads.
class BoxedField final : public WaveField {
 public:
  /// \throws InputError if the use is not sensible
  BoxedField(const HarmonicField& field, const FieldUse& use);

  /// The table; null where summing is cheaper.
  const TabulatedField* table() const noexcept { return table_.get(); }

  const Water& water() const noexcept override { return sum_.water(); }
  double elevation(double t_s, double x_m, double y_m) const override;
  Kinematics at(double t_s, const Eigen::Vector3d& point) const override;
  void at(double t_s, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const override;

 private:
  bool holds(double t_s) const;
  bool holds(double x_m, double y_m) const;
  bool holds(const Eigen::Vector3d& point) const;

  SummedField sum_;
  std::unique_ptr<const TabulatedField> table_;
};

}  // namespace hydro::waves
