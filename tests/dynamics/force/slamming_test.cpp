#include "dynamics/force/slamming.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "laws/force_kind_laws.hpp"
#include "support/small_seas.hpp"

namespace slamming_test {
namespace {

using namespace dynamics;
using hydro::waves::ImpactTheory;
using std::numbers::pi;

const auto bodies = support::two_bodies();

/// A level cylinder 2 m long across x, its axis `height` above still water while its body is at rest.
SlammingKind level(ImpactTheory theory, double step, ImpactBegins begins = ImpactBegins::line, double height = 0.5) {
  const Eigen::Vector3d c = bodies[0].rest_centre(), from(0, -1, height), to(0, 1, height);
  return {{{{0, from - c, to - c, 0.4, 8, Immersion::surface}, theory, begins}}, support::still_water(), step};
}

/// Lets the body fall at 3 m/s from rest, in steps; returns the impulse of all loads, trapezium rule.
Eigen::VectorXd impulse_of_fall(const SlammingKind& kind, double step, double* first = nullptr) {
  State s = rest_state(bodies);
  s.velocity[2] = -3;
  const auto memory = kind.make_memory(s);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(12);
  for (int i = 1; i <= static_cast<int>(0.6 / step); ++i) {
    s.time = i * step;
    s.pose[0].centre.z() = bodies[0].rest_centre().z() - 3 * s.time;
    const Eigen::VectorXd F = laws::load(kind, s, memory.get());
    if (first != nullptr && *first < 0 && F.norm() > 0) *first = s.time;
    sum += step * F;
    memory->accept(s);
  }
  return sum;
}

TEST(Slamming, GivesTheImpulseOfTheTheoryWhateverTheStep) {
  for (const auto theory : {ImpactTheory::goda, ImpactTheory::wienke_oumeraci, ImpactTheory::von_karman}) {
    const double whole = 2 * hydro::waves::CylinderImpact(theory, 0.2, 3, 1000).impulse(10);
    for (const double step : {0.1, 0.01, 0.0007})  // longer than the impact, shorter, and one that does not divide it
      EXPECT_NEAR(impulse_of_fall(level(theory, step), step)[2], whole, 1e-9 * whole) << step;
  }
}

TEST(Slamming, BeginsWhenTheChosenPartGoesUnder) {
  using enum ImpactBegins;
  const double step = 1e-3;
  for (const auto& [begins, depth] : {std::pair{underside, -0.2}, std::pair{line, 0.0}, std::pair{submerged, 0.2}}) {
    double first = -1;
    impulse_of_fall(level(ImpactTheory::goda, step, begins), step, &first);
    EXPECT_NEAR(first, (0.5 + depth) / 3, 2.1 * step);  // found at the end of a step, felt at the end of the next
  }
}

TEST(Slamming, OfWhatIsUnderFromTheBeginningIsNothing) {
  EXPECT_EQ(impulse_of_fall(level(ImpactTheory::goda, 0.01, ImpactBegins::line, -0.1), 0.01).norm(), 0);
}

TEST(Slamming, StrikesAgainAfterComingUp) {
  const SlammingKind kind = level(ImpactTheory::goda, 0.01);
  State s = rest_state(bodies);
  const auto memory = kind.make_memory(s);
  int struck = 0;
  for (int i = 1; i <= 400; ++i) {
    s.time = 0.01 * i;
    s.pose[0].centre.z() = bodies[0].rest_centre().z() - 1 + std::cos(2 * pi * s.time);
    s.velocity[2] = -2 * pi * std::sin(2 * pi * s.time);
    const bool before = laws::load(kind, s, memory.get()).norm() > 0;
    memory->accept(s);
    s.time += 0.01;
    struck += !before && laws::load(kind, s, memory.get()).norm() > 0;
  }
  EXPECT_EQ(struck, 4);
}

TEST(ForceLaws, HoldForSlammingWithinAnImpact) {
  const SlammingKind kind = level(ImpactTheory::wienke_oumeraci, 0.01);
  State s = rest_state(bodies);
  const auto memory = kind.make_memory(s);
  s.pose[0].centre.z() -= 0.52;
  s.velocity << 0.4, 0.2, -3, 0.1, -0.2, 0.3, 0, 0, 0, 0, 0, 0;
  s.time = 1;
  memory->accept(s);
  State now = support::random_state(bodies, 1), other = support::random_state(bodies, 2);
  now.time = 1.012;
  other.time = 1.02;
  EXPECT_GT(laws::load(kind, now, memory.get()).norm(), 100);
  laws::expect_pure(kind, now, other, memory.get());
  laws::expect_true_jacobians(kind, now, memory.get());
  laws::expect_energy_balance(kind, now, memory.get());
}

}  // namespace
}  // namespace slamming_test
