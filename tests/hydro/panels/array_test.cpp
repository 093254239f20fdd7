// Hulls that stand apart, each kind solved by itself, against all panels in one set of equations and against cylinders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "cylinders/model.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"
#include "panels/hull_array.hpp"
#include "panels/regular_waves.hpp"

namespace hydro::panels::array_test {
namespace {

using Complex = std::complex<double>;
using cylinders::Channels, cylinders::VerticalModes;
using Eigen::Index, Eigen::MatrixXcd, Eigen::MatrixXd, Eigen::Vector3d;
using hydrostatics::box_mesh, hydrostatics::cylinder_mesh;
using std::numbers::pi;

const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(3)};

HullBody body(std::string name, hydrostatics::TriangleMesh mesh, const Vector3d& at) {
  for (Vector3d& v : mesh.vertices) v += at;
  return {std::move(name), at, at + Vector3d(0, 0, -0.2), hydrostatics::Hull(std::move(mesh))};
}

hydrostatics::TriangleMesh box() { return box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6, 4, 3}); }

// ---- partial waves

TEST(RegularWaves, AddUpToAPlaneWave) {
  const VerticalModes modes = VerticalModes::at(2.3, tank, 0);
  const Channels channels{{16}};
  const double radius = 0.9, beta = 0.7;
  MatrixXd point(3, 3), normal(3, 3);
  point << 0.3, -0.5, -0.2, 0, 0, -1.1, -0.8, 0.3, 0;
  normal << 1, 0, 0, 0, 0.6, 0.8, 0.6, -0.8, 0;
  const RegularWaves waves = regular_waves(point, normal, modes, radius, channels);
  const cylinders::RadialScales scale = cylinders::radial_scales(modes, radius, channels);
  const cylinders::WaveIndex at(channels);
  for (Index p = 0; p < 3; ++p) {
    Complex value = 0, slope = 0;
    for (int m = -16; m <= 16; ++m) {
      // e^{−ikr cos(θ−β)} = Σ (−i)^m J_m e^{im(θ−β)}, and J_{−m} = (−1)^m J_m.
      const double sign = m < 0 && m % 2 != 0 ? -1 : 1;
      const Complex a = std::polar(1.0, -m * (beta + pi / 2)) * sign / scale[0][static_cast<std::size_t>(std::abs(m))];
      value += a * waves.value(p, at(0, 0, m));
      slope += a * waves.slope(p, at(0, 0, m));
    }
    const double along = point(p, 0) * std::cos(beta) + point(p, 1) * std::sin(beta), up = point(p, 2) + modes.depth;
    const double norm = std::sqrt(modes.wave_norm_scaled()) * std::exp(modes.k * modes.depth);
    const Complex plane = std::polar(1.0, -modes.k * along) * std::cosh(modes.k * up) / norm;
    const Complex out = Complex(0, -modes.k) * (normal(p, 0) * std::cos(beta) + normal(p, 1) * std::sin(beta)) +
                        normal(p, 2) * modes.k * std::tanh(modes.k * up);
    // On the axis r is taken as a billionth of the radius; elsewhere J_17(0.6) of 1e-23 is left out.
    EXPECT_LT(std::abs(value - plane), 1e-9);
    EXPECT_LT(std::abs(slope - out * plane), 1e-8);
  }
}

TEST(RegularWaves, OfTheDepthHaveTheSlopesOfTheirValues) {
  const VerticalModes modes = VerticalModes::at(2.3, tank, 4);
  const Channels channels{{3, 3, 2, 2, 1}};
  const double step = 1e-5;
  const Vector3d at(0.4, -0.3, -0.7);
  MatrixXd point(7, 3);
  point.rowwise() = at.transpose();
  for (Index i = 0; i < 3; ++i) {
    point(1 + 2 * i, i) += step;
    point(2 + 2 * i, i) -= step;
  }
  MatrixXcd value;
  for (Index axis = 0; axis < 3; ++axis) {
    MatrixXd normal = MatrixXd::Zero(7, 3);
    normal.col(axis).setOnes();
    const RegularWaves waves = regular_waves(point, normal, modes, 0.9, channels);
    const MatrixXcd found = (waves.value.row(1 + 2 * axis) - waves.value.row(2 + 2 * axis)) / (2 * step);
    // Central differences are off by h² f'''/6, 1e-10 (κ a)³ of the values; rounding by 1e-16/1e-5.
    EXPECT_LT((found - waves.slope.row(0)).cwiseAbs().maxCoeff(), 1e-7);
    value = waves.value;
  }
  // Laplace's equation: the mean of six neighbours is the value, but for h⁴.
  const MatrixXcd mean = value.bottomRows(6).colwise().sum() / 6;
  EXPECT_LT((mean - value.row(0)).cwiseAbs().maxCoeff(), 1e-13);
}

// ---- one hull

TEST(HullCompound, OfACylinderIsThatOfTheExactOne) {
  const double radius = 1, draught = 0.8;
  const VerticalModes modes = VerticalModes::at(2.2, tank, 2);
  const Channels channels{{2, 1, 1}};
  const HullBody hull = body("can", cylinder_mesh(radius, draught, 10, 10, 40), {0, 0, 0});
  const Model model(panel_mesh({hull}, tank.depth, true), {hull}, tank);
  const cylinders::Compound ours = compound_of_hull(model, modes, radius, channels);

  const cylinders::TruncatedCylinder exact(radius, draught, 3, 6, 3);
  const VerticalModes all = VerticalModes::at(2.2, tank, exact.exterior_terms(modes.K));
  const cylinders::Scatterer scatterer = exact.at(all, 3, 3);
  const cylinders::Compound theirs =
      cylinders::Array({{{0, 0}, radius, draught}}, {&scatterer}, all, channels, 1e-9).compound(channels);
  const auto off = [](const MatrixXcd& a, const MatrixXcd& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  };
  // Panels of a twelfth of the draught: 1 % of loads in translations (PanelTruth), and of what is sent out the same.
  EXPECT_LT(off(ours.T, theirs.T), 0.02);
  EXPECT_LT(off(ours.R, theirs.R), 0.02);
  EXPECT_LT(off(ours.E, theirs.E), 0.02);
  EXPECT_LT(off(ours.L, theirs.L), 0.02);
  EXPECT_EQ(ours.T.rows(), 11);
}

// ---- arrays

Options asked(Interaction interaction) {
  Options options;
  options.interaction = interaction;
  return options;
}

struct Both {
  Solution one, each;
  double off() const { return difference(each.coefficients, one.coefficients, one.check.length); }
};

/// Two boxes and a cylinder, all panels together and each kind by itself, with panels of 1/`finer` the size.
Both unlike_hulls(int finer) {
  const std::vector<double> omega{1.5, 2.6, 3.4};
  const auto box_of = box_mesh({-0.6, -0.4, -0.5}, {0.6, 0.4, 0}, {6 * finer, 4 * finer, 3 * finer});
  const std::vector<HullBody> hulls{body("box", box_of, {-1.1, 0.3, 0}), body("same", box_of, {0.9, -0.2, 0}),
                                    body("can", cylinder_mesh(0.5, 0.6, 4 * finer, 3 * finer, 16), {0.2, 1.9, 0})};
  return {solve(hulls, tank, omega, {0.4, 2}, asked(Interaction::panels)),
          solve(hulls, tank, omega, {0.4, 2}, asked(Interaction::partial_waves))};
}

// The threshold of 1e-3 leaves out less than 1e-4 here. Both have the same panels, whose waves the one integrates over
// panels and the other takes at their centres: 0.004 with panels of 0.2 m, falling as the square of their size.
TEST(HullArray, OfUnlikeHullsIsWhatAllPanelsTogetherGive) {
  const Both coarse = unlike_hulls(1), fine = unlike_hulls(2);
  EXPECT_EQ(coarse.one.check.kinds, 0);
  EXPECT_EQ(coarse.each.check.kinds, 2);
  EXPECT_GT(coarse.each.check.partial_waves, 10);
  EXPECT_LT(coarse.off(), 5e-3);
  EXPECT_LT(fine.off(), coarse.off() / 2.5);
  // The laws hold as they do for all panels together.
  EXPECT_LT(coarse.each.check.energy, 1.5 * coarse.one.check.energy + 1e-3);
  EXPECT_LT(coarse.each.check.haskind, 1.5 * coarse.one.check.haskind + 1e-3);
  const MatrixXd &each = *coarse.each.coefficients.A_inf, &one = *coarse.one.coefficients.A_inf;
  EXPECT_LT((each - one).cwiseAbs().maxCoeff(), 5e-3 * one.cwiseAbs().maxCoeff());
}

TEST(HullArray, OfCylindersIsThatOfExactOnesWithinItsEstimate) {
  const std::vector<double> omega{1.5, 2.6};
  std::vector<HullBody> hulls;
  std::vector<cylinders::CylinderBody> exact;
  for (const double x : {-1.5, 1.5})
    for (const double y : {-1.5, 1.5}) {
      const std::string name = fmt::format("can {} {}", x, y);
      hulls.push_back(body(name, cylinder_mesh(1, 0.8, 4, 4, 24), {x, y, 0}));
      exact.push_back({name, {x, y, 0}, Vector3d(x, y, -0.2), {{{x, y}, 1, 0.8}}});
    }
  Options options = asked(Interaction::partial_waves);
  options.tolerance = 0.03;
  const Solution ours = solve(hulls, tank, omega, {0.3}, options);
  const auto theirs = cylinders::solve(exact, tank, omega, {0.3}).coefficients;
  const double off = difference(ours.coefficients, theirs, ours.check.length);
  EXPECT_LT(ours.check.estimate, 0.03);
  EXPECT_GT(ours.check.truncation, 0);
  EXPECT_LT(off, ours.check.estimate + 0.01);  // flat faces of 24 columns lack 1 % of the volume, which is not in it
  EXPECT_EQ(ours.check.kinds, 1);
}

TEST(HullArray, InInfiniteDepthIsWhatAllPanelsTogetherGive) {
  const Water deep{.density = 1000, .gravity = 9.81};
  const std::vector<HullBody> hulls{body("box", box(), {-1.1, 0.3, 0}), body("same", box(), {0.9, -0.2, 0})};
  const std::vector<double> omega{1.5, 2.6};
  const Solution one = solve(hulls, deep, omega, {0.4}, asked(Interaction::panels)),
                 each = solve(hulls, deep, omega, {0.4}, asked(Interaction::partial_waves));
  // 0.002 by the quadrature of panels, as above; the depth that is taken for an infinite one is felt by 3e-4.
  EXPECT_LT(difference(each.coefficients, one.coefficients, one.check.length), 4e-3);
  EXPECT_FALSE(each.coefficients.A_zero.has_value());
}

/// Waves between hulls turn with the frequency, what one hull does to waves hardly: that is extrapolated, at as few
/// frequencies as for one hull.
TEST(HullArray, RefinesFarHullsAtFewFrequencies) {
  std::vector<double> omega;
  for (int i = 0; i < 13; ++i) omega.push_back(1 + 0.15 * i);
  std::vector<HullBody> hulls;
  std::vector<cylinders::CylinderBody> exact;
  for (const double x : {-15.0, 15.0}) {
    const std::string name = fmt::format("can {}", x);
    hulls.push_back(body(name, cylinder_mesh(1, 0.8, 3, 3, 24), {x, 0, 0}));
    exact.push_back({name, {x, 0, 0}, Vector3d(x, 0, -0.2), {{{x, 0}, 1, 0.8}}});
  }
  Options options = asked(Interaction::partial_waves);
  options.tolerance = 0.03;
  const Solution ours = solve(hulls, tank, omega, {0.3}, options);
  const auto theirs = cylinders::solve(exact, tank, omega, {0.3}).coefficients;
  EXPECT_EQ(ours.check.refined_omega.size(), 5);
  EXPECT_LT(difference(ours.coefficients, theirs, ours.check.length), ours.check.estimate);
  EXPECT_LT(ours.check.estimate, 0.03);
}

TEST(HullArray, TellsWhatPartialWavesLeaveOut) {
  const std::vector<HullBody> hulls{body("box", box(), {-1.1, 0, 0}), body("same", box(), {1.1, 0, 0})};
  Options options = asked(Interaction::partial_waves);
  const Solution bare = solve(hulls, tank, {2.6}, {}, options);
  EXPECT_TRUE(std::isnan(bare.check.estimate));
  options.refined_frequencies = 1;
  const Solution told = solve(hulls, tank, {2.6}, {}, options);
  EXPECT_GT(told.check.truncation, 0);
  EXPECT_LT(told.check.truncation, 2e-3);  // the threshold is 1e-3
  EXPECT_GT(told.check.estimate, told.check.truncation);
}

TEST(HullArray, IsTakenWhereItIsCheaper) {
  std::vector<HullBody> hulls;
  for (int i = 0; i < 12; ++i) hulls.push_back(body(fmt::format("box{}", i), box(), {2.5 * (i % 4), 2.0 * (i / 4), 0}));
  const std::vector<double> omega{1.5, 2.0, 2.5};
  const Cost many = cost(hulls, tank, omega, {0.0}, {}),
             all = cost(hulls, tank, omega, {0.0}, asked(Interaction::panels));
  EXPECT_GT(many.partial_waves, 0);
  EXPECT_EQ(all.partial_waves, 0);
  EXPECT_LT(many.unknowns, all.unknowns / 8);
  EXPECT_EQ(many.panels, all.panels);
  // Side by side with a gap of 5 cm no circle is free of the neighbour.
  const std::vector<HullBody> near{body("a", box(), {0, 0, 0}), body("b", box(), {1.25, 0, 0})};
  EXPECT_EQ(cost(near, tank, omega, {0.0}, {}).partial_waves, 0);
}

TEST(HullArray, RefusesHullsWhoseCirclesMeet) {
  const std::vector<HullBody> near{body("a", box(), {0, 0, 0}), body("b", box(), {1.25, 0, 0})};
  try {
    solve(near, tank, {1.5}, {}, asked(Interaction::partial_waves));
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("\"a\" and \"b\" are too near to each other for partial waves"));
  }
}

}  // namespace
}  // namespace hydro::panels::array_test
