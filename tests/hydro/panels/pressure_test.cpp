// The pressure on hulls in a wave: its integral against loads, long waves, and a cylinder against its closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <boost/math/special_functions/hankel.hpp>
#include <cmath>
#include <numbers>

#include "hulls.hpp"
#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/field.hpp"
#include "hydro/waves/dispersion.hpp"
#include "panels/pressure.hpp"

namespace hydro::panels::pressure_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index, Eigen::Vector3d;
using hydrostatics::box_mesh, hydrostatics::cylinder_mesh;
using potential::FieldQuestion, potential::HullPressure, potential::WetPanel;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(3)};

/// Bodies held still, a wave, and one point far from all of them.
FieldQuestion held(double omega, double heading, std::size_t bodies) {
  FieldQuestion out{omega, heading, Eigen::VectorXcd::Zero(6 * static_cast<Index>(bodies)),
                    Eigen::MatrixX2d::Constant(1, 2, 40)};
  out.pressure = true;
  return out;
}

/// Two boxes that are each other's image, so that panels of three images are the work of one, with no motion left out.
std::vector<HullBody> two_boxes() {
  return {body("fore", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}), {-1.4, 0, 0}),
          body("aft", box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}), {1.4, 0, 0})};
}
FieldQuestion moving_boxes() {
  FieldQuestion out = held(2.3, 0.7, 2);
  out.motion << 0.4, Complex(0, 0.2), Complex(-0.3, 0.5), 0.1, Complex(0, 0.3), -0.2, Complex(0.1, 0.1), 0.3,
      Complex(0, 0.6), Complex(0.2, 0.1), 0.1, Complex(0, -0.4);
  return out;
}

// The same sums in another order.
TEST(PanelPressure, IntegratesToExcitationAddedMassAndDampingToRounding) {
  const std::vector<HullBody> both = two_boxes();
  const FieldQuestion q = moving_boxes();
  const Model model(panel_mesh(both, tank.depth, true), both, tank);
  ASSERT_EQ(model.mesh().images.size(), 4U);
  const HullPressure hulls = pressure_of(model, tank, q, model.in_wave(q.omega, q.heading));
  const OneFrequency c = model.at(q.omega, {q.heading});
  const Eigen::VectorXcd expected =
      c.X.col(0) + (q.omega * q.omega * c.A.cast<Complex>() - Complex(0, q.omega) * c.B.cast<Complex>()) * q.motion;
  for (int b = 0; b < 2; ++b) {
    const Eigen::VectorXcd load = dynamic_load(hulls, b, both[static_cast<std::size_t>(b)].reference_point);
    EXPECT_LT((load - expected.segment<6>(6 * b)).norm(), 1e-12 * expected.norm()) << "body " << b;
  }
}

// A box that heaves and turns by a little loses buoyancy as its waterplane says; of linear functions over flat panels
// the value at the centre is the mean.
TEST(PanelPressure, OfStillWaterOnAMovingHullIsItsRestoring) {
  const std::vector<HullBody> both = two_boxes();
  const FieldQuestion q = moving_boxes();
  const HullPressure hulls = *wave_field(both, tank, q, {.interaction = Interaction::panels}).on_hulls;
  HullPressure still = hulls;
  still.dynamic = hulls.hydrostatic;
  for (int b = 0; b < 2; ++b) {
    const Complex heave = dynamic_load(still, b, both[static_cast<std::size_t>(b)].reference_point)(2);
    const Complex expected = -tank.density * tank.gravity * 1.2 * 0.8 * q.motion(6 * b + 2);
    EXPECT_LT(std::abs(heave - expected), 1e-10 * std::abs(expected)) << "body " << b;
  }
}

// A panel rises as a turn by a small angle lifts it; the square of the angle is left over.
TEST(PanelPressure, OfStillWaterGrowsAsAPanelSinks) {
  constexpr double small = 1e-5;
  const std::vector<HullBody> both = two_boxes();
  const FieldQuestion q = moving_boxes();
  const HullPressure hulls = *wave_field(both, tank, q, {.interaction = Interaction::panels}).on_hulls;
  for (std::size_t i = 0; i < hulls.panel.size(); ++i) {
    const WetPanel& p = hulls.panel[i];
    const Eigen::VectorXd motion = small * q.motion.segment<6>(6 * p.body).real();
    const Eigen::AngleAxisd turn(motion.tail<3>().norm(), motion.tail<3>().normalized());
    const Vector3d arm = p.centre - both[static_cast<std::size_t>(p.body)].reference_point;
    const double rise = (motion.head<3>() + turn * arm - arm).z() / small;
    EXPECT_NEAR(hulls.hydrostatic(static_cast<Index>(i)).real(), -9810 * rise, 9810 * small);
  }
}

TEST(PanelPressure, HasPanelsOfAllImagesWithTheirBodiesAndNormals) {
  const std::vector<HullBody> both = two_boxes();
  const HullPressure hulls = *wave_field(both, tank, moving_boxes(), {.interaction = Interaction::panels}).on_hulls;
  double area[2] = {0, 0};
  for (const WetPanel& p : hulls.panel) {
    area[p.body] += p.area;
    const Vector3d across = (p.corners[1] - p.corners[0]).cross(p.corners[2] - p.corners[1]).normalized();
    EXPECT_LT((across - p.normal).norm(), 1e-9);
    EXPECT_GT(p.normal.dot(p.centre - Vector3d(p.body == 0 ? -1.4 : 1.4, 0, -0.25)), 0);
  }
  const double box = 1.2 * 0.8 + 2 * 0.5 * (1.2 + 0.8);
  EXPECT_NEAR(area[0], box, 1e-12);
  EXPECT_NEAR(area[1], box, 1e-12);
}

// Long waves do not see a small sphere: it changes their pressure by the half of k a of a dipole in a uniform flow.
TEST(PanelPressure, OfLongWavesOnASmallSphereIsThatOfTheWaveAlone) {
  constexpr double a = 0.1, depth = 2, omega = 1;
  const Water deep{.density = 1000, .gravity = 9.81};
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= 8; ++i)
    profile.emplace_back(i % 8 == 0 ? 0 : a * std::sin(std::numbers::pi * i / 8),
                         a * std::cos(std::numbers::pi * i / 8));
  const double k = omega * omega / deep.gravity, heading = 0.4;
  const HullPressure hulls =
      *wave_field({body("ball", hydrostatics::revolved(profile, 12), {3, 1, -depth})}, deep, held(omega, heading, 1))
           .on_hulls;
  for (std::size_t i = 0; i < hulls.panel.size(); ++i) {
    const Vector3d& at = hulls.panel[i].centre;
    const Complex wave =
        9810 * std::exp(k * at.z()) * std::polar(1.0, -k * (at.x() * std::cos(heading) + at.y() * std::sin(heading)));
    EXPECT_LT(std::abs(hulls.dynamic(static_cast<Index>(i)) - wave), 0.6 * k * a * std::abs(wave));
  }
}

/// p/(ρg ζ cosh k(z+h)/cosh kh) on a cylinder of radius a on the bed, at the angle θ from where the wave goes: the
/// incident wave's partial waves and what leaves with the opposite slope (MacCamy & Fuchs 1954); the Wronskian joins
/// both.
Complex maccamy_fuchs(double ka, double theta) {
  Complex sum = 0, turn = 1;
  for (int m = 0; m < 20; ++m, turn *= Complex(0, -1)) {
    const Complex slope = (boost::math::cyl_hankel_2(m - 1, ka) - boost::math::cyl_hankel_2(m + 1, ka)) / 2.0;
    sum += (m == 0 ? 1.0 : 2.0) * turn * std::cos(m * theta) * Complex(0, -2) / (std::numbers::pi * ka * slope);
  }
  return sum;
}

// Flat sides of 7.5 degrees stand off the circle by 0.2 % of the radius, and constant panels leave about a percent of
// the largest at the waterline.
TEST(PanelPressure, OfACylinderOnTheBedIsThatOfMacCamyAndFuchs) {
  constexpr double a = 1, omega = 3, heading = 0.3;
  const double k = waves::wavenumber(omega, tank), h = tank.depth.metres();
  const HullPressure hulls =
      *wave_field({body("pile", cylinder_mesh(a, h, 8, 1, 24), {0, 0, 0})}, tank, held(omega, heading, 1)).on_hulls;
  double largest = 0, worst = 0, highest = -h;
  for (const WetPanel& p : hulls.panel) highest = std::max(highest, p.centre.z());
  for (std::size_t i = 0; i < hulls.panel.size(); ++i) {
    const Vector3d& at = hulls.panel[i].centre;
    const Complex expected = 9810 * std::cosh(k * (at.z() + h)) / std::cosh(k * h) *
                             maccamy_fuchs(k * a, std::atan2(at.y(), at.x()) - heading);
    largest = std::max(largest, std::abs(expected));
    worst = std::max(worst, std::abs(hulls.dynamic(static_cast<Index>(i)) - expected));
  }
  EXPECT_GT(largest, 1.5 * 9810);  // in front of it the wave is nearly doubled
  EXPECT_GT(highest, -0.05);       // round the waterline too
  EXPECT_LT(worst, 0.02 * largest);
  EXPECT_LT(worst, hulls.estimate * largest);
}

TEST(PanelPressure, IsRefusedWherePartialWavesJoinHulls) {
  EXPECT_THAT([] { wave_field(two_boxes(), tank, moving_boxes(), {.interaction = Interaction::partial_waves}); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("partial waves")));
}

}  // namespace
}  // namespace hydro::panels::pressure_test
