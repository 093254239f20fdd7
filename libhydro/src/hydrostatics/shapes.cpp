#include "hydro/hydrostatics/shapes.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace hydro::hydrostatics {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double least_volume = 1e-14, least_waterplane = 1e-12;  // as of a hull, relative

/// sin(x)/x.
double sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

/// f(ξ, weight) at Gauss's 20 points of 0 … 1. What is integrated here are polynomials in the sine of an angle that
/// goes through half a circle at most: exact to rounding.
template <class Function>
void over_unit_interval(Function f) {
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    const double x = Gauss::abscissa()[i], w = Gauss::weights()[i] / 2;
    f((1 + x) / 2, w);
    f((1 - x) / 2, w);
  }
}

/// (P80). A cylinder whose upper end is not below its lower one, in coordinates that follow the slope: the point
/// low + w·along + u·up + v·across, where `across` is level and u² + v² <= a², is wet if z_low + rise·w + slope·u < 0.
class TiltedCylinder {
 public:
  TiltedCylinder(Vector3d low, Vector3d high, double radius) : low_(std::move(low)), a_(radius) {
    Vector3d axis = high - low_;
    if (axis.z() < 0) {
      low_ = high;
      axis = -axis;
    }
    length_ = axis.norm();
    along_ = axis / length_;
    rise_ = along_.z();
    slope_ = along_.head<2>().norm();
    up_ = slope_ > 0 ? Vector3d(-rise_ * along_.x() / slope_, -rise_ * along_.y() / slope_, slope_)
                     : Vector3d(Vector3d::UnitX());
    across_ = along_.cross(up_);
    find_cuts();
  }

  Immersion immersion() const {
    Immersion im;
    if (slope_ == 0 && (low_.z() == 0 || low_.z() + length_ == 0)) im.area_in_surface = pi * a_ * a_;
    add_volume(im);
    add_waterplane(im);
    return im;
  }

 private:
  /// Where the end whose middle is at z is cut: sin φ = u/a; all of it wet is φ = π/2, none −π/2.
  double cut(double z) const {
    if (std::abs(z) >= slope_ * a_) return z < 0 ? pi / 2 : -pi / 2;
    return std::asin(-z / (slope_ * a_));
  }

  void find_cuts() {
    const double z_high = low_.z() + rise_ * length_;
    phi_low_ = cut(low_.z());
    phi_high_ = cut(z_high);
    const double edge = slope_ * a_;
    if (std::abs(low_.z()) < edge && std::abs(z_high) < edge) {
      // u of both cuts differ by rise·length/slope; the angle follows from the chord without cancellation, also where
      // the cylinder lies level and both are one.
      rate_ = length_ / (slope_ * a_) / (std::cos(phi_low_) + std::cos(phi_high_)) * 2;
      if (const double half = rate_ * rise_ / 2; half > 0) rate_ *= std::atan(half) / half;
    } else {
      rate_ = rise_ > 0 ? (phi_low_ - phi_high_) / rise_ : 0;
    }
    // The surface misses the lower end and may meet the wall above it.
    if (phi_low_ == pi / 2 && rise_ > 0) w_at_low_ = std::min(length_, -(low_.z() + edge) / rise_);
  }

  /// f(u, half chord, w, weight) over the part between the cuts, where the surface meets the wall line at height w.
  /// ∫ weight is (φ_low − φ_high)/rise.
  template <class Function>
  void over_slope(Function f) const {
    if (rate_ <= 0) return;
    const double turn = rate_ * rise_;
    over_unit_interval([&](double xi, double weight) {
      const double left = 1 - xi, phi = phi_high_ + turn * xi;
      const double w = w_at_low_ + a_ * slope_ * std::cos((phi_low_ + phi) / 2) * left * rate_ * sinc(turn * left / 2);
      f(a_ * std::sin(phi), a_ * std::cos(phi), std::clamp(w, 0.0, length_), weight * rate_);
    });
  }

  void add_volume(Immersion& im) const {
    double volume = 0, along = 0, up = 0, wall = 0;
    const auto add = [&](double u, double q, double w, double dphi) {
      const double area = 2 * q * q * dphi;  // 2q du
      volume += w * area;
      along += w * w / 2 * area;
      up += u * w * area;
      wall += 2 * a_ * w * dphi;
    };
    over_slope([&](double u, double q, double w, double weight) { add(u, q, w, weight * rise_); });
    const double whole = phi_high_ + pi / 2;  // where the wall is wet to its upper end
    over_unit_interval([&](double xi, double weight) {
      const double phi = whole * xi - pi / 2;
      add(a_ * std::sin(phi), a_ * std::cos(phi), length_, weight * whole);
    });
    const auto segment = [&](double phi) { return a_ * a_ * (phi + std::sin(2 * phi) / 2 + pi / 2); };
    im.wetted_area = wall + segment(phi_low_) + segment(phi_high_);
    if (volume <= least_volume * a_ * length_ * (a_ + length_)) return;
    im.volume = volume;
    im.centre_of_buoyancy = low_ + along / volume * along_ + up / volume * up_;
  }

  void add_waterplane(Immersion& im) const {
    double S = 0, across = 0;
    Vector2d first = Vector2d::Zero();
    Matrix2d second = Matrix2d::Zero();
    over_slope([&](double u, double q, double w, double weight) {
      const double area = 2 * q * q * weight;  // the surface is inclined by `rise` to the section of the cylinder
      const Vector2d x = (w * along_ + u * up_).head<2>();
      S += area;
      first += area * x;
      second += area * x * x.transpose();
      across += area * q * q / 3;
    });
    if (S <= least_waterplane * a_ * (a_ + length_)) return;
    const Vector2d centre = first / S, side = across_.head<2>();
    im.waterplane = Waterplane{S, low_.head<2>() + centre,
                               second - S * centre * centre.transpose() + across * side * side.transpose()};
  }

  Vector3d low_, along_, up_, across_;
  double a_, length_, rise_, slope_;
  double phi_low_ = 0, phi_high_ = 0, rate_ = 0, w_at_low_ = 0;
};

}  // namespace

void check(const CircularCylinder& c) {
  require(c.from.allFinite() && c.to.allFinite(), "the ends of a cylinder must be finite");
  require(std::isfinite(c.radius) && c.radius > 0, "the radius of a cylinder must be finite and positive, got {} m",
          c.radius);
  require((c.to - c.from).norm() > 1e-9 * c.radius, "the ends of a cylinder must be apart");
}

void check(const Sphere& s) {
  require(s.centre.allFinite(), "the centre of a sphere must be finite");
  require(std::isfinite(s.radius) && s.radius > 0, "the radius of a sphere must be finite and positive, got {} m",
          s.radius);
}

Immersion immersion(const CircularCylinder& cylinder, const Pose& pose) {
  return TiltedCylinder(pose * cylinder.from, pose * cylinder.to, cylinder.radius).immersion();
}

Immersion immersion(const Sphere& sphere, const Pose& pose) {
  const Vector3d c = pose * sphere.centre;
  const double a = sphere.radius, depth = std::clamp(a - c.z(), 0.0, 2 * a), dry = 2 * a - depth;  // (P81)
  Immersion im;
  im.wetted_area = 2 * pi * a * depth;
  const double volume = pi * depth * depth * (3 * a - depth) / 3;
  if (volume > least_volume * a * a * a) {
    im.volume = volume;
    im.centre_of_buoyancy = c - Vector3d(0, 0, 3 * dry * dry / (4 * (3 * a - depth)));
  }
  const double S = pi * depth * dry;
  if (S > least_waterplane * a * a)
    im.waterplane = Waterplane{S, c.head<2>(), S * depth * dry / 4 * Matrix2d::Identity()};
  return im;
}

}  // namespace hydro::hydrostatics
