#include "dynamics/frequency/rao.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/restoring.hpp"
#include "hydro/base/error.hpp"
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
  const auto together = frequency::response_amplitudes(model, groups, omega, asked);
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
        frequency::response_amplitudes(sprung(bodies, 1000, 0), {g}, {1.0}, std::vector<double>{0, 1});
      },
      testing::ThrowsMessage<hydro::NumericsError>(testing::HasSubstr("at 1 rad/s")));
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
  EXPECT_THAT([&] { frequency::response_amplitudes(model, {g}, {1.0}, 0); },
              testing::ThrowsMessage<hydro::NumericsError>(testing::HasSubstr("at 1 rad/s")));
}

}  // namespace
}  // namespace rao_test
