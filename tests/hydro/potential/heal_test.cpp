// Healing changes as little as it can, and what it promises then holds.
#include "hydro/potential/doctor/heal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "example.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/doctor/check.hpp"
#include "hydro/radiation/kernel.hpp"
#include "smooth_body.hpp"
#include "support/reference_data.hpp"

namespace heal_test {
namespace {

using froude_test::example;
using hydro::potential::Coefficients;
using hydro::potential::heal;
using hydro::potential::Healed;
using hydro::potential::HealOptions;
using hydro::potential::Severity;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr HealOptions none{.symmetry = false, .spikes = false, .tail = false, .passivity = false};

HealOptions only(bool HealOptions::*step) {
  HealOptions options = none;
  options.*step = true;
  return options;
}

Severity gravest(const Coefficients& c, const std::string& name) {
  Severity worst = Severity::note;
  for (const auto& f : hydro::potential::check(c))
    if (f.check == name) worst = std::max(worst, f.severity);
  return worst;
}

double smallest_eigenvalue(const Eigen::MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((M + M.transpose()) / 2).eigenvalues()(0);
}

TEST(Heal, DoesNothingIfNothingIsAsked) {
  const Coefficients c = example("box2.nc");
  const Healed healed = heal(c, none);
  EXPECT_TRUE(healed.steps.empty());
  EXPECT_EQ(healed.coefficients.A, c.A);
  EXPECT_EQ(healed.coefficients.B, c.B);
  EXPECT_EQ(healed.coefficients.notes, c.notes);
}

TEST(Heal, TakesTheMeanWithTheTranspose) {
  Coefficients c = example("box2.nc");
  c.A[4](0, 4) += 7;
  const Healed healed = heal(c, only(&HealOptions::symmetry));
  for (const auto* list : {&healed.coefficients.A, &healed.coefficients.B})
    for (const auto& m : *list) EXPECT_EQ(m, Eigen::MatrixXd(m.transpose()));
  EXPECT_EQ(healed.coefficients.A[4](0, 4), (c.A[4](0, 4) + c.A[4](4, 0)) / 2);
  ASSERT_EQ(healed.steps.size(), 1u);
  EXPECT_GT(healed.steps[0].largest_change, 0);
  EXPECT_THAT(healed.coefficients.notes.back(), HasSubstr("healed, symmetry"));
}

TEST(Heal, FindsASpikeAndPutsItBetweenItsNeighbours) {
  const Coefficients good = example("hemisphere_r5.nc");
  Coefficients c = good;
  c.A[26](2, 2) *= 1.3;
  c.B[26](2, 2) *= 1.3;
  ASSERT_EQ(gravest(c, "spikes"), Severity::warning);
  const Healed healed = heal(c, only(&HealOptions::spikes));
  EXPECT_EQ(gravest(healed.coefficients, "spikes"), Severity::note);
  // The cubic through four neighbours 0.1 rad/s apart misses these smooth curves by less than 1 %; the spike was 30 %.
  EXPECT_NEAR(healed.coefficients.B[26](2, 2), good.B[26](2, 2), 0.01 * good.B[26](2, 2));
  EXPECT_NEAR(healed.coefficients.A[26](2, 2), good.A[26](2, 2), 0.01 * good.A[26](2, 2));
  for (const std::size_t k : {24u, 25u, 27u, 28u}) EXPECT_EQ(healed.coefficients.A[k], good.A[k]) << k;
  EXPECT_EQ(healed.coefficients.X[0], good.X[0]);
}

/// A pole of the same motion of both bodies, as water in a gap makes it: iωA + B = r/(i(ω − ω₀) + γ).
Coefficients with_gap_resonance(Coefficients c, double omega0, double gamma) {
  const double height = 3 * c.B[20](2, 2);
  for (std::size_t k = 0; k < c.omega.size(); ++k) {
    const double d = c.omega[k] - omega0, lorentz = gamma / (d * d + gamma * gamma);
    for (const Eigen::Index i : {2, 8})
      for (const Eigen::Index j : {2, 8}) {
        c.B[k](i, j) += height * gamma * lorentz;
        c.A[k](i, j) -= height * d * lorentz / c.omega[k];
      }
  }
  return c;
}

TEST(Heal, LeavesAResonanceOfTheWaterBetweenBodies) {
  const Coefficients c = with_gap_resonance(example("box2.nc"), 3.02, 0.04);
  EXPECT_EQ(gravest(c, "spikes"), Severity::note);
  bool named = false;
  for (const auto& f : hydro::potential::check(c))
    named = named || (f.check == "spikes" && f.message.find("a resonance of the water") != std::string::npos);
  EXPECT_TRUE(named);
  EXPECT_EQ(heal(c, only(&HealOptions::spikes)).coefficients.B, c.B);
}

TEST(Heal, MakesDampingPassiveByTheSmallestChange) {
  Coefficients c = example("box2.nc");
  c.B[10](0, 2) = c.B[10](2, 0) = 2 * std::sqrt(c.B[10](0, 0) * c.B[10](2, 2));
  ASSERT_LT(smallest_eigenvalue(c.B[10]), 0);
  const Healed healed = heal(c, {.symmetry = true, .spikes = false, .tail = false, .passivity = true});
  for (const auto& B : healed.coefficients.B)
    EXPECT_GT(smallest_eigenvalue(B), -1e-9 * B.cwiseAbs().maxCoeff());  // round-off of scaling back
  // … and no more positive than it must be: the nearest passive matrix to one that is not stands on the border.
  EXPECT_LT(smallest_eigenvalue(healed.coefficients.B[10]), 1e-9 * healed.coefficients.B[10].cwiseAbs().maxCoeff());
  // The pair's negative eigenvalue is λ = −1 of its own size: nothing has to change by more than half of it twice.
  EXPECT_LE(healed.steps[1].largest_change, 1);
  EXPECT_EQ(gravest(healed.coefficients, "passivity of B"), Severity::note);
}

TEST(Heal, LeavesAPassiveMatrixAlone) {
  auto c = froude_test::SmoothBody{}.coefficients({}, {0.5, 1.0, 2.0}, {});
  for (auto& B : c.B) B = Eigen::MatrixXd::Identity(6, 6) + 0.1 * Eigen::MatrixXd::Ones(6, 6);
  EXPECT_EQ(heal(c, only(&HealOptions::passivity)).coefficients.B, c.B);
}

/// The hemisphere's table, cut at the frequency where three quarters of it are left, and told again.
TEST(Heal, TellsTheTailThatWasCut) {
  const Coefficients whole = example("hemisphere_r5.nc");
  Coefficients c = whole;
  const std::size_t kept = 20;
  c.omega.resize(kept);
  c.A.resize(kept);
  c.B.resize(kept);
  for (auto& X : c.X) X = Eigen::MatrixXcd(X.leftCols(static_cast<Eigen::Index>(kept)));
  const Healed healed = heal(c, only(&HealOptions::tail));
  ASSERT_GT(healed.coefficients.omega.size(), whole.omega.size());
  double error = 0, error_of_A = 0, largest = 0;
  for (std::size_t k = 0; k < whole.omega.size(); ++k) {
    largest = std::max(largest, whole.B[k](2, 2));
    if (k < kept) continue;
    const auto at =
        std::lower_bound(healed.coefficients.omega.begin(), healed.coefficients.omega.end(), whole.omega[k]) -
        healed.coefficients.omega.begin();
    error = std::max(error, std::abs(healed.coefficients.B[static_cast<std::size_t>(at)](2, 2) - whole.B[k](2, 2)));
    error_of_A =
        std::max(error_of_A, std::abs(healed.coefficients.A[static_cast<std::size_t>(at)](2, 2) - whole.A[k](2, 2)));
  }
  // Seven corners, of which two lie in what is compared: a tenth of the largest damping, where cutting loses a third.
  EXPECT_LT(error, 0.1 * largest);
  EXPECT_LT(error_of_A, 0.05 * whole.A[0](2, 2));  // A varies by 0.4 of this
  // A goes on where it was, in surge too, whose damping is cut near its peak.
  for (const Eigen::Index i : {0, 2})
    EXPECT_NEAR(healed.coefficients.A[kept](i, i), whole.A[kept](i, i), 0.02 * whole.A[0](i, i)) << "mode " << i;
  EXPECT_EQ(healed.coefficients.X[0].leftCols(static_cast<Eigen::Index>(kept)), c.X[0]);
  EXPECT_EQ(*healed.coefficients.A_inf, *c.A_inf);
  EXPECT_EQ(gravest(healed.coefficients, "high-frequency tail"), Severity::note);
}

/// The columns of the pontoon resonate where its table ends, and A from B alone would jump there by a seventh.
TEST(Heal, JoinsTheTailToTheLastValue) {
  const Coefficients c = example("pontoon1.nc");
  const Healed healed = heal(c, only(&HealOptions::tail));
  const double last = c.A.back()(0, 0), next = healed.coefficients.A[c.omega.size()](0, 0);
  EXPECT_NEAR(next, last, 0.05 * c.A.front()(0, 0));
}

// What the table tells of the memory ends at π over its widest gap: healing must not widen one.
TEST(Heal, LeavesTheMemoryAsLongAsItWas) {
  using hydro::radiation::RetardationKernel;
  for (const char* name : {"pontoon1.nc", "hemisphere_r5.nc", "box2.nc"}) {
    const Coefficients c = example(name), healed = heal(c, only(&HealOptions::tail)).coefficients;
    ASSERT_GT(healed.omega.size(), c.omega.size()) << name;
    // The added frequencies share the way to their end evenly, which rounds their distance by one part in their number.
    const double rounding = 1 - 1.0 / static_cast<double>(c.omega.size());
    EXPECT_GE(RetardationKernel::longest_time({healed.omega, healed.B}),
              rounding * RetardationKernel::longest_time({c.omega, c.B}))
        << name;
  }
}

TEST(Heal, AddsTheLimitThatIsAbsent) {
  Coefficients c = example("hemisphere_r5.nc");
  const Eigen::MatrixXd limit = *c.A_inf;
  c.A_inf.reset();
  const Healed healed = heal(c, only(&HealOptions::tail));
  EXPECT_NEAR((*healed.coefficients.A_inf)(2, 2), limit(2, 2), 0.01 * limit(2, 2));  // R11 finds 0.1 % here
  EXPECT_THAT(healed.steps[0].what, HasSubstr("A(∞) is added"));
}

TEST(Heal, KeepsSoundDataSound) {
  const auto expect_sound = [](const Healed& healed, const char* name) {
    for (const auto& f : hydro::potential::check(healed.coefficients))
      EXPECT_EQ(f.severity, Severity::note) << name << ": " << f.check << ": " << f.message;
    // What these converged meshes leave is at most 0.02 (usual_asymmetry); healing has no reason to change more.
    for (const auto& step : healed.steps) EXPECT_LE(step.largest_change, 0.02) << name << ": " << step.name;
  };
  expect_sound(heal(example("hemisphere_r5.nc")), "hemisphere_r5.nc");
  // The columns of the pontoon resonate at the very end of its table, where a tail of straight pieces is rough.
  for (const char* name : {"pontoon1.nc", "box2.nc"})
    expect_sound(heal(example(name), {.symmetry = true, .spikes = true, .tail = false, .passivity = true}), name);
}

TEST(Heal, RefusesATailOfAShortTable) {
  const auto c = froude_test::SmoothBody{}.coefficients({}, {0.5, 1.0, 2.0}, {});
  EXPECT_THAT([&] { heal(c); },
              ThrowsMessage<hydro::InputError>(HasSubstr("ten frequencies or more, and there are 3")));
}

TEST(Heal, CuresTheIrregularFrequenciesOfAPublishedFile) {
  FROUDE_REQUIRE_DATA(folder, "iea_sphere/nemoh_v2");
  const Coefficients c = hydro::potential::read(folder);
  EXPECT_EQ(gravest(c, "spikes"), Severity::warning);
  const Healed healed = heal(c);
  for (const char* name : {"spikes", "symmetry of B", "sign of B", "passivity of B"})
    EXPECT_EQ(gravest(healed.coefficients, name), Severity::note) << name;
}

}  // namespace
}  // namespace heal_test
