// Laws that hold for every layout: energy, Haskind, reciprocity, passivity, and that nothing depends on where the axes
// are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

#include "hydro/potential/doctor/check.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/waves/dispersion.hpp"
#include "layouts.hpp"

namespace hydro::cylinders::laws_test {
namespace {

const std::vector<double> omega{0.5, 1.4, 2.6};
const std::vector<double> heading{-0.4, 0.9};

std::vector<CylinderBody> moved(std::vector<CylinderBody> bodies, double angle, const Eigen::Vector2d& shift) {
  const Eigen::Rotation2Dd turn(angle);
  const auto place = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d xy = turn * p.head<2>() + shift;
    return Eigen::Vector3d(xy.x(), xy.y(), p.z());
  };
  for (CylinderBody& body : bodies) {
    body.reference_point = place(body.reference_point);
    if (body.centre_of_gravity) body.centre_of_gravity = place(*body.centre_of_gravity);
    for (Cylinder& c : body.cylinders) c.centre = turn * c.centre + shift;
  }
  return bodies;
}

Eigen::MatrixXd turned_modes(int bodies, double angle) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(6 * bodies, 6 * bodies);
  for (int i = 0; i < 2 * bodies; ++i)
    R.block<3, 3>(3 * i, 3 * i) = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return R;
}

// For one cylinder the relations hold by the form of the equations, whatever is truncated: only rounding is left. In an
// array the compression of what passes between cylinders spoils them, within the tolerance.
TEST(CylinderLaws, OneCylinderKeepsEnergyHaskindAndReciprocityToEightDigits) {
  for (const double radius : {0.3, 1.0, 6.0}) {
    const auto check = solve({single(radius, 1.7)}, tank(), omega, heading, {.threads = 1}).check;
    EXPECT_LT(check.energy, 1e-8) << radius;
    EXPECT_LT(check.haskind, 1e-8) << radius;
    EXPECT_LT(check.reciprocity, 1e-8) << radius;
  }
}

TEST(CylinderLaws, AnArrayKeepsThemToEightDigitsWhenAskedForThem) {
  const std::vector<CylinderBody> wide{single(1, 2), single(0.7, 1.2, 5, 2)};
  const auto check = solve(wide, tank(5), omega, heading, {.tolerance = 1e-8, .threads = 1}).check;
  EXPECT_LT(check.energy, 1e-8);
  EXPECT_LT(check.haskind, 1e-8);
  EXPECT_LT(check.reciprocity, 1e-8);
  EXPECT_LT(check.doubling, 1e-7);
}

TEST(CylinderLaws, DampingIsPassiveAndAddedMassAtInfinityPositive) {
  const auto c = solve(uneven(), tank(8), omega, heading, {.tolerance = 1e-4, .threads = 1}).coefficients;
  for (const auto& B : c.B) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((B + B.transpose()) / 2);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-4 * B.diagonal().maxCoeff());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((*c.A_inf + c.A_inf->transpose()) / 2);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-4 * c.A_inf->diagonal().maxCoeff());
  for (const auto& finding : potential::check(c))
    EXPECT_NE(finding.severity, potential::Severity::error) << finding.message;
}

TEST(CylinderLaws, ALayoutTranslatedAndTurnedGivesTheSameMatricesTranslatedAndTurned) {
  const double angle = 0.7;
  const Eigen::Vector2d shift(3, -5);
  const Options options{.tolerance = 1e-5, .threads = 1, .doubled_frequencies = 0};
  const auto here = solve(uneven(), tank(8), {1.4}, {0.2}, options).coefficients;
  const auto there = solve(moved(uneven(), angle, shift), tank(8), {1.4}, {0.2 + angle}, options).coefficients;
  const Eigen::MatrixXd R = turned_modes(2, angle);
  const double k = waves::wavenumber(1.4, tank(8));
  const std::complex<double> phase =
      std::polar(1.0, -k * shift.dot(Eigen::Vector2d(std::cos(0.2 + angle), std::sin(0.2 + angle))));
  EXPECT_LT((R * here.A[0] * R.transpose() - there.A[0]).cwiseAbs().maxCoeff(), 1e-5 * here.A[0].maxCoeff());
  EXPECT_LT((R * here.B[0] * R.transpose() - there.B[0]).cwiseAbs().maxCoeff(), 1e-5 * here.A[0].maxCoeff());
  EXPECT_LT((R * here.X[0] * phase - there.X[0]).cwiseAbs().maxCoeff(), 1e-5 * here.X[0].cwiseAbs().maxCoeff());
  EXPECT_LT((R * *here.C * R.transpose() - *there.C).cwiseAbs().maxCoeff(), 1e-9 * here.C->maxCoeff());
}

// (P4): a body about another point, by the operations of coefficients and by solving anew.
TEST(CylinderLaws, AnotherReferencePointGivesWhatTheOperationGives) {
  const Options options{.tolerance = 1e-4, .threads = 1, .doubled_frequencies = 0};
  auto bodies = uneven();
  const auto here = solve(bodies, tank(8), {1.4}, {0.2}, options).coefficients;
  std::vector<Eigen::Vector3d> from, to;
  for (CylinderBody& b : bodies) {
    from.push_back(b.reference_point);
    b.reference_point += Eigen::Vector3d(0.3, -1.1, 0.6);
    to.push_back(b.reference_point);
  }
  const auto there = solve(bodies, tank(8), {1.4}, {0.2}, options).coefficients;
  const auto translated = potential::about(here, from, to);
  EXPECT_LT((translated.A[0] - there.A[0]).cwiseAbs().maxCoeff(), 1e-10 * there.A[0].maxCoeff());
  EXPECT_LT((translated.X[0] - there.X[0]).cwiseAbs().maxCoeff(), 1e-10 * there.X[0].cwiseAbs().maxCoeff());
  EXPECT_LT((*translated.C - *there.C).cwiseAbs().maxCoeff(), 1e-10 * there.C->maxCoeff());
}

// One rigid body of all cylinders is the sum over separate bodies that move together.
TEST(CylinderLaws, ARigidBodyIsTheSumOfItsParts) {
  const Options options{.tolerance = 1e-4, .threads = 1, .doubled_frequencies = 0};
  std::vector<CylinderBody> apart;
  const CylinderBody whole = pontoon(0);
  for (const Cylinder& c : whole.cylinders) apart.push_back({"part", {c.centre.x(), c.centre.y(), 0}, {}, {c}});
  const auto one = solve({whole}, tank(), {2.0}, {0.5}, options).coefficients;
  const auto four = solve(apart, tank(), {2.0}, {0.5}, options).coefficients;
  Eigen::MatrixXd T(24, 6);
  for (Eigen::Index i = 0; i < 4; ++i)
    T.middleRows(6 * i, 6) = potential::rigid_shift(apart[static_cast<std::size_t>(i)].reference_point);
  EXPECT_LT((T.transpose() * four.A[0] * T - one.A[0]).cwiseAbs().maxCoeff(), 1e-10 * one.A[0].maxCoeff());
  EXPECT_LT((T.transpose() * four.X[0] - one.X[0]).cwiseAbs().maxCoeff(), 1e-10 * one.X[0].cwiseAbs().maxCoeff());
}

TEST(CylinderLaws, TheNumberOfThreadsChangesNoBit) {
  const auto one = solve(uneven(), tank(8), omega, heading, {.tolerance = 1e-3, .threads = 1}).coefficients;
  int calls = 0;
  const auto three = solve(uneven(), tank(8), omega, heading,
                           {.tolerance = 1e-3, .threads = 3, .progress = [&](int, int) { ++calls; }})
                         .coefficients;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    EXPECT_EQ(one.A[i], three.A[i]);
    EXPECT_EQ(one.B[i], three.B[i]);
  }
  EXPECT_EQ(one.X[1], three.X[1]);
  EXPECT_EQ(calls, 3 + 3 + 1);  // frequencies, those doubled, the limit
}

// A column of water lifted by dz weighs ρgS dz; a small heel of the module moves its cylinders by x dθ.
TEST(CylinderLaws, RestoringIsThatOfTheWaterplaneAndTheCentres) {
  const Eigen::Matrix<double, 6, 6> C = restoring(pontoon(0), tank());
  const double S = 4 * std::numbers::pi * 0.64, V = S * 1.13;
  EXPECT_NEAR(C(2, 2), 9810 * S, 1e-9 * C(2, 2));
  const double second_moment = S * (5.2 * 5.2 + 0.64 / 4);
  EXPECT_NEAR(C(3, 3), 9810 * (second_moment + V * (-0.565 - 1.31)), 1e-9 * C(3, 3));
  EXPECT_NEAR(C(4, 4), C(3, 3), 1e-9 * C(3, 3));
  EXPECT_NEAR(displacement(pontoon(0), tank().depth).volume, V, 1e-12 * V);
}

// Of two pontoons waves resonate between the eight cylinders; what is not solved is held against what is.
TEST(CylinderLaws, AtChosenFrequenciesMeetTheToleranceBetweenThem) {
  const std::vector<CylinderBody> bodies{pontoon(-6.5), pontoon(6.5)};
  const std::vector<double> first{0.3, 1.0, 1.8, 2.5, 3.2}, towards{0, 0.6};
  const Options options{.tolerance = 1e-4, .frequency_tolerance = 1e-2, .threads = 1, .doubled_frequencies = 1};
  const Solution chosen = solve(bodies, tank(), first, towards, options);
  const potential::Coefficients& table = chosen.coefficients;
  EXPECT_LE(chosen.check.unseen, 1e-2);
  EXPECT_LE(chosen.check.solved_omega.size(), 60u);  // cubics between even ones need 200
  EXPECT_GT(table.omega.size(), chosen.check.solved_omega.size());
  EXPECT_THAT(table.notes, testing::Contains(testing::HasSubstr("solved at")));
  std::vector<double> unseen;
  for (double at = 0.31; at < 3.2; at += 0.0717) unseen.push_back(at);
  const auto truth =
      solve(bodies, tank(), unseen, towards, {.tolerance = 1e-4, .threads = 1, .doubled_frequencies = 0}).coefficients;
  const potential::FrequencyTable read(table, {bodies[0].reference_point, bodies[1].reference_point});
  Eigen::VectorXd B = Eigen::VectorXd::Zero(12), X = B;
  for (std::size_t w = 0; w < table.omega.size(); ++w) {
    B = B.cwiseMax(table.B[w].diagonal());
    for (const auto& of_heading : table.X) X = X.cwiseMax(of_heading.col(static_cast<Eigen::Index>(w)).cwiseAbs());
  }
  for (std::size_t w = 0; w < unseen.size(); ++w) {
    const Eigen::MatrixXd dB = read.damping(unseen[w]) - truth.B[w],
                          dA = unseen[w] * (read.added_mass(unseen[w]) - truth.A[w]);
    for (Eigen::Index i = 0; i < 12; ++i) {
      for (Eigen::Index j = 0; j < 12; ++j)
        EXPECT_LE(std::hypot(dB(i, j), dA(i, j)), 1e-2 * std::sqrt(B[i] * B[j])) << unseen[w];
      for (std::size_t h = 0; h < towards.size(); ++h)
        EXPECT_LE(std::abs(read.excitation(unseen[w], towards[h])[i] - truth.X[h](i, static_cast<Eigen::Index>(w))),
                  1e-2 * std::max(X[i], 0.01 * X.maxCoeff()))
            << unseen[w];
    }
  }
  for (const auto& finding : potential::check(table))
    EXPECT_NE(finding.severity, potential::Severity::error) << finding.message;
}

}  // namespace
}  // namespace hydro::cylinders::laws_test
