// Every way of computing the memory against the others and against the exact body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/radiation/choice.hpp"
#include "hydro/radiation/constant_memory.hpp"
#include "hydro/radiation/convolution.hpp"
#include "hydro/radiation/partitioned.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "support/random_passive.hpp"
#include "support/two_pole_body.hpp"

namespace methods_test {
namespace {

using namespace hydro::radiation;
using testing::HasSubstr;
using testing::ThrowsMessage;

const support::TwoPoleBody body{};

Eigen::VectorXd random_velocity(std::uint64_t i, int modes) {
  const hydro::RandomStream random(2, 3);
  Eigen::VectorXd v(modes);
  for (int m = 0; m < modes; ++m)
    v[m] = random.normal(static_cast<std::uint64_t>(modes) * i + static_cast<std::uint64_t>(m));
  return v;
}

/// A kernel of coupled modes with many lags.
RetardationKernel kernel(int modes, double length) {
  const auto data = support::data_of(support::random_passive(9, modes, 3), 12, 700);
  return RetardationKernel::from_damping(data.damping, {0.1, length});
}

class Partitioned : public testing::TestWithParam<double> {};

TEST_P(Partitioned, GivesTheSumsOfDirectConvolutionToRoundOff) {
  constexpr int modes = 4;
  const auto K = kernel(modes, GetParam());
  const DirectConvolution direct(K);
  const PartitionedConvolution partitioned(K, 8);
  const auto start = random_velocity(0, modes);
  const auto slow = direct.start(start), fast = partitioned.start(start);
  double size = 0;
  for (std::uint64_t i = 1; i < 700; ++i) {
    for (const double fraction : {1.0, 0.3}) {
      const Eigen::VectorXd expected = slow->history_force(fraction);
      size = std::max(size, expected.norm());
      ASSERT_LT((fast->history_force(fraction) - expected).norm(), 1e-13 * size)
          << "step " << i << ", fraction " << fraction;
    }
    slow->accept(random_velocity(i, modes));
    fast->accept(random_velocity(i, modes));
  }
}

// 3 lags fit in the head, 8 and 9 touch its edge, 64 ends a part, 500 is in the midst of one.
INSTANTIATE_TEST_SUITE_P(Lengths, Partitioned, testing::Values(0.3, 0.7, 0.8, 0.9, 6.3, 6.4, 50.0));

TEST(PartitionedConvolution, CostsLittleOnAverageAndSaysWhatItsWorstStepIs) {
  // Against n² products a lag: less than a thirtieth on average; in the worst step all parts at once.
  EXPECT_LT(PartitionedConvolution::mean_step(30, 6001), 30.0 * 30 * 6001 / 30);
  EXPECT_GT(PartitionedConvolution::worst_step(30, 6001), 30.0 * 30 * 6001);
  EXPECT_THROW(PartitionedConvolution(kernel(1, 5), 12), hydro::InputError);
}

TEST(KernelSum, RefusesAKernelThatIsNotSymmetric) {
  auto table = body.damping_table(10, 100, 2);
  for (auto& B : table.B) B(0, 1) = 0.1 * B(0, 0);
  EXPECT_THAT(
      [&] {
        DirectConvolution(RetardationKernel::from_damping(table, {0.1, 5}));
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("not symmetric in modes 0 and 1")));
}

/// ∫₀ᵗ K(t−τ) v(τ) dτ of the two-pole body for v straight between its values at steps h, by its differential equation
/// (q″ + 2a q′ + w² q = v, load q′) and a fine Runge–Kutta.
double exact_load(const std::vector<double>& v, double h, std::size_t steps, double fraction) {
  Eigen::Vector2d q(0, 0);
  constexpr int fine = 200;
  const auto run = [&](std::size_t i, double to) {
    const double dt = to * h / fine;
    for (int k = 0; k < fine; ++k) {
      const auto rate = [&](const Eigen::Vector2d& x, double t) {
        const double now = v[i] + (v[i + 1] - v[i]) * t / h;
        return Eigen::Vector2d(x[1], now - 2 * body.decay * x[1] - body.w2() * x[0]);
      };
      const double t = k * dt;
      const Eigen::Vector2d k1 = rate(q, t), k2 = rate(q + dt / 2 * k1, t + dt / 2),
                            k3 = rate(q + dt / 2 * k2, t + dt / 2), k4 = rate(q + dt * k3, t + dt);
      q += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  };
  for (std::size_t i = 0; i < steps; ++i) run(i, 1);
  if (fraction > 0) run(steps, fraction);
  return q[1];
}

// (R14): no error at all for a velocity that is straight over each step, however long the step.
TEST(PoleMemory, IsExactForStraightVelocitiesAtAnyStep) {
  for (const double h : {0.05, 0.7, 4.0}) {
    const PoleMemory memory(body.model(), h);
    std::vector<double> v;
    for (std::uint64_t i = 0; i < 14; ++i) v.push_back(random_velocity(i, 1)[0]);
    const auto state = memory.start(Eigen::VectorXd::Constant(1, v[0]));
    for (std::size_t i = 1; i < 12; ++i) state->accept(Eigen::VectorXd::Constant(1, v[i]));
    for (const double fraction : {0.25, 1.0}) {
      const double at_end = v[11] + fraction * (v[12] - v[11]);
      const double ours = state->history_force(fraction)[0] + memory.instantaneous(fraction)(0, 0) * at_end;
      EXPECT_NEAR(ours, exact_load(v, h, 11, fraction), 1e-9 * (1 + h)) << "step " << h << ", fraction " << fraction;
    }
  }
}

// (R7), (R24): the same of a sum over steps. \returns the largest difference, load over load
double off_for_straight_velocities(const RetardationKernel& kernel, double h) {
  const DirectConvolution memory(kernel);
  std::vector<double> v{0};  // the first velocity has half its weight
  for (std::uint64_t i = 1; i < 14; ++i) v.push_back(random_velocity(i, 1)[0]);
  const auto state = memory.start(Eigen::VectorXd::Constant(1, v[0]));
  double off = 0, size = 0;
  for (std::size_t i = 1; i < 13; ++i) {
    const double exact = exact_load(v, h, i, 0);
    const double ours = state->history_force(1)[0] + memory.instantaneous(1)(0, 0) * v[i];
    off = std::max(off, std::abs(ours - exact));
    size = std::max(size, std::abs(exact));
    state->accept(Eigen::VectorXd::Constant(1, v[i]));
  }
  return off / size;
}

TEST(DirectConvolution, IsExactForStraightVelocitiesAtAnyStep) {
  const auto damping = body.damping_table(80, 2000);
  const MemorySurvey survey(damping);
  for (const double h : {0.05, 0.7, 2.0}) {
    // The averages are good to 1e-4 and less (IsAveragedOverSteps), and the memory is cut at e^{−9}.
    EXPECT_LT(off_for_straight_velocities(RetardationKernel::averaged(damping, {h, 30}, survey), h), 3e-4) << h;
    if (h < 0.5) continue;  // the samples themselves are nowhere near
    EXPECT_GT(off_for_straight_velocities(RetardationKernel::from_damping(damping, {h, 30}, survey), h), 0.01) << h;
  }
}

// Damping that lasts to 80 rad/s, as a tail extrapolated far beyond its table, and a slow motion in steps of 0.1 s,
// which show 31 rad/s at most: the load is B v + ω(A − A∞) of the slow motion, nothing of what is fast.
TEST(DirectConvolution, DoesNotFoldWhatIsFasterThanItsSteps) {
  DampingTable damping;
  for (double omega = 0.1; omega < 80.05; omega += 0.1) {
    damping.omega.push_back(omega);
    damping.B.push_back(Eigen::MatrixXd::Constant(1, 1, omega < 50 ? omega / 50 : (80 - omega) / 30 + 1e-9));
  }
  constexpr double h = 0.1, slow = 0.5;
  const MemorySurvey survey(damping);
  const auto load = [&](const RetardationKernel& kernel) {
    const DirectConvolution memory(kernel);
    auto history = memory.make_history();
    const auto v = [&](int i) { return Eigen::VectorXd::Constant(1, std::cos(slow * h * (i - 600))); };
    for (int i = 0; i < 600; ++i) history.push(v(i));
    return (memory.history_force(history, 1) + memory.instantaneous(1) * v(600))[0];
  };
  const double exact = 0.01;  // B(0.5), in phase with the velocity
  // Straight velocities lose sinc² = 1 − (ωh)²/12 = 2e-4; the echo of corners at 50 rad/s at the end of 30 s: 2/(π 50
  // 30²)·…, 1e-4.
  EXPECT_NEAR(load(RetardationKernel::averaged(damping, {h, 30}, survey)), exact, 5e-4);
  EXPECT_GT(std::abs(load(RetardationKernel::from_damping(damping, {h, 30}, survey)) - exact), 50 * exact)
      << "samples lay B of 63 rad/s upon it";
}

TEST(PoleMemory, CarriesSlowPolesWithoutLossOfDigits) {
  const PoleModel slow{{{1e-7, 0}}, {Eigen::MatrixXd::Ones(1, 1)}, {Eigen::MatrixXd::Zero(1, 1)}};
  const auto c = PoleMemory(slow, 0.01).carried_over(0.01).front();
  EXPECT_NEAR(c.after.real() / 0.01, 0.5 - 1e-9 / 6, 1e-15);
  EXPECT_NEAR(c.before.real() / 0.01, 0.5 - 1e-9 / 3, 1e-15);
}

// Modes that do not move each other are summed apart from each other, wherever they stand.
TEST(PoleMemory, OfGroupsOfModesIsTheSumOverAllModes) {
  constexpr double h = 0.3;
  const std::vector<std::vector<int>> groups{{0, 3, 4}, {1, 6}, {2}, {5, 7, 8, 9, 10, 11, 12, 13, 14}};
  constexpr int modes = 15;
  const PoleModel shape = support::random_passive(3, 1, 3);  // its poles; matrices are drawn below
  PoleModel model{shape.poles, {}, {}};
  for (std::size_t k = 0; k < model.poles.size(); ++k) {
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(modes, modes), S = C;
    for (const auto& group : groups) {
      const auto n = std::ssize(group);
      const Eigen::VectorXd numbers = random_velocity(77 + k, static_cast<int>(2 * n * n));
      C(group, group) = numbers.head(n * n).reshaped(n, n);
      if (model.poles[k].omega > 0) S(group, group) = numbers.tail(n * n).reshaped(n, n);
    }
    model.C.push_back(C + C.transpose());
    model.S.push_back(S + S.transpose());
  }
  const PoleMemory memory(model, h);
  const auto state = memory.start(Eigen::VectorXd::Zero(modes));
  // z of each oscillation of each mode by itself, carried on as (R14) has it, and summed with whole matrices.
  std::vector<Eigen::VectorXcd> z(model.poles.size(), Eigen::VectorXcd::Zero(modes));
  Eigen::VectorXd before = Eigen::VectorXd::Zero(modes);
  for (std::uint64_t i = 1; i < 40; ++i) {
    const Eigen::VectorXd v = random_velocity(i, modes);
    Eigen::VectorXd plain = Eigen::VectorXd::Zero(modes);
    for (std::size_t k = 0; k < z.size(); ++k) {
      const auto& c = memory.carried_over_a_step()[k];
      const Eigen::VectorXcd there = c.growth * z[k] + c.before * before;
      plain += model.C[k] * there.real() + model.S[k] * there.imag();
      z[k] = there + c.after * v;
    }
    EXPECT_LT((state->history_force(1) - plain).norm(), 1e-13 * plain.norm() + 1e-15) << i;  // rounding of sums
    before = v;
    state->accept(v);
  }
}

// (R14): the sampled load is the transform folded with squared sinc weights, so no motion can take energy from it.
TEST(PoleMemory, NeverGivesEnergyToARandomMotionAtAnyStep) {
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const double h : {0.1, 1.5, 6.0}) {
      const int modes = 1 + static_cast<int>(seed % 4);
      const PoleMemory memory(support::random_passive(seed, modes, 3), h);
      const auto state = memory.start(Eigen::VectorXd::Zero(modes));
      double energy = 0, scale = 0;
      for (std::uint64_t i = 1; i < 300; ++i) {
        const Eigen::VectorXd v = random_velocity(1000 * seed + i, modes);
        const Eigen::VectorXd load = state->history_force(1) + memory.instantaneous(1) * v;
        energy += h * load.dot(v);
        scale += h * load.norm() * v.norm();
        EXPECT_GE(energy, -1e-12 * scale) << "seed " << seed << ", step " << h;
        state->accept(v);
      }
    }
}

/// Memories of the body for steps of h seconds, and a swing of it at omega.
struct MemoriesOfOneBody {
  double h = 0.02, omega = 0.9;
  RetardationKernel K = RetardationKernel::from_damping(body.damping_table(40, 1000), {h, 30});
  DirectConvolution direct{K};
  PartitionedConvolution partitioned{K};
  PoleMemory poles{body.model(), h};
  ConstantMemory constant{body.B(omega) * Eigen::MatrixXd::Ones(1, 1), omega, h};

  Eigen::VectorXd v(int step) const { return Eigen::VectorXd::Constant(1, std::sin(omega * h * step)); }
};

TEST(Memories, OfOneBodyAgreeInASmoothMotion) {
  const MemoriesOfOneBody of;
  const std::vector<const MemoryMethod*> methods{&of.direct, &of.partitioned, &of.poles};
  std::vector<std::unique_ptr<MemoryState>> states;
  for (const auto* m : methods) states.push_back(m->start(Eigen::VectorXd::Zero(1)));
  const int steps = 2000;
  for (int i = 1; i < steps; ++i)
    for (auto& s : states) s->accept(of.v(i));
  const double t = of.h * steps, mass_force = of.omega * body.A_minus_A_inf(of.omega) * std::cos(of.omega * t);
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const double load = (states[k]->history_force(1) + methods[k]->instantaneous(1) * of.v(steps))[0];
    EXPECT_NEAR(load, body.B(of.omega) * of.v(steps)[0] + mass_force, 1e-3)
        << methods[k]->describe();  // as in convolution_test
  }
  // Constant coefficients carry the other part as added mass.
  EXPECT_NEAR((of.constant.instantaneous(1) * of.v(steps))[0] + mass_force,
              body.B(of.omega) * of.v(steps)[0] + mass_force, 1e-12);
}

// A power of two and more on either side: parts of the partitioned sum are begun and due at any of these.
TEST(Memories, GoOnToTheBitFromWhatIsKeptOfThem) {
  const MemoriesOfOneBody of;
  for (const MemoryMethod* method :
       std::initializer_list<const MemoryMethod*>{&of.direct, &of.partitioned, &of.poles, &of.constant})
    for (const int kept_after : {1, 63, 64, 777}) {
      const auto whole = method->start(of.v(0)), other = method->start(of.v(5));
      for (int i = 1; i <= kept_after; ++i) whole->accept(of.v(i));
      hydro::StateBytes taken;
      whole->keep_state(taken);
      hydro::StateBytes given(taken.bytes());
      other->keep_state(given);
      EXPECT_TRUE(given.at_end());
      for (int i = kept_after + 1; i < kept_after + 1500; ++i) {
        for (const double fraction : {1.0, 0.3})
          ASSERT_EQ(whole->history_force(fraction)[0], other->history_force(fraction)[0])
              << method->describe() << ", kept after " << kept_after << ", step " << i;
        whole->accept(of.v(i));
        other->accept(of.v(i));
      }
    }
}

// (R19), (R20)
TEST(Choice, TakesTheCheapestWithinTheTolerance) {
  const auto table = body.damping_table(8, 160);
  const Eigen::MatrixXd A_inf = 7 * Eigen::MatrixXd::Identity(1, 1);
  const auto A = body.added_mass(table, 7);
  const auto chosen = choose(table, A, A_inf, {.step = 0.05, .tolerance = 1e-2, .length = {}, .method = {}});
  EXPECT_EQ(chosen.method, Method::poles) << chosen.why;
  EXPECT_EQ(chosen.alternatives.size(), 3u);
  for (const auto& a : chosen.alternatives)
    if (a.method == Method::poles) {
      EXPECT_LT(a.error, 1e-2);
      EXPECT_TRUE(a.within);
    }
  for (const Method method : {Method::direct, Method::partitioned, Method::poles}) {
    const auto forced = choose(table, A, A_inf, {.step = 0.05, .tolerance = 1e-2, .length = {}, .method = method});
    EXPECT_EQ(forced.method, method);
    EXPECT_EQ(forced.alternatives.size(), 1u);
    EXPECT_EQ(forced.memory->modes(), 1);
  }
  const auto fixed = choose(table, A, A_inf, {.step = 0.05, .tolerance = 1e-2, .length = 20.0, .method = {}});
  EXPECT_NE(fixed.method, Method::poles) << "a length of memory asks for a convolution";
  EXPECT_THROW(choose(table, A, A_inf, {.step = 0.05, .tolerance = 1e-2, .length = 20.0, .method = Method::poles}),
               hydro::InputError);
}

// The yardstick sees all that a method leaves out: cut at 5 s, the two-pole kernel lacks what (R5) says it lacks.
TEST(Choice, ReportsTheErrorOfAKernelCutShort) {
  const auto table = body.damping_table(20, 200);
  const auto A = body.added_mass(table, 7);
  const auto chosen = choose(table, A, Eigen::MatrixXd(7 * Eigen::MatrixXd::Identity(1, 1)),
                             {.step = 0.05, .tolerance = 1e-3, .length = 5.0, .method = Method::direct});
  // ∫₅^∞ K e^{−iωt} dt of the exact body at its worst frequency, by a fine sum.
  double worst = 0, largest = 0;
  for (const double omega : table.omega) {
    std::complex<double> rest = 0;
    for (double t = 5.005; t < 60; t += 0.01) rest += 0.01 * body.K(t) * std::polar(1.0, -omega * t);
    worst = std::max(worst, std::abs(rest));
    largest = std::max(largest, body.B(omega));
  }
  EXPECT_NEAR(chosen.alternatives.front().error, worst / largest, 0.02 * worst / largest);
  EXPECT_GE(chosen.truncation, worst / largest);
}

}  // namespace
}  // namespace methods_test
