#pragma once
/// \file  Waves inside a box of space and time, from a table: for points that move, at a cost that does not grow with
/// the number of components.
///
/// A sea has no frequency above its highest and no wavenumber above its largest, so even samples twice as dense as they
/// need hold all of it: Kaiser–Bessel interpolation in time and along the horizontal, Chebyshev polynomials in the
/// vertical. What is interpolated is the elevation and the potential; velocities, accelerations, gradients and pressure
/// are exact derivatives of the interpolant. Equations (W94), (W96)-(W98), docs/theory/waves-synthesis.md.
#include <memory>

#include "hydro/waves/kinematics/field.hpp"

namespace hydro::waves {

/// Where and when a table answers.
struct FieldBox {
  double start_s, end_s;
  Eigen::Vector3d low, high;  ///< opposite corners, m; z may reach above still water, not below the bed
};

/// Largest error of each kind of value anywhere in the box, SI; bounds, not estimates: they add up the components as if
/// all were at their worst at once, so a typical error is smaller by some
/// factors of ten. They hold for points in the water; delta stretching continued far above a trough has no bound. NaN
/// for what the table does not hold.
struct FieldError {
  double elevation, velocity, acceleration, gradient, dynamic_pressure;
};

/// A field on a table. Immutable, pure in (t, point), and may be shared between threads.
class TabulatedField final : public WaveField {
 public:
  struct Options {
    double tolerance = 1e-10;                          ///< of each component, relative to its size; 1e-11 … 1e-2
    std::size_t largest_bytes = std::size_t{2} << 30;  ///< of the table
    bool elevation_only = false;  ///< a far smaller table, quickly made, that answers elevation() alone
  };

  /// Builds the table. Cost: one synthesise() per station and level.
  /// \throws InputError if the box is empty, not finite or reaches below the bed, if the tolerance cannot be reached,
  /// or if the table would be larger than `largest_bytes` (says by how much and what to do)
  TabulatedField(const HarmonicField& field, const FieldBox& box, const Options& options);
  TabulatedField(const HarmonicField& field, const FieldBox& box) : TabulatedField(field, box, Options{}) {}
  ~TabulatedField() override;
  TabulatedField(TabulatedField&&) noexcept;
  TabulatedField& operator=(TabulatedField&&) noexcept;

  /// The memory a table would take, before it is built.
  static double expected_bytes(const HarmonicField& field, const FieldBox& box, const Options& options);

  const FieldBox& box() const noexcept;
  std::size_t bytes() const noexcept;
  /// Relative error of one component, from the interpolation alone.
  double relative_error() const noexcept;
  const FieldError& error_bound() const noexcept;

  const Water& water() const noexcept override;
  /// All of these throw InputError for an instant or point outside the box: a table that ends is no calm sea.
  double elevation(double t_s, double x_m, double y_m) const override;
  void elevations(double t_s, std::span<const Eigen::Vector2d> at, std::span<double> out) const;
  Kinematics at(double t_s, const Eigen::Vector3d& point) const override;
  /// The same values, bit for bit, as one by one; many points share the interpolation in time.
  void at(double t_s, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const override;

 private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

}  // namespace hydro::waves
