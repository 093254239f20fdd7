#pragma once
/// \file  Waves for structures that stay near a place: from a table there where that pays, summed everywhere else.
#include <memory>

#include "hydro/waves/synthesis/field_choice.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"

namespace hydro::waves {

/// A sum of harmonics that answers from a table inside a box, if choose_field() finds that cheaper. Nothing is refused:
/// outside the box and its times the harmonics are summed, and there the values change by no more than the error bound
/// of the table. Where a table of all times would not fit into the memory allowed there is one for each of several
/// equal spans, made when it is first asked; the latest three are kept. Values depend on time and place alone, so a
/// field may be shared between threads.
class BoxedField final : public WaveField {
 public:
  /// \throws InputError if the use is not sensible
  BoxedField(const HarmonicField& field, const FieldUse& use);
  ~BoxedField() override;

  /// Into how many spans of time tables divide the box; 0 where summing is cheaper.
  int tables() const noexcept;
  /// Of a table of one span, as far as it is known before it is made; 0 where there is none.
  std::size_t bytes_of_table() const noexcept;
  /// That of the span of an instant within the box; null where summing is cheaper.
  std::shared_ptr<const TabulatedField> table(double t_s) const;

  const Water& water() const noexcept override { return sum_.water(); }
  double elevation(double t_s, double x_m, double y_m) const override;
  Kinematics at(double t_s, const Eigen::Vector3d& point) const override;
  void at(double t_s, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const override;

 private:
  class Spans;

  SummedField sum_;
  std::unique_ptr<Spans> spans_;
};

}  // namespace hydro::waves
