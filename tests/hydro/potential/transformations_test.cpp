#include "hydro/potential/operations/transformations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/cylinders/solve.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/waves/dispersion.hpp"
#include "smooth_body.hpp"

namespace transformations_test {
namespace {

using froude_test::largest_relative_error;
using froude_test::random_coefficients;
using froude_test::relative_difference;
using froude_test::SmoothBody;
using hydro::InputError;
using hydro::Water;
using hydro::WaterDepth;
using namespace hydro::potential;
using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;
constexpr double pi = std::numbers::pi;
constexpr double solver = 1e-5;  // of the solver of cylinders, asked for and kept (tests/hydro/cylinders)

/// Motions in waves: (−ω²(M + A) + iωB + C) ξ = X.
Eigen::VectorXcd motions(const Coefficients& c, const Eigen::MatrixXd& M, std::size_t heading, std::size_t k) {
  const double w = c.omega[k];
  const Eigen::MatrixXcd Z = (-w * w * (M + c.A[k]) + *c.C) + std::complex<double>(0, w) * c.B[k];
  return Z.partialPivLu().solve(c.X[heading].col(Eigen::Index(k)));
}

/// Two pontoons of different sizes as one body, at (x, y), turned by an angle; symmetric about the line through them.
hydro::cylinders::CylinderBody pair_of_cylinders(double size, Vector2d at, double angle) {
  const Vector2d along(std::cos(angle), std::sin(angle));
  const Vector2d first = at + 2 * size * along, second = at - 2 * size * along;
  return {"pair",
          Vector3d(at.x(), at.y(), -0.5 * size),
          Vector3d(at.x(), at.y(), -0.5 * size),
          {{first, 1.0 * size, 1.5 * size}, {second, 0.6 * size, 1.0 * size}}};
}

Coefficients solved(const hydro::cylinders::CylinderBody& body, const Water& water, const std::vector<double>& omega,
                    const std::vector<double>& heading) {
  return hydro::cylinders::solve({body}, water, omega, heading,
                                 {.tolerance = solver, .threads = 1, .doubled_frequencies = 0})
      .coefficients;
}

/// Equal but for what two runs of the solver may differ by.
void expect_same_body(const Coefficients& a, const Coefficients& b) {
  constexpr double limit = 4 * solver;  // either may be off by its tolerance, measured against pairs of modes
  ASSERT_EQ(a.bodies(), b.bodies());
  for (std::size_t k = 0; k < a.omega.size(); ++k) EXPECT_NEAR(a.omega[k], b.omega[k], 1e-12);
  ASSERT_EQ(a.heading.size(), b.heading.size());
  for (std::size_t h = 0; h < a.heading.size(); ++h) EXPECT_NEAR(a.heading[h], b.heading[h], 1e-9);
  EXPECT_LT(relative_difference(a.A, b.A), limit);
  EXPECT_LT(relative_difference(a.B, b.B), limit);
  EXPECT_LT(relative_difference(a.X, b.X), limit);
  EXPECT_LT(relative_difference(froude_test::listed(a.A_inf), froude_test::listed(b.A_inf)), limit);
  EXPECT_LT(relative_difference(froude_test::listed(a.C), froude_test::listed(b.C)), limit);
  for (std::size_t i = 0; i < a.body.size(); ++i) {
    EXPECT_LT((*a.body[i].reference_point - *b.body[i].reference_point).norm(), 1e-9);
    EXPECT_LT((*a.body[i].centre_of_buoyancy - *b.body[i].centre_of_buoyancy).norm(), 1e-6);
    EXPECT_NEAR(*a.body[i].displaced_volume / *b.body[i].displaced_volume, 1, 1e-9);
  }
}

const Water shallow{1000, 9.81, WaterDepth::from_metres(8)};
const std::vector<double> some_frequencies{0.7, 1.4};

// ---- against the solver of cylinders: the transformed data are those of the transformed body ----

TEST(TurnedBody, IsTheBodyComputedInItsNewPlace) {
  const double angle = 0.6;
  const Vector2d at(5, -3), there = Eigen::Rotation2Dd(angle) * at;
  const Coefficients made =
      turned(solved(pair_of_cylinders(1, at, 0.2), shallow, some_frequencies, {-0.5, 0.9}), angle);
  expect_same_body(made, solved(pair_of_cylinders(1, there, 0.2 + angle), shallow, some_frequencies, {0.1, 1.5}));
}

TEST(ScaledBody, IsTheBodyComputedAtItsNewSize) {
  const double ratio = 2.5;
  const Coefficients made =
      scaled(solved(pair_of_cylinders(1, {1, 2}, 0.3), shallow, some_frequencies, {0.4}), ratio, 1.025);
  const Water deep{1025, 9.81, WaterDepth::from_metres(8 * ratio)};
  expect_same_body(made, solved(pair_of_cylinders(ratio, {1 * ratio, 2 * ratio}, 0.3), deep,
                                {0.7 / std::sqrt(ratio), 1.4 / std::sqrt(ratio)}, {0.4}));
}

TEST(CompletedBySymmetry, TheOtherHalfOfTheHeadingsIsAsComputed) {
  // Fore and aft pontoons on the x axis: port and starboard are alike. On the y axis: fore and aft are.
  expect_same_body(
      completed_by_symmetry(solved(pair_of_cylinders(1, {3, 0}, 0), shallow, some_frequencies, {0, 0.7, 2}),
                            MirrorPlane::y0),
      solved(pair_of_cylinders(1, {3, 0}, 0), shallow, some_frequencies, {-2, -0.7, 0, 0.7, 2}));
  expect_same_body(completed_by_symmetry(
                       solved(pair_of_cylinders(1, {0, -2}, pi / 2), shallow, some_frequencies, {-0.5, 0.7, pi / 2}),
                       MirrorPlane::x0),
                   solved(pair_of_cylinders(1, {0, -2}, pi / 2), shallow, some_frequencies,
                          {-0.5, 0.7, pi / 2, pi - 0.7, pi + 0.5}));
}

TEST(RepeatedBody, EveryCopyIsTheBodyComputedInItsPlace) {
  const Vector2d home(1, 1), place[] = {{0, 0}, {40, -25}, {-7, 60}};
  const Coefficients array =
      repeated(solved(pair_of_cylinders(1, home, 0.3), shallow, some_frequencies, {0.4, 2}), place);
  ASSERT_EQ(array.bodies(), 3);
  for (int b = 0; b < 3; ++b) {
    const int which[] = {b};
    expect_same_body(select(array, which),
                     solved(pair_of_cylinders(1, home + place[b], 0.3), shallow, some_frequencies, {0.4, 2}));
  }
  EXPECT_TRUE((array.A[0].block<6, 6>(0, 6).isZero(0)));
}

// ---- laws for any numbers ----

TEST(TurnedArray, ComesBack) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Coefficients c = random_coefficients(seed), back = turned(turned(c, 1.1), -1.1);
    // Entries span twenty powers of ten and a turn mixes them in pairs: measured against the largest.
    EXPECT_LT(relative_difference(back.A, c.A), 1e-14);
    EXPECT_LT(relative_difference(back.B, c.B), 1e-14);
    if (c.X.empty()) continue;
    EXPECT_LT(relative_difference(back.X, c.X), 1e-14);
    // A table may come back a full circle away.
    EXPECT_NEAR(std::remainder(back.heading[0] - c.heading[0], 2 * pi), 0, 1e-14);
  }
}

TEST(TurnedArray, MovesAsItDidAndCarriesItsPhasesAlong) {
  const double angle = -0.8;
  SmoothBody body{.bodies = 2};
  Coefficients c = body.coefficients(shallow, {0.5, 1.1}, {0.2, 0.9});
  // Turning and translating may change their order.
  const Vector2d d(30, -12);
  const Coefficients one = turned(translated(c, d), angle),
                     other = translated(turned(c, angle), Eigen::Rotation2Dd(angle) * d);
  EXPECT_LT(relative_difference(one.X, other.X), 1e-13);  // phases of a few radians
  // Motions turn with the array.
  Eigen::MatrixXd M = 1e5 * Eigen::MatrixXd::Identity(12, 12);
  const Coefficients t = turned(c, angle);
  const Eigen::VectorXcd before = motions(c, M, 1, 1), after = motions(t, M, 1, 1);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  for (Eigen::Index part = 0; part < 12; part += 3)
    EXPECT_LT((after.segment<3>(part) - R * before.segment<3>(part)).norm(), 1e-12 * before.norm());
}

TEST(TurnedArray, IsExactForAHalfTurn) {
  const Coefficients c = SmoothBody{}.coefficients({}, {0.5}, {0.2}), t = turned(c, pi);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      EXPECT_EQ(t.A[0](i, j), (i % 3 == 2 ? 1 : -1) * (j % 3 == 2 ? 1 : -1) * c.A[0](i, j));
}

TEST(TurnedArray, KeepsATableOverTheFullCircleClosed) {
  std::vector<double> heading;
  for (int i = 0; i <= 12; ++i) heading.push_back(30 * i * degree);
  const Coefficients c = SmoothBody{}.coefficients({}, {0.5}, heading), t = turned(c, 90 * degree);
  ASSERT_EQ(t.heading.size(), 13u);
  for (int i = 0; i <= 12; ++i) EXPECT_NEAR(t.heading[std::size_t(i)], 30 * i * degree, 1e-12);
  EXPECT_EQ(t.X.front(), t.X.back());
  EXPECT_LT(std::abs(t.X[3](2, 0) - c.X[0](2, 0)), 1e-9);  // what came from 0 now comes from 90 degrees
  t.validate();
}

TEST(ScaledArray, ComesBack) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Coefficients c = random_coefficients(seed), back = scaled(scaled(c, 7.3, 1.02), 1 / 7.3, 1 / 1.02);
    constexpr double roundings = 3e-15;  // powers and products, a dozen roundings
    EXPECT_LT(largest_relative_error(back.A, c.A), roundings);
    EXPECT_LT(largest_relative_error(back.B, c.B), roundings);
    EXPECT_LT(largest_relative_error(back.X, c.X), roundings);
    EXPECT_LT(largest_relative_error(froude_test::listed(back.C), froude_test::listed(c.C)), roundings);
    EXPECT_NEAR(back.omega[0] / c.omega[0], 1, roundings);
    EXPECT_NEAR(back.water.density / c.water.density, 1, roundings);
  }
}

TEST(ScaledArray, MovesAlikeInSimilarWaves) {
  // ξ/a is the same for translations and 1/λ for rotations.
  const double ratio = 36, rho = 1.025;
  const Coefficients c = SmoothBody{}.coefficients(shallow, {0.5, 1.1}, {0.2}), big = scaled(c, ratio, rho);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6, 6), M_big = M;
  for (Eigen::Index i = 0; i < 6; ++i) {
    M(i, i) = 1e5 + 1e3 * double(i);
    M_big(i, i) = M(i, i) * rho * std::pow(ratio, i < 3 ? 3 : 5);
  }
  const Eigen::VectorXcd small_motion = motions(c, M, 0, 1), big_motion = motions(big, M_big, 0, 1);
  EXPECT_LT((big_motion.head<3>() - small_motion.head<3>()).norm(), 1e-12 * small_motion.head<3>().norm());
  EXPECT_LT((ratio * big_motion.tail<3>() - small_motion.tail<3>()).norm(), 1e-12 * small_motion.tail<3>().norm());
  const double k = hydro::waves::wavenumber(c.omega[1], c.water), K = hydro::waves::wavenumber(big.omega[1], big.water);
  EXPECT_NEAR(K * ratio / k, 1, 1e-12) << "waves are similar too";
}

TEST(CompletedBySymmetry, ClosesTheCircleAndRefusesWhatIsNotSymmetric) {
  std::vector<double> half;
  for (int i = 0; i <= 6; ++i) half.push_back(30 * i * degree);
  Coefficients c = SmoothBody{}.coefficients({}, {0.5}, half);
  c.C.reset();
  for (auto* set : {&c.A, &c.B}) *set = {Eigen::MatrixXd::Identity(6, 6)};
  c.A_zero.reset();
  c.A_inf.reset();
  for (std::size_t h = 0; h < half.size(); ++h)  // along the plane nothing goes across it
    for (const Eigen::Index across : {1, 3, 5}) c.X[h].row(across) *= std::sin(half[h]);
  const Coefficients whole = completed_by_symmetry(c, MirrorPlane::y0);
  ASSERT_EQ(whole.heading.size(), 13u);
  EXPECT_NEAR(whole.heading.front(), -pi, 1e-12);
  EXPECT_NEAR(whole.heading.back(), pi, 1e-12);
  whole.validate();
  EXPECT_EQ(completed_by_symmetry(whole, MirrorPlane::y0).heading.size(), 13u) << "nothing is left to add";
  c.A[0](1, 2) = 0.5;
  EXPECT_THAT(
      [&] { completed_by_symmetry(c, MirrorPlane::y0); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("A couples modes"), HasSubstr("by 1 of"))));  // 0.5 against −0.5
  c.A[0](1, 2) = 0;
  c.body[0].reference_point = Vector3d(0, 1, 0);
  EXPECT_THAT([&] { completed_by_symmetry(c, MirrorPlane::y0); },
              ThrowsMessage<InputError>(HasSubstr("off the plane")));
}

/// The frequencies `which` of a table.
Coefficients part_of(const Coefficients& c, const std::vector<std::size_t>& which) {
  Coefficients out = c;
  out.omega.clear();
  out.A.clear();
  out.B.clear();
  std::vector<Eigen::Index> columns;
  for (const std::size_t k : which) {
    out.omega.push_back(c.omega[k]);
    out.A.push_back(c.A[k]);
    out.B.push_back(c.B[k]);
    columns.push_back(Eigen::Index(k));
  }
  for (auto& X : out.X) X = Eigen::MatrixXcd(X(Eigen::all, columns));
  return out;
}

TEST(MergedRuns, AreTheTableThatWasCutIntoThem) {
  const Coefficients c = SmoothBody{.bodies = 2}.coefficients(shallow, {0.3, 0.5, 0.8, 1.1, 1.7}, {0.0, 1.0});
  Coefficients low = part_of(c, {0, 1, 3}), high = part_of(c, {2, 3, 4});
  low.A_inf.reset();
  high.A_zero.reset();
  const Coefficients runs[] = {low, high}, whole = merged(runs);
  EXPECT_EQ(whole.omega, c.omega);
  EXPECT_EQ(whole.A, c.A);
  EXPECT_EQ(whole.B, c.B);
  EXPECT_EQ(whole.X, c.X);
  EXPECT_EQ(*whole.A_inf, *c.A_inf);
  EXPECT_EQ(*whole.A_zero, *c.A_zero);
}

TEST(MergedRuns, AreRefusedIfTheyAreOfDifferentBodies) {
  const Coefficients c = SmoothBody{}.coefficients(shallow, {0.3, 0.5}, {0.0, 1.0});
  const auto refused = [&](auto change, const char* what) {
    Coefficients other = c;
    change(other);
    const Coefficients runs[] = {c, other};
    EXPECT_THAT([&] { merged(runs); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  refused([](Coefficients& o) { o.water.density = 1025; }, "density");
  refused([](Coefficients& o) { o.water.depth = WaterDepth::infinite(); }, "depth");
  refused([](Coefficients& o) { o.heading[1] = 1.1; }, "headings");
  refused([](Coefficients& o) { o.A[1](2, 2) *= 1.1; }, "A at 0.5 rad/s");
  refused([](Coefficients& o) { (*o.C)(2, 2) *= 1.1; }, "C, by");
  refused(
      [](Coefficients& o) {
        o = SmoothBody{.bodies = 2}.coefficients(shallow, {0.3}, {0.0, 1.0});
      },
      "number of bodies");
}

TEST(ResampledTable, IsOffByLessThanItSaysAndNotFarLess) {
  std::vector<double> omega, middle;
  for (int i = 0; i <= 20; ++i) omega.push_back(0.3 + 0.1 * i);
  for (int i = 0; i < 20; ++i) middle.push_back(0.35 + 0.1 * i);
  const SmoothBody body;
  const Coefficients c = body.coefficients(shallow, omega, {0.0, 0.5}),
                     exact = body.coefficients(shallow, middle, {0.0, 0.5});
  const Resampled r = resampled(c, middle);
  const auto off = [](const auto& a, const auto& b) {
    double worst = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
      for (Eigen::Index i = 0; i < a[k].rows(); ++i) {
        double size = 0;
        for (const auto& m : b) size = std::max(size, m.row(i).cwiseAbs().maxCoeff());
        worst = std::max(worst, (a[k].row(i) - b[k].row(i)).cwiseAbs().maxCoeff() / size);
      }
    return worst;
  };
  const double A = off(r.coefficients.A, exact.A), B = off(r.coefficients.B, exact.B),
               X = off(r.coefficients.X, exact.X);
  EXPECT_LT(A, r.error.added_mass);
  EXPECT_LT(B, r.error.damping);
  EXPECT_LT(X, r.error.excitation);
  EXPECT_LT(r.error.added_mass, 10 * A);
  EXPECT_LT(r.error.damping, 10 * B);
  EXPECT_LT(r.error.excitation, 10 * X);
  // Its own frequencies give the table back.
  EXPECT_LT(relative_difference(resampled(c, omega).coefficients.A, c.A), 1e-15);
  EXPECT_THAT([&] { resampled(c, std::vector{0.1, 0.5}); }, ThrowsMessage<InputError>(HasSubstr("0.1 rad/s")));
  EXPECT_THAT([&] { resampled(c, std::vector{0.6, 0.5}); }, ThrowsMessage<InputError>(HasSubstr("must increase")));
}

TEST(Transformations, RefuseNumbersThatHaveNoMeaning) {
  const Coefficients c = SmoothBody{}.coefficients({}, {0.5}, {0.0}),
                     two = SmoothBody{.bodies = 2}.coefficients({}, {0.5}, {});
  const Vector2d same[] = {{1, 1}, {1, 1}};
  EXPECT_THROW(scaled(c, 0), InputError);
  EXPECT_THROW(scaled(c, 2, -1), InputError);
  EXPECT_THROW(turned(c, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THAT([&] { repeated(c, same); }, ThrowsMessage<InputError>(HasSubstr("places 1 and 2")));
  EXPECT_THAT([&] { repeated(two, same); }, ThrowsMessage<InputError>(HasSubstr("one body")));
  EXPECT_THAT([&] { completed_by_symmetry(two, MirrorPlane::x0); },
              ThrowsMessage<InputError>(HasSubstr("no excitation")));
}

}  // namespace
}  // namespace transformations_test
