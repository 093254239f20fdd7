#include "hydro/hydrostatics/immersion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hydro::hydrostatics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Sums over wet triangles, x and y counted from the middle of the hull, z from the water.
struct Integrals {
  double volume = 0, area = 0, in_surface = 0;
  Vector3d first = Vector3d::Zero();                   // ∫ r dV
  double S = 0;                                        // ∫ dS of the waterplane
  Vector2d S_first = Vector2d::Zero();                 // ∫ x dS
  Eigen::Matrix2d S_second = Eigen::Matrix2d::Zero();  // ∫ x xᵀ dS

  /// A triangle under water, (H4) and (H5): integrands are of second degree at most, so three mid-edge points are
  /// exact. What lies in the surface leaves the waterplane whole (H6).
  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, bool is_in_surface) {
    const Vector3d n = (b - a).cross(c - a) / 2;
    if (!is_in_surface) area += n.norm();
    for (const Vector3d& m : {Vector3d((a + b) / 2), Vector3d((b + c) / 2), Vector3d((c + a) / 2)}) {
      const double w = n.z() / 3;
      const Vector2d xy = m.head<2>();
      volume += w * m.z();
      first.head<2>() += w * m.z() * xy;
      first.z() += w * m.z() * m.z() / 2;
      if (is_in_surface) continue;
      S -= w;
      S_first -= w * xy;
      S_second -= w * xy * xy.transpose();
    }
  }
};

/// The point of z = 0 on an edge, the same whichever triangle asks (H6).
Vector3d crossing(const Vector3d& wet, const Vector3d& dry) {
  const double s = wet.z() / (wet.z() - dry.z());
  return {wet.x() + s * (dry.x() - wet.x()), wet.y() + s * (dry.y() - wet.y()), 0};
}

/// The part of a triangle at z < 0, a polygon of at most four corners (H6).
void add_wet_part(const std::array<Vector3d, 3>& corner, double near, Integrals& sum) {
  const bool is_in_surface =
      std::all_of(corner.begin(), corner.end(), [&](const Vector3d& p) { return std::abs(p.z()) <= near; });
  if (is_in_surface) sum.in_surface += (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm() / 2;
  std::array<Vector3d, 4> wet;
  std::size_t n = 0;
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &a = corner[i], &b = corner[(i + 1) % 3];
    if (a.z() <= 0) wet[n++] = a;
    any = any || a.z() < 0;
    if (a.z() < 0 && b.z() > 0) wet[n++] = crossing(a, b);
    if (a.z() > 0 && b.z() < 0) wet[n++] = crossing(b, a);
  }
  if (!any) return;
  for (std::size_t i = 2; i < n; ++i) sum.add(wet[0], wet[i - 1], wet[i], is_in_surface);
}

void require_rigid(const Pose& pose) {
  require(pose.position.allFinite() && pose.attitude.allFinite(), "the pose of a hull must be finite");
  require((pose.attitude.transpose() * pose.attitude - Matrix3d::Identity()).norm() < 1e-9 &&
              pose.attitude.determinant() > 0,
          "the attitude of a hull must be a rotation");
}

void require_dry_openings(const Hull& hull, const Pose& pose) {
  for (const int v : hull.rim()) {
    const Vector3d p = pose * hull.vertices()[at(v)];
    if (p.z() < -in_surface * hull.diagonal())
      throw InputError(fmt::format("{}: water comes in through the opening at ({:.6g}, {:.6g}, {:.6g}) m of the mesh, "
                                   "{:.4g} m under water",
                                   hull.source(), hull.vertices()[at(v)].x(), hull.vertices()[at(v)].y(),
                                   hull.vertices()[at(v)].z(), -p.z()),
                       {}, "close the mesh, or draw a freeboard above it, or heel and sink it less");
  }
}

Integrals integrate(const Hull& hull, const Pose& pose, const Vector2d& middle) {
  const double snap = 1e-12 * hull.diagonal(), near = in_surface * hull.diagonal();
  thread_local std::vector<Vector3d> x;  // its room is kept, so that the steps of a run ask for none
  x.clear();
  for (const Vector3d& v : hull.vertices()) {
    Vector3d p = pose * v;
    p.head<2>() -= middle;
    if (std::abs(p.z()) <= snap) p.z() = 0;
    x.push_back(p);
  }
  Integrals sum;
  for (const auto& t : hull.triangles()) add_wet_part({x[at(t[0])], x[at(t[1])], x[at(t[2])]}, near, sum);
  return sum;
}

}  // namespace

Matrix3d attitude_of(Angle heel, Angle trim) {
  return (Eigen::AngleAxisd(trim.radians(), Vector3d::UnitY()) * Eigen::AngleAxisd(heel.radians(), Vector3d::UnitX()))
      .toRotationMatrix();
}

Immersion immersion(const Hull& hull, const Pose& pose) {
  require_rigid(pose);
  require_dry_openings(hull, pose);
  const Vector2d middle = (pose * hull.middle()).head<2>();
  const Integrals sum = integrate(hull, pose, middle);
  Immersion im;
  im.wetted_area = sum.area;
  im.area_in_surface = sum.in_surface;
  // Less than round-off of the sums is nothing.
  if (sum.volume > 1e-14 * hull.area() * hull.diagonal()) {
    im.volume = sum.volume;
    im.centre_of_buoyancy = sum.first / sum.volume + Vector3d(middle.x(), middle.y(), 0);
  }
  if (sum.S > 1e-12 * hull.area()) {
    const Vector2d centre = sum.S_first / sum.S;
    im.waterplane = Waterplane{sum.S, middle + centre, sum.S_second - sum.S * centre * centre.transpose()};
  }
  return im;
}

double freeboard_of_openings(const Hull& hull, const Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const int v : hull.rim()) least = std::min(least, (pose * hull.vertices()[at(v)]).z());
  return least;
}

Vector6 buoyancy(const Immersion& im, const Water& water, const Vector3d& about) {
  Vector6 load = Vector6::Zero();
  if (!im.centre_of_buoyancy) return load;
  const double B = water.density * water.gravity * im.volume;
  const Vector3d b = *im.centre_of_buoyancy - about;
  load << 0, 0, B, B * b.y(), -B * b.x(), 0;
  return load;
}

double buoyancy_energy(const Immersion& im, const Water& water) {
  return im.centre_of_buoyancy ? -water.density * water.gravity * im.volume * im.centre_of_buoyancy->z() : 0;
}

Matrix6 buoyancy_stiffness(const Immersion& im, const Water& water, const Vector3d& about) {
  Matrix6 K = Matrix6::Zero();
  const double rho_g = water.density * water.gravity;
  if (im.waterplane) {  // what the waterplane gains and loses, about the point (H9)
    const Waterplane& w = *im.waterplane;
    const Vector2d arm = w.centre - about.head<2>();
    const Eigen::Matrix2d I = w.second_moment + w.area * arm * arm.transpose();
    K(2, 2) = rho_g * w.area;
    K(2, 3) = K(3, 2) = rho_g * w.area * arm.y();
    K(2, 4) = K(4, 2) = -rho_g * w.area * arm.x();
    K(3, 3) = rho_g * I(1, 1);
    K(3, 4) = K(4, 3) = -rho_g * I(0, 1);
    K(4, 4) = rho_g * I(0, 0);
  }
  // The volume turned as a whole is a weight that pulls up.
  if (im.centre_of_buoyancy) K += gravity_stiffness(-rho_g * im.volume, *im.centre_of_buoyancy, about);
  return K;
}

Matrix6 gravity_stiffness(double weight, const Vector3d& centre, const Vector3d& about) {
  const Vector3d c = centre - about;
  Matrix6 K = Matrix6::Zero();  // (P12)
  K(3, 3) = K(4, 4) = -weight * c.z();
  K(3, 5) = weight * c.x();
  K(4, 5) = weight * c.y();
  return K;
}

}  // namespace hydro::hydrostatics
