#include "hydro/hydrostatics/stability.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/dense.hpp"

namespace hydro::hydrostatics {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

void check(const MassPoint& body, const Water& water) {
  require(body.mass > 0 && std::isfinite(body.mass), "the mass of the hull must be positive, got {} kg", body.mass);
  require(body.centre.allFinite(), "the centre of gravity must be finite");
  require(water.density > 0 && std::isfinite(water.density), "the density of water must be positive, got {} kg/m³",
          water.density);
  require(water.gravity > 0 && std::isfinite(water.gravity), "gravity must be positive, got {} m/s²", water.gravity);
}

/// The hull at one attitude, heave balanced.
struct Balance {
  Pose pose;
  double energy;    ///< of water and weight, J
  double arm;       ///< of the horizontal moment about G, m
  VectorXd moment;  ///< about the free axes through G, N m
  MatrixXd K;       ///< rotations about the free axes, heave following (H12)
  double heave_stiffness;
};

Balance balanced(const Hull& hull, const MassPoint& body, const Water& water, const Matrix3d& attitude,
                 const std::vector<int>& axes) {
  Balance b{.pose = floating_at(hull, attitude, body.mass / water.density),
            .energy = 0,
            .arm = 0,
            .moment = {},
            .K = {},
            .heave_stiffness = 0};
  const Immersion im = immersion(hull, b.pose);
  const Vector3d G = b.pose * body.centre;
  const double weight = body.mass * water.gravity;
  const Vector6 load = buoyancy(im, water, G);
  const Matrix6 K = buoyancy_stiffness(im, water, G);  // gravity has no moment about G
  b.energy = buoyancy_energy(im, water) + weight * G.z();
  b.heave_stiffness = K(2, 2);
  const auto n = static_cast<Index>(axes.size());
  b.moment.resize(n);
  b.K.resize(n, n);
  for (Index i = 0; i < n; ++i) {
    const int a = axes[static_cast<std::size_t>(i)];
    b.moment[i] = load[a];
    for (Index j = 0; j < n; ++j) {
      const int c = axes[static_cast<std::size_t>(j)];
      b.K(i, j) = K(a, c) - (K(2, 2) > 0 ? K(a, 2) * K(2, c) / K(2, 2) : 0);
    }
  }
  b.arm = b.moment.norm() / weight;
  return b;
}

struct Turn {
  Matrix3d attitude;
  double heel, trim;
};

/// The attitude turned about level axes by `step`, without the yaw that such turns add up to.
Turn turned(const Matrix3d& attitude, const std::vector<int>& axes, const VectorXd& step) {
  Vector3d phi = Vector3d::Zero();
  for (std::size_t i = 0; i < axes.size(); ++i) phi[axes[i] - 3] = step[static_cast<Index>(i)];
  const double angle = phi.norm();
  const Matrix3d R = angle > 0 ? Matrix3d(Eigen::AngleAxisd(angle, phi / angle) * attitude) : attitude;
  const double yaw = std::atan2(attitude(1, 0), attitude(0, 0));
  const double heel = std::atan2(R(2, 1), R(2, 2)), trim = -std::asin(std::clamp(R(2, 0), -1.0, 1.0));
  return {Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * attitude_of(Angle::from_radians(heel), Angle::from_radians(trim)),
          heel, trim};
}

/// Newton's step with every curvature taken as positive, so that it leads downhill; at most 0.3 rad.
VectorXd downhill_step(const Balance& b, double scale) {
  const auto [values, vectors] = dense::symmetric_eigen(dense::symmetric_part(b.K));
  VectorXd step = vectors.transpose() * b.moment;
  for (Index i = 0; i < step.size(); ++i) step[i] /= std::max(std::abs(values[i]), 1e-9 * scale);
  step = vectors * step;
  const double size = step.norm();
  return size > 0.3 ? VectorXd(step * (0.3 / size)) : step;
}

/// Lowers the energy until there is no moment about the free axes (3: x, 4: y) through G (H12).
Equilibrium descend(const Hull& hull, const MassPoint& body, const Water& water, const Matrix3d& start,
                    const std::vector<int>& axes) {
  const double scale = body.mass * water.gravity * hull.diagonal();
  Turn now = turned(start, axes, VectorXd::Zero(static_cast<Index>(axes.size())));
  Balance b = balanced(hull, body, water, now.attitude, axes);
  Equilibrium e;
  for (e.iterations = 0; e.iterations < 100; ++e.iterations) {
    e.converged = b.arm <= 1e-10 * hull.diagonal();
    if (e.converged) break;
    VectorXd step = downhill_step(b, scale);
    bool moved = false;
    for (int halving = 0; halving < 40 && !moved; ++halving, step /= 2) {
      const Turn next = turned(now.attitude, axes, step);
      try {
        Balance c = balanced(hull, body, water, next.attitude, axes);
        // Close to equilibrium the fall in energy is lost in round-off, that of the moment is not.
        moved = c.energy < b.energy - 1e-4 * b.moment.dot(step) || c.arm < b.arm / 2;
        if (moved) {
          b = std::move(c);
          now = next;
        }
      } catch (const InputError&) {  // it would flood or sink there: a shorter step
      }
    }
    if (!moved) break;
  }
  const VectorXd curvatures = dense::symmetric_eigenvalues(dense::symmetric_part(b.K));
  e.stable = e.converged && b.heave_stiffness > 0 && curvatures.minCoeff() > 1e-9 * scale;
  e.pose = b.pose;
  e.arm = b.arm;
  e.heel = now.heel;
  e.trim = now.trim;
  e.why = !e.converged ? fmt::format(
                             "stopped after {} steps with an arm of {:.3g} m: no step leads downhill that "
                             "neither floods nor sinks the hull",
                             e.iterations, e.arm)
          : e.stable ? fmt::format("in stable equilibrium after {} steps", e.iterations)
                     : fmt::format(
                           "in equilibrium after {} steps, but a small push turns it over or nothing brings it "
                           "back",
                           e.iterations);
  return e;
}

}  // namespace

Pose floating_at(const Hull& hull, const Matrix3d& attitude, double volume) {
  require(volume > 0 && std::isfinite(volume), "the volume to displace must be positive, got {} m³", volume);
  Pose pose{.attitude = attitude, .position = Vector3d::Zero()};
  double bottom = 1e300, top = -1e300;
  for (const Vector3d& v : hull.vertices()) {
    const double z = (pose * v).z();
    bottom = std::min(bottom, z);
    top = std::max(top, z);
  }
  // Between these the hull dips in and is drowned (or its openings are).
  double high = -bottom, low = -std::min(top, freeboard_of_openings(hull, pose));
  pose.position.z() = low;
  const double most = immersion(hull, pose).volume;
  const double enough = 1e-14 * hull.area() * hull.diagonal();
  if (volume > most + enough)
    throw InputError(
        fmt::format("{}: {:.6g} m³ of water are to be displaced, but at this attitude the hull {} at {:.6g} m³",
                    hull.source(), volume, hull.closed() ? "is wholly under water" : "takes in water by its openings",
                    most),
        {}, "check mass, density and the unit of the mesh");
  if (volume >= most - enough) return pose;  // awash
  pose.position.z() = (low + high) / 2;
  while (high - low > 1e-15 * hull.diagonal()) {  // (H10)
    const Immersion im = immersion(hull, pose);
    const double excess = im.volume - volume;
    if (std::abs(excess) <= enough) break;
    double& heave = pose.position.z();
    (excess > 0 ? low : high) = heave;
    const double newton = heave + (im.waterplane ? excess / im.waterplane->area : 0);
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (next == heave) break;  // neighbours among the doubles
    heave = next;
  }
  return pose;
}

Metacentre metacentre(const Immersion& im, const Vector3d& G) {
  require(im.centre_of_buoyancy && im.waterplane, "the hull does not pierce the surface: it has no metacentre");
  const Eigen::Matrix2d I = im.waterplane->second_moment;
  const double BG = im.centre_of_buoyancy->z() - G.z(), bm_t = I(1, 1) / im.volume, bm_l = I(0, 0) / im.volume;
  const double least = dense::symmetric_eigenvalues(I).minCoeff() / im.volume;
  return {bm_t, bm_l, bm_t + BG, bm_l + BG, least + BG};  // (H11)
}

Equilibrium equilibrium(const Hull& hull, const MassPoint& body, const Water& water, const Matrix3d& start) {
  check(body, water);
  return descend(hull, body, water, start, {3, 4});
}

namespace {

/// The hull at one heel of a curve; `trim` is where the search begins when it is free.
RightingArm righting_arm(const Hull& hull, const MassPoint& body, const Water& water, double heel, Trim kind,
                         double trim) {
  const Matrix3d R = attitude_of(Angle::from_radians(heel), Angle::from_radians(trim));
  const double weight = body.mass * water.gravity;
  RightingArm arm{.heel = heel, .trim = trim, .gz = 0, .energy = 0, .pose = {}};
  if (kind == Trim::free) {
    const Equilibrium e = descend(hull, body, water, R, {4});
    if (!e.converged)
      throw NumericsError(fmt::format("at a heel of {:.4g}° no trim of equilibrium is found: {}",
                                      Angle::from_radians(heel).degrees(), e.why));
    arm.pose = e.pose;
    arm.trim = e.trim;
  } else {
    arm.pose = floating_at(hull, R, body.mass / water.density);
  }
  const Immersion im = immersion(hull, arm.pose);
  const Vector3d G = arm.pose * body.centre;
  arm.gz = -buoyancy(im, water, G)[3] / weight;
  arm.energy = buoyancy_energy(im, water) / weight + G.z();
  return arm;
}

}  // namespace

RightingCurve righting_arms(const Hull& hull, const MassPoint& body, const Water& water,
                            const std::vector<double>& heel, Trim trim, Angle start_trim) {
  check(body, water);
  RightingCurve curve;
  double first = 0, now = start_trim.radians();
  for (const double phi : heel) {
    require(std::isfinite(phi), "a heel of the curve is not finite");
    try {
      curve.arms.push_back(righting_arm(hull, body, water, phi, trim, now));
    } catch (const InputError& e) {
      if (curve.arms.empty()) throw;
      curve.ended = fmt::format("at {:.4g}°: {}", Angle::from_radians(phi).degrees(), e.rule());
      break;
    }
    RightingArm& arm = curve.arms.back();
    now = arm.trim;
    if (curve.arms.size() == 1) first = arm.energy;
    arm.energy -= first;
  }
  return curve;
}

}  // namespace hydro::hydrostatics
