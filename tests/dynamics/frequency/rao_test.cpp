#include "dynamics/frequency/amplitudes.hpp"
#include "dynamics/frequency/signal_amplitudes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/restoring.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/two_pole_body.hpp"

namespace rao_test {
namespace {

using namespace dynamics;
using frequency::PotentialGroup;
using hydro::potential::Coefficients;

const support::TwoPoleBody water{};

/// Coefficients of bodies along x that do not feel each other: the two-pole body in every mode, excitation by the
/// wave's phase.
Coefficients coefficients(const std::vector<double>& places) {
  Coefficients c;
  c.source = "two-pole bodies";
  const auto n = 6 * static_cast<Eigen::Index>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) c.body.emplace_back().name = "body" + std::to_string(i + 1);
  for (int i = 1; i <= 40; ++i) {
    const double omega = 0.1 * i;
    c.omega.push_back(omega);
    c.A.push_back((500 + 300 * water.A_minus_A_inf(omega)) * Eigen::MatrixXd::Identity(n, n));
    c.B.push_back(300 * water.B(omega) * Eigen::MatrixXd::Identity(n, n));
  }
  c.A_inf = 500 * Eigen::MatrixXd::Identity(n, n);
  c.heading = {0};
  Eigen::MatrixXcd X(n, 40);
  for (int w = 0; w < 40; ++w)
    for (std::size_t b = 0; b < places.size(); ++b)
      X.col(w)
          .segment<6>(6 * static_cast<Eigen::Index>(b))
          .setConstant(
              2000.0 *
              std::polar(1.0, -hydro::waves::wavenumber(c.omega[static_cast<std::size_t>(w)], c.water) * places[b]));
  c.X = {X};
  return c;
}

RigidBody body(const std::string& name, double x) {
  return RigidBody({.name = name,
                    .mass = 1000,
                    .inertia = 1000 * Eigen::Matrix3d::Identity(),
                    .rest_position = {Eigen::Vector3d(x, 0, 0)}});
}

Model sprung(const std::vector<RigidBody>& bodies, double k, double c,
             std::unique_ptr<const ForceKind> more = nullptr) {
  std::vector<std::unique_ptr<const ForceKind>> f;
  std::vector<Restoring> r;
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
    r.push_back({i, k * Matrix6::Identity(), c * Matrix6::Identity()});
  f.push_back(std::make_unique<RestoringKind>("mooring", bodies, r));
  if (more) f.push_back(std::move(more));
  return Model(bodies, {}, std::move(f));
}

PotentialGroup group(const Coefficients& c, std::vector<double> places) {
  std::vector<Eigen::Vector3d> origins;
  std::vector<int> bodies;
  for (const double x : places) {
    bodies.push_back(static_cast<int>(origins.size()));
    origins.emplace_back(x, 0, 0);
  }
  return {bodies, hydro::potential::FrequencyTable(c, origins), true, true};
}

// (Q1) for one mode by hand.
TEST(Rao, OfOneModeIsTheClosedForm) {
  const std::vector<RigidBody> bodies{body("a", 0)};
  const Model model = sprung(bodies, 2500, 40);
  const double omega = 1.0;  // a frequency of the table, so nothing is interpolated
  const auto xi = frequency::response_amplitudes(model, {group(coefficients({0}), {0})}, {omega}, 0);
  const std::complex<double> Z(2500 - omega * omega * (1500 + 300 * water.A_minus_A_inf(omega)),
                               omega * (40 + 300 * water.B(omega)));
  for (int mode = 0; mode < 6; ++mode) EXPECT_LT(std::abs(xi(mode, 0) - 2000.0 / Z), 1e-12);
}

TEST(Rao, InterpolatesTheWayOfTheWaveExactly) {
  const std::vector<RigidBody> bodies{body("a", 150)};
  const Model model = sprung(bodies, 2500, 40);
  const double omega = 2.05,
               k = hydro::waves::wavenumber(omega, hydro::Water{});  // between two frequencies; kx = 64 rad
  const auto far = frequency::response_amplitudes(model, {group(coefficients({150}), {150})}, {omega}, 0);
  const auto near =
      frequency::response_amplitudes(sprung({body("a", 0)}, 2500, 40), {group(coefficients({0}), {0})}, {omega}, 0);
  EXPECT_LT(std::abs(far(2, 0) - near(2, 0) * std::polar(1.0, -150 * k)), 1e-10 * std::abs(near(2, 0)));
}

// Rows and columns: a connector between two bodies gives equal and opposite forces, so momentum needs both bodies'
// equations.
TEST(Rao, OfTwoSprungBodiesSolvesBothEquations) {
  const std::vector<RigidBody> bodies{body("a", 0), body("b", 10)};
  const double kc = 800;
  const Ends ends{{0, Eigen::Vector3d(1, 0, 0)}, PointOnBody{1, Eigen::Vector3d(-1, 0, 0)}};
  const Model model =
      sprung(bodies, 2500, 40, std::make_unique<AxialConnectorKind>(std::vector<AxialConnector>{{ends, {kc, 0}, 8}}));
  const Coefficients c = coefficients({0, 10});
  const double omega = 1.5;
  const auto xi = frequency::response_amplitudes(model, {group(c, {0, 10})}, {omega}, 0);
  const std::complex<double> Z(2500 - omega * omega * (1500 + 300 * water.A_minus_A_inf(omega)),
                               omega * (40 + 300 * water.B(omega)));
  const std::complex<double> x1 = xi(0, 0), x2 = xi(6, 0), stretch = x2 - x1;
  EXPECT_LT(std::abs(Z * x1 - kc * stretch - c.X[0](0, 14)), 1e-9);
  EXPECT_LT(std::abs(Z * x2 + kc * stretch - c.X[0](6, 14)), 1e-9);
  EXPECT_GT(std::abs(stretch), 0.1);
}

// Energy: over a period the waves supply what radiation and dampers take, ½ Re(iω ξ* … ) summed over the modes.
TEST(Rao, BalancesThePowerOfTheWaves) {
  const std::vector<RigidBody> bodies{body("a", 0), body("b", 10)};
  const Ends ends{{0, Eigen::Vector3d(1, 1, 0)}, PointOnBody{1, Eigen::Vector3d(-1, 0, 0)}};
  const Model model =
      sprung(bodies, 2500, 40,
             std::make_unique<AxialConnectorKind>(std::vector<AxialConnector>{{ends, {800, 60}, std::sqrt(65.0)}}));
  const auto g = group(coefficients({0, 10}), {0, 10});
  for (const double omega : {0.7, 1.3, 2.2}) {
    const Eigen::VectorXcd x = frequency::response_amplitudes(model, {g}, {omega}, 0).col(0),
                           v = std::complex<double>(0, omega) * x;
    const double supplied = 0.5 * (v.adjoint() * g.table.excitation(omega, 0))(0).real();
    const double taken = 0.5 * (v.adjoint() * (g.table.damping(omega) + model.linear_at_rest().damping) * v)(0).real();
    EXPECT_NEAR(supplied, taken, 1e-10 * taken);
  }
}

/// The same bodies in waves from several sides, whose excitation differs in size and phase from mode to mode.
Coefficients from_sides(Coefficients c, const std::vector<double>& headings) {
  const Eigen::MatrixXcd ahead = c.X.front();
  c.heading = headings;
  c.X.clear();
  for (const double beta : headings) {
    Eigen::MatrixXcd& X = c.X.emplace_back(ahead);
    for (Eigen::Index m = 0; m < X.rows(); ++m)
      X.row(m) *= std::polar(1 + 0.5 * std::cos(beta + double(m)), 0.3 * beta);
  }
  return c;
}

// The same factors on more columns: the sums are those of one heading, in another order.
TEST(RaoHeadings, AreThoseOfOneByOneFromOneFactorisationAFrequency) {
  const std::vector<RigidBody> bodies{body("a", 0), body("b", 10)};
  const Ends ends{{0, Eigen::Vector3d(1, 1, 0)}, PointOnBody{1, Eigen::Vector3d(-1, 0, 0)}};
  const Model model =
      sprung(bodies, 2500, 40,
             std::make_unique<AxialConnectorKind>(std::vector<AxialConnector>{{ends, {800, 60}, std::sqrt(65.0)}}));
  const std::vector<double> data{-0.5, 0.1, 0.8, 2.0}, omega{0.5, 1.23, 1.4, 3.0}, asked{2.0, -0.5, 0.3};
  const std::vector<PotentialGroup> groups{group(from_sides(coefficients({0, 10}), data), {0, 10})};
  const auto together = frequency::response_amplitudes(model, groups, omega, asked, {});
  EXPECT_EQ(together.factorisations, 4) << "one at each of four frequencies, for three headings";
  ASSERT_EQ(together.xi.size(), asked.size());
  for (std::size_t h = 0; h < asked.size(); ++h) {
    const Eigen::MatrixXcd alone = frequency::response_amplitudes(model, groups, omega, asked[h]);
    EXPECT_LT((together.xi[h] - alone).norm(), 1e-13 * alone.norm()) << asked[h];
  }
  EXPECT_GT((together.xi[0] - together.xi[1]).norm(), 0.1 * together.xi[0].norm()) << "headings differ";
}

TEST(RaoHeadings, AreAllRefusedAtAnUndampedResonance) {
  const std::vector<RigidBody> bodies{body("a", 0)};
  auto g = group(from_sides(coefficients({0}), {0, 1}), {0});
  g.radiation = false;
  EXPECT_THAT(
      [&] {
        frequency::response_amplitudes(sprung(bodies, 1000, 0), {g}, {1.0}, {0, 1}, {});
      },
      testing::ThrowsMessage<hydro::NumericsError>(testing::HasSubstr("at 1 rad/s")));
}

/// Twelve bodies in a row, each on springs to the ground and to the next, joined in pairs by hinges if asked; some hold
/// still in sway.
Model row_of_bodies(bool hinged) {
  constexpr int count = 12;
  std::vector<RigidBody> bodies;
  std::vector<AxialConnector> connectors;
  std::vector<Joint> joints;
  for (int i = 0; i < count; ++i) {
    bodies.push_back(RigidBody({.name = fmt::format("b{}", i + 1),
                                .mass = 1000.0 + 10 * i,
                                .inertia = Eigen::Vector3d(800, 900, 1000).asDiagonal(),
                                .rest_position = {Eigen::Vector3d(10 * i, 0, 0)},
                                .free = {true, i % 5 != 2 || hinged, true, true, true, true}}));
    if (i > 0)
      connectors.push_back({Ends{{i - 1, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{i, Eigen::Vector3d(-1, 1, 0)}},
                            {800, 60},
                            std::hypot(8, 0.5, 0.2)});
    if (hinged && i % 2 == 1)
      joints.push_back({.name = fmt::format("h{}", i),
                        .kind = JointKind::hinge,
                        .first = i - 1,
                        .second = i,
                        .place = Eigen::Vector3d(10 * i - 5, 0, 0.3),
                        .axis = Eigen::Vector3d::UnitY()});
  }
  std::vector<std::unique_ptr<const ForceKind>> forces;
  std::vector<Restoring> springs;
  for (int i = 0; i < count; ++i)
    springs.push_back({i, (2500 + 100 * i) * Matrix6::Identity(), 40 * Matrix6::Identity()});
  forces.push_back(std::make_unique<RestoringKind>("mooring", bodies, springs));
  forces.push_back(std::make_unique<AxialConnectorKind>(connectors));
  return Model(bodies, {}, std::move(forces), joints);
}

std::vector<PotentialGroup> each_by_itself(const std::vector<double>& headings) {
  std::vector<PotentialGroup> out;
  for (int i = 0; i < 12; ++i) {
    out.push_back(group(from_sides(coefficients({10.0 * i}), headings), {10.0 * i}));
    out.back().bodies = {i};
  }
  return out;
}

// [Z Gᵀ; G 0] as a dense matrix by Eigen's full pivoting: slow and plain. Held modes are unit rows.
Eigen::VectorXcd plain_solution(const frequency::SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                double omega, double heading) {
  const Eigen::MatrixXd& G = about.linear.constraints;
  const Eigen::Index n = about.model.modes(), m = G.rows();
  Eigen::MatrixXcd whole = Eigen::MatrixXcd::Zero(n + m, n + m);
  whole.topLeftCorner(n, n) = frequency::impedance(about, groups, omega);
  whole.topRightCorner(n, m) = G.transpose().cast<std::complex<double>>();
  whole.bottomLeftCorner(m, n) = G.cast<std::complex<double>>();
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(n + m);
  right.head(n) = frequency::excitation(about, groups, omega, heading);
  for (int mode = 0; mode < n; ++mode)
    if (!about.model.is_free(mode)) {
      whole.row(mode).setZero();
      whole.col(mode).setZero();
      whole(mode, mode) = 1;
      right[mode] = 0;
    }
  return whole.fullPivLu().solve(right);
}

class RaoOfARow : public testing::TestWithParam<bool> {};

// The condition number of the equations is some 1e4, and multipliers are a thousand times as large as motions.
TEST_P(RaoOfARow, BySparseFactorsIsThatOfTheWholeMatrix) {
  const Model model = row_of_bodies(GetParam());
  const frequency::SmallMotions about(model);
  const auto groups = each_by_itself({0, 1});
  const std::vector<double> omega{0.5, 1.3, 1.77, 3.0}, headings{0.8, 0.1};
  const auto found = frequency::response_amplitudes(about, groups, omega, headings, {});
  EXPECT_TRUE(found.sparse);
  for (std::size_t h = 0; h < headings.size(); ++h)
    for (std::size_t w = 0; w < omega.size(); ++w) {
      const Eigen::VectorXcd plain = plain_solution(about, groups, omega[w], headings[h]);
      const auto column = static_cast<Eigen::Index>(w);
      EXPECT_LT((found.xi[h].col(column) - plain.head(model.modes())).norm(), 1e-11 * plain.head(model.modes()).norm());
      const Eigen::VectorXcd lambda = plain.tail(plain.size() - model.modes());
      EXPECT_LE((found.lambda[h].col(column) - lambda).norm(), 1e-11 * lambda.norm());
    }
}

// The same bodies in one group, whose blocks between bodies are zero, are solved by dense factors.
TEST_P(RaoOfARow, IsTheSameByDenseFactors) {
  const Model model = row_of_bodies(GetParam());
  std::vector<double> places;
  for (int i = 0; i < 12; ++i) places.push_back(10.0 * i);
  const std::vector<double> omega{0.5, 1.3, 3.0}, headings{0.8, 0.1};
  const std::vector<PotentialGroup> together{group(from_sides(coefficients(places), {0, 1}), places)};
  const auto dense = frequency::response_amplitudes(model, together, omega, headings, {});
  EXPECT_FALSE(dense.sparse);
  frequency::SmallMotions about(model);
  for (std::size_t w = 0; w < omega.size(); ++w) {
    const Eigen::VectorXcd plain = plain_solution(about, together, omega[w], headings[0]);
    const auto column = static_cast<Eigen::Index>(w);
    EXPECT_LT((dense.xi[0].col(column) - plain.head(model.modes())).norm(), 1e-11 * plain.head(model.modes()).norm());
    const Eigen::VectorXcd lambda = plain.tail(plain.size() - model.modes());
    EXPECT_LE((dense.lambda[0].col(column) - lambda).norm(), 1e-11 * lambda.norm());
  }
}

TEST_P(RaoOfARow, HasTheSameBitsWithAnyNumberOfThreads) {
  const Model model = row_of_bodies(GetParam());
  const auto groups = each_by_itself({0, 1});
  std::vector<double> omega;
  for (int i = 0; i < 23; ++i) omega.push_back(0.3 + 0.15 * i);
  const auto one = frequency::response_amplitudes(model, groups, omega, {0.8, 0.1}, {});
  for (const int threads : {2, 5}) {
    const auto several = frequency::response_amplitudes(model, groups, omega, {0.8, 0.1}, {.threads = threads});
    EXPECT_EQ(one.xi, several.xi) << threads;
    EXPECT_EQ(one.lambda, several.lambda) << threads;
  }
}
INSTANTIATE_TEST_SUITE_P(WithAndWithoutHinges, RaoOfARow, testing::Bool());

TEST(Rao, NamesTheMotionThatNothingHoldsWhereWavesBecomeSlow) {
  for (const int count : {1, 12}) {
    std::vector<RigidBody> bodies;
    for (int i = 0; i < count; ++i) bodies.push_back(body(fmt::format("b{}", i + 1), 10 * i));
    std::vector<Restoring> springs;
    for (int i = 0; i < count; ++i) {
      Matrix6 K = 2500 * Matrix6::Identity();
      if (i == count - 1) K(1, 1) = 0;
      springs.push_back({i, K, Matrix6::Zero()});
    }
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(std::make_unique<RestoringKind>("mooring", bodies, springs));
    const Model model(bodies, {}, std::move(forces));
    EXPECT_THAT(
        [&] {
          frequency::response_amplitudes(model, {}, {1.0, 1e-8}, 0);
        },
        testing::ThrowsMessage<hydro::NumericsError>(
            testing::HasSubstr(fmt::format("1e-08 rad/s: the equations of motion are singular there; nothing "
                                           "holds b{}.sway",
                                           count))));
  }
}

TEST(Rao, NamesTheRangeOfTheDataWhenAskedOutside) {
  const std::vector<RigidBody> bodies{body("a", 0)};
  EXPECT_THAT(
      [&] { frequency::response_amplitudes(sprung(bodies, 2500, 40), {group(coefficients({0}), {0})}, {5.0}, 0); },
      testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("given from 0.1 to 4 rad/s")));
}

TEST(Rao, SaysWhenAnUndampedResonanceIsHit) {
  const std::vector<RigidBody> bodies{body("a", 0)};
  const Model model = sprung(bodies, 1000, 0);
  auto g = group(coefficients({0}), {0});
  g.radiation = false;
  for (const double omega : {1.0, 1 + 1e-13})  // rounding leaves no digit of K - omega² M at either
    EXPECT_THAT([&] { frequency::response_amplitudes(model, {g}, {omega}, 0); },
                testing::ThrowsMessage<hydro::NumericsError>(testing::AllOf(
                    testing::HasSubstr("at 1 rad/s"), testing::HasSubstr("resonates, and nothing damps"))));
  EXPECT_NO_THROW(frequency::response_amplitudes(model, {g}, {1 + 1e-6}, 0));
}

// One cell after the other is the reference: rows of every kind, of two bodies, a multiplier and a wave.
TEST(SignalAmplitudes, AreThoseOfOneCellAfterTheOtherToTheBit) {
  const std::vector<double> omega{0.7, 1.3, 2.2}, headings{0.0, 0.4};
  frequency::Amplitudes found;
  const hydro::RandomStream random(1, 0);
  std::uint64_t drawn = 0;
  for (auto* part : {&found.xi, &found.lambda})
    for (std::size_t h = 0; h < headings.size(); ++h) {
      Eigen::MatrixXcd& one = part->emplace_back(part == &found.xi ? 12 : 2, 3);
      for (auto& value : one.reshaped()) {
        value = {random.normal(drawn), random.normal(drawn + 1)};
        drawn += 2;
      }
    }
  Variation moves{.parts = {{.body = 0}, {.body = 1}}}, all = moves;
  moves.parts[1].by_motion << 0, 0, 1, 0, -3.7, 0;
  all.parts[0].by_motion << 1, 0, 0, 0, 2.5, 0;
  all.parts[0].by_velocity << 0, 0.3, 0, 0, 0, 0;
  all.parts[1].by_acceleration << 0, 0, 7, 0, 0, 1;
  all.by_multiplier = {{1, 0.6}};
  all.by_wave = [](double w, double beta) { return std::polar(1.0, -w * w * std::cos(beta)); };
  const frequency::SignalAmplitudes amplitudes(found, omega, headings);
  for (const Variation& variation : {moves, all}) {
    const std::vector<std::complex<double>> at_once = amplitudes.of(variation);
    ASSERT_EQ(at_once.size(), omega.size() * headings.size());
    for (std::size_t h = 0; h < headings.size(); ++h)
      for (std::size_t w = 0; w < omega.size(); ++w) {
        const auto column = static_cast<Eigen::Index>(w);
        EXPECT_EQ(at_once[h * omega.size() + w],
                  amplitude(variation, found.xi[h].col(column), found.lambda[h].col(column), omega[w], headings[h]));
      }
  }
}

// (D142): the column of Z⁻¹ inside the data; K⁻¹ at rest; below the data A constant, or straight to A(0), and B
// straight to none.
TEST(AnswersToLoads, AreColumnsOfTheInverseFromZeroFrequencyOn) {
  const double stiffness = 5000, damper = 70, lowest = 0.1;
  const std::vector<RigidBody> bodies{body("a", 0)};
  const Model model = sprung(bodies, stiffness, damper);
  for (const bool with_limit : {false, true}) {
    Coefficients c = coefficients({0});
    if (with_limit) c.A_zero = 900 * Eigen::MatrixXd::Identity(6, 6);
    const double A = c.A.front()(0, 0), B = c.B.front()(0, 0);
    const std::vector<PotentialGroup> groups{{{0}, {c, {Eigen::Vector3d::Zero()}}, true, true}};
    const std::vector<double> omega{0, 0.04, 0.8};
    const auto found = frequency::answers_to_loads(model, groups, omega, {0, 2});
    const auto plain = [&](double w, double added, double damping) {
      return 1.0 / std::complex<double>(stiffness - w * w * (1000 + added), w * (damping + damper));
    };
    const double added = with_limit ? 900 + 0.04 / lowest * (A - 900) : A;
    for (const Eigen::Index mode : {0, 2}) {
      const Eigen::MatrixXcd& xi = found.xi[mode == 0 ? 0 : 1];
      EXPECT_LT(std::abs(xi(mode, 0) - 1 / stiffness), 1e-15);  // rounding of 2e-4
      EXPECT_LT(std::abs(xi(mode, 1) - plain(0.04, added, 0.04 / lowest * B)), 1e-15);
      EXPECT_LT(std::abs(xi(mode, 2) - frequency::impedance(model, groups, 0.8).inverse()(mode, mode)), 1e-15);
    }
  }
}

}  // namespace
}  // namespace rao_test
