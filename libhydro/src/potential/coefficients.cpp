#include "hydro/potential/coefficients.hpp"

#include <cmath>

#include "hydro/base/error.hpp"
#include "readers.hpp"

namespace hydro::potential {
namespace {

void require_increasing(const std::vector<double>& values, const char* what, const std::string& source) {
  for (std::size_t i = 1; i < values.size(); ++i)
    require(values[i] > values[i - 1], "{}: {} must increase, but value {} is {} after {}", source, what, i + 1,
            values[i], values[i - 1]);
}

template <class Matrix>
void require_sound(const Matrix& m, Eigen::Index rows, Eigen::Index columns, const std::string& what,
                   const std::string& source) {
  require(m.rows() == rows && m.cols() == columns, "{}: {} has shape ({}, {}); ({}, {}) is needed", source, what,
          m.rows(), m.cols(), rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i)
      require(std::isfinite(std::abs(m(i, j))), "{}: {} is not finite at ({}, {})", source, what, i + 1, j + 1);
}

void require_finite_point(const std::optional<Eigen::Vector3d>& p, const char* what, const BodyData& body,
                          const std::string& source) {
  require(!p || p->allFinite(), "{}: {} of body \"{}\" is not finite", source, what, body.name);
}

void require_sound_bodies(const Coefficients& c) {
  require(!c.body.empty(), "{}: there is no body", c.source);
  for (const BodyData& b : c.body) {
    require_finite_point(b.reference_point, "the reference point", b, c.source);
    require_finite_point(b.centre_of_gravity, "the centre of gravity", b, c.source);
    require_finite_point(b.centre_of_buoyancy, "the centre of buoyancy", b, c.source);
    require(!b.displaced_volume || (std::isfinite(*b.displaced_volume) && *b.displaced_volume >= 0),
            "{}: the displaced volume of body \"{}\" must be finite and not negative, got {} m³", c.source, b.name,
            b.displaced_volume.value_or(0));
  }
}

void require_sound_axes(const Coefficients& c) {
  require(!c.omega.empty(), "{}: there is no frequency", c.source);
  for (const double omega : c.omega)
    require(std::isfinite(omega) && omega > 0, "{}: frequencies must be finite and positive, got {} rad/s", c.source,
            omega);
  for (const double heading : c.heading)
    require(std::isfinite(heading), "{}: headings must be finite, got {} rad", c.source, heading);
  require_increasing(c.omega, "frequencies", c.source);
  require_increasing(c.heading, "headings", c.source);
}

}  // namespace

void Coefficients::validate() const {
  require(std::isfinite(water.density) && water.density > 0, "{}: density must be positive, got {} kg/m³", source,
          water.density);
  require(std::isfinite(water.gravity) && water.gravity > 0, "{}: gravity must be positive, got {} m/s²", source,
          water.gravity);
  require_sound_bodies(*this);
  require_sound_axes(*this);
  require(A.size() == omega.size() && B.size() == omega.size(),
          "{}: there are {} frequencies, but {} matrices A and {} matrices B", source, omega.size(), A.size(),
          B.size());
  require(X.size() == heading.size(), "{}: there are {} headings, but excitation for {}", source, heading.size(),
          X.size());
  for (std::size_t i = 0; i < omega.size(); ++i) {
    require_sound(A[i], modes(), modes(), fmt::format("A at {:.6g} rad/s", omega[i]), source);
    require_sound(B[i], modes(), modes(), fmt::format("B at {:.6g} rad/s", omega[i]), source);
  }
  if (A_zero) require_sound(*A_zero, modes(), modes(), "A at zero frequency", source);
  if (A_inf) require_sound(*A_inf, modes(), modes(), "A at infinite frequency", source);
  if (C) require_sound(*C, modes(), modes(), "C", source);
  for (std::size_t i = 0; i < heading.size(); ++i)
    require_sound(X[i], modes(), static_cast<Eigen::Index>(omega.size()),
                  fmt::format("X at heading {:.6g} rad", heading[i]), source);
}

Matrix6 rigid_shift(const Eigen::Vector3d& r) {
  // (P4): the upper right block is −[r]×, since ω × r = −r × ω.
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() << 0, r.z(), -r.y(),  //
      -r.z(), 0, r.x(),                          //
      r.y(), -r.x(), 0;
  return T;
}

}  // namespace hydro::potential
