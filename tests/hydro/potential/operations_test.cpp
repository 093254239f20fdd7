#include "hydro/potential/operations/operations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/waves/dispersion.hpp"

namespace operations_test {
namespace {

using namespace hydro;
using namespace hydro::potential;
using Eigen::Vector3d;

/// Random but sound coefficients of two bodies at ten frequencies and three headings.
Coefficients random_coefficients() {
  Coefficients c;
  c.source = "random";
  const RandomStream random(11, 0);
  std::uint64_t n = 0;
  const auto matrix = [&] {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(12, 12, [&] { return random.normal(n++); }));
  };
  for (const char* name : {"one", "two"}) c.body.emplace_back().name = name;
  for (int i = 1; i <= 10; ++i) {
    c.omega.push_back(0.2 * i);
    c.A.push_back(matrix());
    c.B.push_back(matrix());
  }
  c.A_inf = matrix();
  c.C = matrix();
  c.heading = {0, 0.5, 1.0};
  for (int h = 0; h < 3; ++h)
    c.X.push_back(Eigen::MatrixXcd::NullaryExpr(12, 10, [&] {
      const double re = random.normal(n++), im = random.normal(n++);
      return std::complex<double>(re, im);
    }));
  return c;
}

// (P4): power and stiffness energy do not know about reference points.
TEST(AnotherReferencePoint, LeavesPowerAsItIs) {
  const Coefficients c = random_coefficients();
  const std::vector<Vector3d> from{{1, 2, -3}, {10, 0, 0}}, to{{0.5, -1, 2}, {11, 3, -4}};
  const Coefficients moved = about(c, from, to);
  Eigen::VectorXd v_to = Eigen::VectorXd::LinSpaced(12, -1, 2), v_from(12);
  for (Eigen::Index b = 0; b < 2; ++b) {
    const Vector3d v = v_to.segment<3>(6 * b), w = v_to.segment<3>(6 * b + 3),
                   r = from[static_cast<std::size_t>(b)] - to[static_cast<std::size_t>(b)];
    v_from.segment<3>(6 * b) = v + w.cross(r);
    v_from.segment<3>(6 * b + 3) = w;
  }
  EXPECT_NEAR(v_to.dot(moved.B[3] * v_to), v_from.dot(c.B[3] * v_from),
              1e-11 * std::abs(v_from.dot(c.B[3] * v_from)) + 1e-11);
  EXPECT_NEAR(v_to.dot(*moved.A_inf * v_to), v_from.dot(*c.A_inf * v_from), 1e-9);
  const std::complex<double> before = (v_from.transpose() * c.X[1].col(4))(0),
                             after = (v_to.transpose() * moved.X[1].col(4))(0);
  EXPECT_LT(std::abs(before - after), 1e-11 * std::abs(before) + 1e-11);
  EXPECT_EQ(moved.body[0].reference_point, to[0]);
  const Coefficients back = about(moved, to, from);
  EXPECT_LT((back.A[5] - c.A[5]).norm(), 1e-11 * c.A[5].norm() * 100);  // arms of 10 m enter squared, twice
}

// (P5): a body translated by d meets the crest k·d/ω later.
TEST(TranslatedCoefficients, LagByTheWayOfTheWave) {
  const Coefficients c = random_coefficients();
  const Coefficients there = translated(c, {30, -20});
  for (std::size_t h = 0; h < 3; ++h) {
    const double k = waves::wavenumber(c.omega[6], c.water),
                 way = 30 * std::cos(c.heading[h]) - 20 * std::sin(c.heading[h]);
    EXPECT_LT((there.X[h].col(6) - c.X[h].col(6) * std::polar(1.0, -k * way)).norm(), 1e-12 * c.X[h].col(6).norm());
  }
  EXPECT_EQ(there.A[2], c.A[2]);
}

TEST(SelectedBodies, KeepTheirRowsAndColumns) {
  const Coefficients c = random_coefficients();
  const int second_first[] = {1, 0};
  const Coefficients s = select(c, second_first);
  EXPECT_EQ(s.body[0].name, "two");
  EXPECT_EQ(s.A[4](2, 9), c.A[4](8, 3));
  EXPECT_EQ(s.X[2](1, 7), c.X[2](7, 7));
  const int third[] = {2};
  EXPECT_THAT([&] { select(c, third); }, testing::ThrowsMessage<InputError>(testing::HasSubstr("body 3 is asked for")));
}

TEST(WithoutInteraction, OnlyTheBlocksOfEachBodyStay) {
  const Coefficients c = without_interaction(random_coefficients());
  EXPECT_TRUE((c.B[1].topRightCorner<6, 6>().isZero()));
  EXPECT_FALSE((c.B[1].topLeftCorner<6, 6>().isZero()));
}

/// Coefficients that are parabolas in ω, and excitation that is one but for the wave's way.
Coefficients parabolas(const std::vector<double>& omega, const Vector3d& place) {
  Coefficients c;
  c.source = "parabolas";
  c.body.emplace_back().name = "one";
  c.omega = omega;
  c.heading = {0, 1};
  for (int h = 0; h < 2; ++h) c.X.emplace_back(6, static_cast<Eigen::Index>(omega.size()));
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double w = omega[i], value = 3 - w + 2 * w * w;
    c.A.push_back(value * Eigen::MatrixXd::Identity(6, 6));
    c.B.push_back(-value * Eigen::MatrixXd::Identity(6, 6));
    for (std::size_t h = 0; h < 2; ++h)
      c.X[h]
          .col(static_cast<Eigen::Index>(i))
          .setConstant(value * std::polar(1.0, -waves::wavenumber(w, c.water) * (place.x() * std::cos(c.heading[h]) +
                                                                                 place.y() * std::sin(c.heading[h]))));
  }
  return c;
}

// (P6): exact for parabolas away from the ends, on an uneven grid, whatever the distance from the origin.
TEST(FrequencyTable, IsExactForParabolasOnAnUnevenGrid) {
  const Vector3d place(200, -70, 0);
  const FrequencyTable table(parabolas({0.3, 0.5, 0.6, 1.0, 1.1, 1.7, 2.0}, place), {place});
  for (const double w : {0.5, 0.55, 0.83, 1.05, 1.3, 1.7}) {
    const double value = 3 - w + 2 * w * w;
    EXPECT_NEAR(table.added_mass(w)(2, 2), value, 1e-12);
    EXPECT_NEAR(table.damping(w)(4, 4), -value, 1e-12);
    const std::complex<double> expected = value * std::polar(1.0, -waves::wavenumber(w, Water{}) * 200.0);
    EXPECT_LT(std::abs(table.excitation(w, 0)(1) - expected), 1e-10);
  }
  // At both ends one slope is a straight line's: half an interval's bend, w″h²/16.
  EXPECT_NEAR(table.added_mass(0.4)(0, 0), 3 - 0.4 + 2 * 0.16, 4 * 0.04 / 16 + 1e-12);
}

TEST(FrequencyTable, ConvergesWithTheCubeOfTheSpacing) {
  const auto worst = [](double spacing) {
    Coefficients c = parabolas({0.1}, Vector3d::Zero());
    c.omega.clear();
    c.A.clear();
    c.B.clear();
    c.heading.clear();
    c.X.clear();
    for (double w = spacing; w < 4; w += spacing) {
      c.omega.push_back(w);
      c.A.push_back(std::sin(3 * w) * Eigen::MatrixXd::Identity(6, 6));
      c.B.push_back(c.A.back());
    }
    const FrequencyTable table(c, {Vector3d::Zero()});
    double error = 0;
    for (double w = 1; w < 3; w += 0.0137)
      error = std::max(error, std::abs(table.added_mass(w)(0, 0) - std::sin(3 * w)));
    return error;
  };
  EXPECT_GT(std::log2(worst(0.1) / worst(0.05)), 2.7);  // slopes from parabolas: third order
}

TEST(FrequencyTable, RefusesWhatTheDataDoNotHold) {
  const FrequencyTable table(parabolas({0.3, 0.5, 0.6}, Vector3d::Zero()), {Vector3d::Zero()});
  EXPECT_THAT([&] { table.added_mass(0.7); }, testing::ThrowsMessage<InputError>(testing::AllOf(
                                                  testing::HasSubstr("0.7 rad/s"), testing::HasSubstr("0.3 to 0.6"))));
  EXPECT_THAT([&] { table.excitation(0.5, 1.2); }, testing::ThrowsMessage<InputError>(testing::HasSubstr("heading")));
}

TEST(FrequencyTable, TellsItsErrorOfInterpolation) {
  const FrequencyTable fine(parabolas({0.3, 0.31, 0.32, 0.33}, Vector3d::Zero()), {Vector3d::Zero()});
  const FrequencyTable coarse(parabolas({0.3, 1.3, 2.3, 3.3}, Vector3d::Zero()), {Vector3d::Zero()});
  EXPECT_LT(fine.interpolation_error().added_mass, 1e-4);
  // The bend of a parabola 2ω²: 4·h²/8 = 0.5 at mid-interval, of 21.5 at the last frequency.
  EXPECT_NEAR(coarse.interpolation_error().added_mass, 0.5 / (3 - 3.3 + 2 * 3.3 * 3.3), 1e-6);
}

// What symmetry leaves of yaw is rounding, which no interpolation foresees.
TEST(FrequencyTable, TellsNoErrorOfWhatIsZeroBySymmetry) {
  auto c = parabolas({0.3, 0.31, 0.32, 0.33}, Vector3d::Zero());
  for (std::size_t i = 0; i < c.A.size(); ++i) {
    c.A[i].row(5).setZero();
    c.A[i].col(5).setZero();
  }
  const double known = FrequencyTable(c, {Vector3d::Zero()}).interpolation_error().added_mass;
  for (std::size_t i = 0; i < c.A.size(); ++i) c.A[i](5, 5) = (i % 2 == 0 ? 1e-9 : -1e-9) * c.A[i](4, 4);
  EXPECT_EQ(FrequencyTable(c, {Vector3d::Zero()}).interpolation_error().added_mass, known);
  for (std::size_t i = 0; i < c.A.size(); ++i) c.A[i](5, 5) = (i % 2 == 0 ? 1e-3 : -1e-3) * c.A[i](4, 4);
  EXPECT_GT(FrequencyTable(c, {Vector3d::Zero()}).interpolation_error().added_mass, 0.1);
}

}  // namespace
}  // namespace operations_test
