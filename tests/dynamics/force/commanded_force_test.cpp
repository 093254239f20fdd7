// Forces along joint coordinates that are set between steps.
#include <gtest/gtest.h>

#include "dynamics/force/commanded_force.hpp"
#include "laws/force_kind_laws.hpp"

namespace commanded_force_test {
namespace {

using namespace dynamics;
const auto bodies = support::two_bodies();

Pto pto(JointKind kind, const PtoLaw& law, std::optional<int> second = 1, double sign = 1) {
  const Joint joint{
      .name = "j", .kind = kind, .first = 0, .second = second, .place = {2, 0.3, -0.2}, .axis = {0.2, 1, 0.4}};
  return {JointCoordinate(bodies, joint, second ? 0 : 1), law, sign, second ? "a" : "b"};
}

const PtoLaw own{.line = {.stiffness = 200, .damping = 30, .cubic = 50},
                 .preload = 40,
                 .lower = EndStop{-0.1, 3000, 200},
                 .upper = EndStop{0.05, 3000, 200}};

TEST(ForceLaws, HoldForForcesThatAreNotSetYet) {
  for (const JointKind kind : {JointKind::slider, JointKind::hinge})
    laws::expect_force_laws(CommandedForceKind({pto(kind, own), pto(kind, own, std::nullopt, -1)}), bodies);
}

// (D155): what is set at (x₀, ẋ₀) is a spring, a damper and a preload from there on, within the limit and beside the
// stops.
TEST(CommandedForce, IsThePowerTakeOffThatIsSet) {
  for (const double limit : {1e9, 60.0})
    for (const JointKind kind : {JointKind::slider, JointKind::hinge}) {
      PtoLaw before = own, after = own;
      before.force_limit = after.force_limit = limit;
      after.line = {.stiffness = -120, .damping = 70};
      after.preload = 25;
      const std::vector<Pto> elements{pto(kind, before), pto(kind, before, std::nullopt, -1)};
      const CommandedForceKind commanded(elements);
      const PtoKind as_set({pto(kind, after), pto(kind, after, std::nullopt, -1)});
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const State state = support::random_state(bodies, seed), other = support::random_state(bodies, seed + 100);
        const auto memory = commanded.make_memory(state);
        for (std::size_t i = 0; i < 2; ++i) {
          const PtoState at = pto_state(elements[i], other);
          const double force = -120 * at.coordinate + 70 * at.rate + 25;
          static_cast<CommandMemory&>(*memory).set(i, {force, -120, 70}, other);
        }
        laws::expect_pure(commanded, state, other, memory.get());
        laws::expect_true_jacobians(commanded, state, memory.get());
        laws::expect_energy_balance(commanded, state, memory.get());
        const Eigen::VectorXd F = laws::load(as_set, state, nullptr);
        // Preloads are differences of forces of some 100 N.
        EXPECT_LT((laws::load(commanded, state, memory.get()) - F).norm(), 1e-12 * (F.norm() + 100));
      }
    }
}

TEST(CommandedForce, JumpsWhereAnotherForceIsSetAndNotWhereTheSameLawIs) {
  const auto at = [](double stroke, double rate) {
    State out = rest_state(bodies);
    const Eigen::Vector3d axis = Eigen::Vector3d(0.2, 1, 0.4).normalized();
    out.pose[1].centre += stroke * axis;
    out.velocity.segment<3>(6) = rate * axis;
    return out;
  };
  const auto element = pto(JointKind::slider, {.line = {}, .lower = {}, .upper = {}});
  ASSERT_NEAR(pto_state(element, at(0.3, 0.2)).coordinate, 0.3, 1e-15);
  ASSERT_NEAR(pto_state(element, at(0.3, 0.2)).rate, 0.2, 1e-15);
  CommandMemory memory({element});
  const double spring_and_damper = 7 * 0.4 - 2 * 0.1;
  EXPECT_FALSE(memory.set(0, {}, at(0.3, 0.2))) << "no force, as before";
  EXPECT_TRUE(memory.set(0, {7 * 0.3 + 2 * 0.2, 7, 2}, at(0.3, 0.2)));
  EXPECT_FALSE(memory.set(0, {spring_and_damper, 7, 2}, at(0.4, -0.1))) << "the same spring and damper elsewhere";
  EXPECT_FALSE(memory.set(0, {spring_and_damper}, at(0.4, -0.1))) << "held from here on, from the same force";
  EXPECT_TRUE(memory.set(0, {spring_and_damper + 1e-9}, at(0.5, 0)));
  EXPECT_EQ(pto_state(memory.acting(0), at(3, 4)).force, spring_and_damper + 1e-9) << "whatever the motion";
}

// What the spring of the scene holds when it is taken over stays where it is: nothing comes from nowhere.
TEST(CommandedForce, KeepsTheEnergyOfTheSpringThatItReplaces) {
  const CommandedForceKind kind({pto(JointKind::slider, own)});
  const State state = support::random_state(bodies, 3);
  const auto memory = kind.make_memory(state);
  const double stored = kind.energy({state, memory.get()}).stored;
  ASSERT_GT(std::abs(stored), 1e-3);
  static_cast<CommandMemory&>(*memory).set(0, {5}, state);
  static_cast<CommandMemory&>(*memory).set(0, {-7, 3}, state);
  EXPECT_NEAR(kind.energy({state, memory.get()}).stored, stored, 1e-12 * stored);
}

}  // namespace
}  // namespace commanded_force_test
