// The water's surface about cylinders: closed forms and laws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/hankel.hpp>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/cylinders/field.hpp"
#include "hydro/waves/dispersion.hpp"
#include "layouts.hpp"

namespace hydro::cylinders::field_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using hydro::cylinders::Cylinder, hydro::cylinders::CylinderBody, hydro::cylinders::wave_field;
using hydro::potential::FieldQuestion, hydro::potential::WaveField;
using std::numbers::pi;

const hydro::Water water{.density = 1025, .depth = hydro::WaterDepth::from_metres(20)};
constexpr double omega = 1.1;

CylinderBody body(const std::string& name, const Cylinder& cylinder) {
  return {name, {cylinder.centre.x(), cylinder.centre.y(), 0}, {}, {cylinder}};
}

/// `count` points on a circle about `centre`, the first along x.
Eigen::MatrixX2d ring(const Eigen::Vector2d& centre, double radius, int count) {
  Eigen::MatrixX2d out(count, 2);
  for (int i = 0; i < count; ++i)
    out.row(i) =
        centre.transpose() + radius * Eigen::RowVector2d(std::cos(2 * pi * i / count), std::sin(2 * pi * i / count));
  return out;
}

FieldQuestion asked(const Eigen::MatrixX2d& point, std::size_t bodies = 1, double heading = 0) {
  return {omega, heading, Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies)), point};
}

/// H⁽²⁾_m and its slope.
Complex hankel(int m, double x) { return boost::math::cyl_hankel_2(m, x); }
Complex hankel_slope(int m, double x) { return (hankel(m - 1, x) - hankel(m + 1, x)) / 2.0; }

// MacCamy and Fuchs (1954): η = Σ ε_m (−i)^m [J_m(kr) − J_m′(ka)/H_m′(ka) H_m(kr)] cos mθ.
TEST(CylinderField, OfOneThatStandsOnTheBedIsMacCamyAndFuchs) {
  const double a = 3, k = hydro::waves::wavenumber(omega, water);
  const CylinderBody pile = body("pile", {{1, -2}, a, {}});
  for (const double r : {a * (1 + 1e-12), 1.5 * a, 8 * a}) {
    const Eigen::MatrixX2d point = ring({1, -2}, r, 7);
    const WaveField field = wave_field({pile}, water, asked(point), {.tolerance = 1e-8});
    EXPECT_LT(field.estimate, 2e-8);  // there are no evanescent modes to leave out
    for (Index p = 0; p < point.rows(); ++p) {
      const double theta = 2 * pi * static_cast<double>(p) / 7;
      Complex expected = 0;
      for (int m = 0; m <= 20; ++m) {
        const double slope = hankel_slope(m, k * a).real();  // J_m′
        const Complex radial = hankel(m, k * r).real() - slope / hankel_slope(m, k * a) * hankel(m, k * r);
        expected += (m == 0 ? 1.0 : 2.0) * std::pow(Complex(0, -1), m) * radial * std::cos(m * theta);
      }
      expected *= std::polar(1.0, -k * 1.0);                                    // the crest is at the global origin
      EXPECT_LT(std::abs(field.total()(p) - expected), 1e-7) << r << ' ' << p;  // ten times the tolerance asked
    }
  }
}

// What a heaving cylinder sends out carries away what its damping takes: ρg/2 |η|² c_g 2πr = B ω²/2 per metre of heave.
TEST(CylinderField, CarriesAwayWhatDampingTakes) {
  const CylinderBody buoy = body("buoy", {{0, 0}, 4, 5});
  const auto solved = hydro::cylinders::solve({buoy}, water, {omega}, {});
  const double r = 400;  // |H₀|² falls as 1/r to 1/(8k²r²), 1e-6 there
  FieldQuestion question = asked(ring({0, 0}, r, 1));
  question.motion(2) = 1;
  const WaveField field = wave_field({buoy}, water, question);
  const double flux = water.density * water.gravity / 2 * std::norm(field.radiated(0)) *
                      hydro::waves::group_velocity(omega, water) * 2 * pi * r;
  const double lost = solved.coefficients.B[0](2, 2) * omega * omega / 2;
  EXPECT_NEAR(flux / lost, 1, 1e-4);
}

/// ∂η/∂r at the side of a cylinder, from three points at and outside of it.
std::vector<Complex> slopes(const std::vector<CylinderBody>& bodies, const Cylinder& at, FieldQuestion question,
                            double step, Eigen::VectorXcd WaveField::*part) {
  constexpr int angles = 8;
  question.point.resize(3 * angles, 2);
  for (int i = 0; i < 3; ++i)
    question.point.middleRows(angles * i, angles) = ring(at.centre, at.radius * (1 + 1e-9) + i * step, angles);
  const WaveField field = wave_field(bodies, water, question, {.tolerance = 1e-6});
  const Eigen::VectorXcd eta = part != nullptr ? field.*part : field.total();
  std::vector<Complex> out;
  for (int t = 0; t < angles; ++t)
    out.push_back((-3.0 * eta(t) + 4.0 * eta(angles + t) - eta(2 * angles + t)) / (2 * step));
  return out;
}

// No water passes a wall that is held still, whatever waves its neighbour sends.
TEST(CylinderField, HasNoSlopeAtWallsThatAreHeld) {
  const Cylinder first{{0, 0}, 3, {}}, second{{8, 3}, 2, {}};
  const std::vector<CylinderBody> both{body("first", first), body("second", second)};
  const double k = hydro::waves::wavenumber(omega, water);
  for (const Cylinder& wall : {first, second})
    for (const Complex slope : slopes(both, wall, asked({}, 2, 0.7), 0.02, nullptr))
      EXPECT_LT(std::abs(slope), 2e-4 * k);  // differences leave (k step)² of k, 6e-6, and curvature of short orders
}

// Water at the wall of a cylinder in surge goes with it: ∂φ/∂r = iωξ cos θ, so ∂η/∂r = (ω²/g) ξ cos θ.
TEST(CylinderField, GoesWithTheWallOfACylinderInSurge) {
  const Cylinder moving{{0, 0}, 4, 6}, held{{16, 2}, 3, 4};
  const std::vector<CylinderBody> both{body("moving", moving), body("held", held)};
  FieldQuestion question = asked({}, 2);
  const Complex xi(0.3, -0.8);
  question.motion(0) = xi;
  const double K = omega * omega / water.gravity;
  const auto at_moving = slopes(both, moving, question, 0.1, &WaveField::radiated);
  const auto at_held = slopes(both, held, question, 0.1, &WaveField::radiated);
  // The slope over the depth jumps at the bottom of a cylinder: of its series some 46 modes are kept, which leave 4 %.
  for (std::size_t t = 0; t < at_moving.size(); ++t) {
    EXPECT_LT(std::abs(at_moving[t] - K * xi * std::cos(2 * pi * static_cast<double>(t) / 8)), 0.06 * K * std::abs(xi))
        << t;
    EXPECT_LT(std::abs(at_held[t]), 0.06 * K * std::abs(xi)) << t;
  }
}

// Points that are nearer to the side ask for more modes: the others are then nearer to the truth than their estimate.
TEST(CylinderField, IsNearerToMoreModesThanItsEstimate) {
  const CylinderBody buoy = body("buoy", {{0, 0}, 4, 5});
  for (const double off : {1.0, 0.3}) {
    FieldQuestion question = asked(ring({0, 0}, 4 + off, 3));
    question.motion(2) = 1;
    const WaveField few = wave_field({buoy}, water, question);
    question.point.conservativeResize(4, 2);
    question.point.row(3) = Eigen::RowVector2d(4.05, 0);
    const WaveField more = wave_field({buoy}, water, question);
    const double change =
        (few.total() - more.total().head(3)).cwiseAbs().maxCoeff() / few.total().cwiseAbs().maxCoeff();
    EXPECT_LT(change, few.estimate);
    EXPECT_LT(few.estimate, 0.02);
  }
}

TEST(CylinderField, TellsNothingWhereACylinderStands) {
  Eigen::MatrixX2d point(3, 2);
  point << 0, 0, 3.9, 0, 4.1, 0;
  const WaveField field = wave_field({body("buoy", {{0, 0}, 4, 5})}, water, asked(point));
  EXPECT_THAT(field.known, testing::ElementsAre(false, false, true));
  EXPECT_EQ(field.scattered(0), Complex(0));
  EXPECT_NE(field.scattered(2), Complex(0));
}

TEST(CylinderField, RefusesQuestionsThatMakeNoSense) {
  const std::vector<CylinderBody> one{body("buoy", {{0, 0}, 4, 5})};
  const auto refused = [&](const FieldQuestion& question, const char* because) {
    EXPECT_THAT([&] { wave_field(one, water, question); },
                testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr(because)));
  };
  refused(asked(Eigen::MatrixX2d(0, 2)), "needs points");
  refused(asked(ring({0, 0}, 9, 4), 2), "six finite motions");
  FieldQuestion question = asked(ring({0, 0}, 9, 4));
  question.omega = -1;
  refused(question, "positive");
  question.omega = 12;  // waves of 0.43 m
  EXPECT_THAT(
      [&] {
        wave_field({body("tank", {{0, 0}, 40, 5})}, water, question);
      },
      testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("wavelengths")));
  question = asked(ring({0, 0}, std::nan(""), 4));
  refused(question, "finite");
}

}  // namespace
}  // namespace hydro::cylinders::field_test
