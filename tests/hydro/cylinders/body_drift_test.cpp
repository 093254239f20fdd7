// Mean drift of single bodies: against the pressure on piles, waves far away, and laws. (P41), (C24).
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "hydro/cylinders/field.hpp"
#include "hydro/waves/dispersion.hpp"
#include "layouts.hpp"

namespace hydro::cylinders::body_drift_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index, Eigen::Vector2d;
using potential::BodyDrift, potential::FieldQuestion, potential::WaveField;
using std::numbers::pi;

constexpr double omega = 1.3;

CylinderBody pile(double radius, double x, double y) { return {"pile", {x, y, 0}, {}, {{{x, y}, radius, {}}}}; }

/// Bodies in some motion with all six modes of the first; waves that go to `heading`.
FieldQuestion asked(double heading, std::size_t bodies, bool held) {
  FieldQuestion out{omega, heading, Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies)), Eigen::RowVector2d(500, 0)};
  out.drift = true;
  if (held) return out;
  for (Index i = 0; i < out.motion.size(); ++i)
    out.motion(i) = (i % 6 < 3 ? 0.4 : 0.1) * std::polar(1.0, 0.7 * static_cast<double>(i));
  return out;
}

WaveField field(const std::vector<CylinderBody>& bodies, const FieldQuestion& question, double tolerance = 1e-7) {
  return wave_field(bodies, tank(), question, {.tolerance = tolerance});
}

Vector2d on_all(const BodyDrift& drift) { return drift.load.leftCols<2>().colwise().sum().transpose(); }

// One body of two cylinders has no other momentum than that of waves far away; several have it in sum.
TEST(BodyDrift, AddsUpToThatOfWavesFarAway) {
  CylinderBody pair = single(2, 3, 1, -2);
  pair.cylinders.push_back({{6, 0.5}, 1.2, 2});
  for (const auto& bodies : {std::vector{pair}, std::vector{single(2, 3, 1, -2), single(1.5, 2, 7, 3), pile(1, 0, 5)}})
    for (const bool held : {true, false}) {
      const WaveField f = field(bodies, asked(0.7, bodies.size(), held), 1e-5);
      const Vector2d far = mean_drift(f.far, omega, tank()).force;
      // Ten times the tolerance: coefficients of (C4) have it, their squares twice as much.
      EXPECT_LT((on_all(*f.on_bodies) - far).norm(), 1e-4 * far.norm()) << bodies.size() << held;
      EXPECT_LT(f.on_bodies->estimate, 2e-4);
    }
}

/// Mean force on a pile that stands still, by the pressure on its side: of its velocity along the water, what is
/// vertical, and the strip at the surface; from elevations around it.
Vector2d by_pressure(const Eigen::VectorXcd& eta, double radius) {
  const double k = waves::wavenumber(omega, tank()), h = tank().depth.metres(), g = tank().gravity,
               cosh2 = std::pow(std::cosh(k * h), 2), slow = h / 2 / cosh2,
               fast = std::sinh(2 * k * h) / (4 * k) / cosh2;
  const auto n = static_cast<double>(eta.size());
  Vector2d out = Vector2d::Zero();
  for (Index i = 0; i < eta.size(); ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / n;
    Complex along = 0;  // ∂η/∂θ by Fourier's sum
    for (Index j = 0; j < eta.size(); ++j)
      if (j != i) {
        const double half = pi * static_cast<double>(i - j) / n;
        along += eta(j) * (((i - j) % 2 == 0 ? 0.5 : -0.5) / std::tan(half));
      }
    const double of_phi = g * g / (omega * omega);
    const double pushes =
        of_phi * ((fast + slow) * std::norm(along) / (radius * radius) + k * k * (fast - slow) * std::norm(eta(i))) -
        g * std::norm(eta(i));
    out += tank().density / 4 * pushes * (2 * pi * radius / n) * Vector2d(std::cos(angle), std::sin(angle));
  }
  return out;
}

// Waves about piles have one mode, so that elevations tell all that pushes their sides.
TEST(BodyDrift, OfPilesBesideEachOtherIsThatOfThePressureOnEach) {
  const std::vector<CylinderBody> piles{pile(2, 0, 0), pile(1.2, 5, 1.5)};
  FieldQuestion question = asked(0.4, 2, true);
  constexpr Index around = 64;
  question.point.resize(2 * around, 2);
  for (Index b = 0; b < 2; ++b)
    for (Index i = 0; i < around; ++i) {
      const Cylinder& c = piles[static_cast<std::size_t>(b)].cylinders[0];
      const double angle = 2 * pi * static_cast<double>(i) / around;
      question.point.row(b * around + i) =
          (c.centre + c.radius * (1 + 1e-9) * Vector2d(std::cos(angle), std::sin(angle))).transpose();
    }
  const WaveField f = field(piles, question);
  for (Index b = 0; b < 2; ++b) {
    const Vector2d expected = by_pressure(f.total().segment(b * around, around), b == 0 ? 2 : 1.2),
                   found = f.on_bodies->load.row(b).head<2>().transpose();
    EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm()) << b;  // of the tolerance, and places 1e-9 off
    // What pushes a round side that stands still goes through its axis.
    EXPECT_NEAR(f.on_bodies->load(b, 2), 0, 1e-6 * expected.norm());
  }
}

// Turned and moved, all of it: forces turn, moments stay.
TEST(BodyDrift, TurnsWithAllThatIsTurned) {
  constexpr double turn = 0.6;
  const Eigen::Rotation2Dd R(turn);
  const auto moved = [&](CylinderBody body) {
    for (Cylinder& c : body.cylinders) c.centre = R * c.centre + Vector2d(30, -20);
    body.reference_point.head<2>() = (R * Vector2d(body.reference_point.head<2>()) + Vector2d(30, -20)).eval();
    return body;
  };
  const std::vector<CylinderBody> here{single(2, 3, 1, -2), single(1.5, 2, 6, 3)};
  FieldQuestion question = asked(0.7, 2, false);
  const BodyDrift before = *field(here, question).on_bodies;
  const Vector2d towards(std::cos(0.7 + turn), std::sin(0.7 + turn));
  question.heading += turn;
  const double k = waves::wavenumber(omega, tank());
  for (Index v = 0; v < question.motion.size(); v += 3)
    question.motion.segment<2>(v) = (R.toRotationMatrix() * question.motion.segment<2>(v)).eval();
  question.motion *= std::polar(1.0, -k * Vector2d(30, -20).dot(towards));
  const BodyDrift after = *field({moved(here[0]), moved(here[1])}, question).on_bodies;
  for (Index b = 0; b < 2; ++b) {
    const Vector2d force = before.load.row(b).head<2>().transpose();
    EXPECT_LT((after.load.row(b).head<2>().transpose() - R * force).norm(), 1e-6 * force.norm());
    EXPECT_NEAR(after.load(b, 2), before.load(b, 2), 1e-6 * force.norm() * before.length);
    EXPECT_GT(std::abs(before.load(b, 2)), 1e-3 * force.norm());  // there is a moment
  }
}

}  // namespace
}  // namespace hydro::cylinders::body_drift_test
