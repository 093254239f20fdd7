// Hard data for the memory of radiated waves: whatever the table, energy taken out is never negative beyond the bound
// that the method reports.
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/radiation/choice.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "support/random_passive.hpp"
#include "support/two_pole_body.hpp"

namespace radiation_test {
namespace {

using namespace hydro::radiation;
using support::RadiationData;

constexpr double h = 0.1;

double largest_damping(const RadiationData& d) {
  double largest = 0;
  for (const auto& B : d.damping.B) largest = std::max(largest, B.diagonal().maxCoeff());
  return largest;
}

/// Least of the energy taken out so far, over ∫ v·v dt times the largest damping, for random motions of many kinds.
double least_energy(const MemoryMethod& method, const RadiationData& data, int steps, std::uint64_t seeds) {
  const double size = largest_damping(data);
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const hydro::RandomStream random(seed, 21);
    const double omega = 0.2 + 4 * random.uniform(0), noise = seed % 2 == 0 ? 0 : 0.5;
    const auto state = method.start(Eigen::VectorXd::Zero(method.modes()));
    double energy = 0, motion = 0;
    std::uint64_t next = 100;
    for (int i = 1; i < steps; ++i) {
      Eigen::VectorXd v(method.modes());
      for (Eigen::Index m = 0; m < v.size(); ++m)
        v[m] = std::sin(omega * h * i + 1.7 * static_cast<double>(m) * static_cast<double>(seed)) +
               noise * random.normal(next++);
      energy += h * v.dot(state->history_force(1) + method.instantaneous(1) * v);
      motion += h * v.squaredNorm() * size;
      if (i > 50) least = std::min(least, energy / motion);
      state->accept(v);
    }
  }
  return least;
}

void expect_harmless(const RadiationData& data, const char* what, std::optional<double> length = {}) {
  for (const Method method : {Method::direct, Method::partitioned, Method::poles}) {
    MemoryDemand demand{.step = h, .tolerance = 1e-2, .length = {}, .method = method};
    if (method != Method::poles) demand.length = length;
    const auto chosen = choose(data.damping, data.A, data.A_inf, demand);
    const double least = least_energy(*chosen.memory, data, 600, 6);
    if (method == Method::poles) {
      EXPECT_TRUE(chosen.fit->passive) << what;
      EXPECT_GE(least, 0) << what << ": a passive fit";
    } else {
      // Negative damping in the data and a memory cut short may each give what they are reported to be.
      EXPECT_GE(least, -(chosen.truncation + chosen.negative_share + 1e-3)) << what << ": " << name_of(method);
    }
  }
}

RadiationData two_pole(double last, int count) {
  return support::data_of(support::TwoPoleBody{.decay = 0.3, .frequency = 1.1}.model(), last, count);
}

TEST(RadiationStability, SurvivesNoisyAndSlightlyNegativeDamping) {
  auto data = two_pole(6, 60);
  const hydro::RandomStream random(1, 1);
  const double size = largest_damping(data);
  for (std::size_t i = 0; i < data.damping.B.size(); ++i)
    data.damping.B[i](0, 0) += size * (0.01 * random.normal(i) - 0.01);
  expect_harmless(data, "noisy");
}

TEST(RadiationStability, SurvivesATableCutAtOneAndAHalfRadiansASecond) {
  expect_harmless(two_pole(1.5, 30), "cut at 1.5 rad/s");
}

TEST(RadiationStability, SurvivesAKernelCutAtFiveSeconds) { expect_harmless(two_pole(8, 160), "cut at 5 s", 5.0); }

// Water in a narrow gap: a spike a tenth of the spacing wide, ten times the damping around it.
TEST(RadiationStability, SurvivesAGapResonance) {
  auto model = support::TwoPoleBody{.decay = 0.3, .frequency = 1.1}.model();
  model.poles.push_back({0.01, 2.03});
  model.C.push_back(0.3 * Eigen::MatrixXd::Ones(1, 1));
  model.S.push_back(-0.01 / 2.03 * model.C.back());
  expect_harmless(support::data_of(model, 6, 60), "gap resonance");
}

TEST(RadiationStability, SurvivesAddedMassThatIsNearlySingularAtInfiniteFrequency) {
  auto data = support::data_of(support::random_passive(8, 4, 3), 6, 60);
  const Eigen::MatrixXd lost = data.A_inf - 1e-9 * data.A_inf;
  data.A_inf -= lost;
  for (auto& A : data.A) A -= lost;
  expect_harmless(data, "A(inf) nearly singular");
}

// 25 bodies in a row, heave: coupled by what is left of each other's waves at their distance.
TEST(RadiationStability, SurvivesTwentyFiveCoupledBodies) {
  const auto model = support::random_passive(2, 25, 4);
  expect_harmless(support::data_of(model, 6, 60), "25 modes");
}

// An hour of waves, 36 000 steps of 0.1 s: neither drift nor growth. (24 h: long_run_test.cpp.)
TEST(RadiationStability, NeitherDriftsNorGrowsInALongRun) {
  const auto data = two_pole(8, 160);
  const auto chosen =
      choose(data.damping, data.A, data.A_inf, {.step = h, .tolerance = 1e-3, .length = {}, .method = {}});
  const auto state = chosen.memory->start(Eigen::VectorXd::Zero(1));
  const auto load_at = [&](double v) {
    return (state->history_force(1) + chosen.memory->instantaneous(1) * Eigen::VectorXd::Constant(1, v))[0];
  };
  const double omega = 2 * std::acos(-1.0) / 8;  // 80 steps a period
  double early = 0, late = 0;
  for (int i = 1; i <= 36000; ++i) {
    const double v = std::sin(omega * h * i);
    if (i == 4000) early = load_at(v);
    if (i == 36000) late = load_at(v);
    state->accept(Eigen::VectorXd::Constant(1, v));
  }
  EXPECT_NEAR(late, early, 1e-9 * largest_damping(data));  // the same phase, 400 periods later
}

}  // namespace
}  // namespace radiation_test
