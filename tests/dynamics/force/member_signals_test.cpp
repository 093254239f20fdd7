// The loads of single members as signals: together they are what the kind puts on the body. (D154)
#include "dynamics/force/member_signals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "dynamics/force/morison.hpp"
#include "dynamics/force/slamming.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/small_seas.hpp"

namespace member_signals_test {
namespace {

using namespace dynamics;

const auto bodies = support::two_bodies();

/// Ends are global, at rest.
SlenderMember line(int body, const Eigen::Vector3d& from, const Eigen::Vector3d& to, Immersion immersion) {
  const Eigen::Vector3d c = bodies[static_cast<std::size_t>(body)].rest_centre();
  return {body, from - c, to - c, 0.4, 5, immersion};
}

ToldLoad told(const std::string& name, int body) {
  return {name, bodies[static_cast<std::size_t>(body)].properties().centre_of_gravity.xyz};
}

/// What all members together put on a body about its origin: the load, less the kind's own mass times acceleration.
Vector6 whole_load(const ForceKind& kind, int body, const State& s, const Eigen::VectorXd& a, Memory* memory) {
  Eigen::VectorXd load = laws::load(kind, s, memory), inertia = Eigen::VectorXd::Zero(load.size());
  MassSink sink(a, inertia);
  kind.add_mass(s, sink);
  Vector6 out = (load - inertia).segment<6>(6 * body);
  const Eigen::Vector3d arm = s.pose[static_cast<std::size_t>(body)].attitude * told("", body).centre_of_gravity;
  out.tail<3>() += arm.cross(Eigen::Vector3d(out.head<3>()));
  return out;
}

/// Of the signals of these members, one after the other.
Vector6 sum_of(const std::vector<Signal>& signals, std::size_t first_member, std::size_t members,
               const Reading& reading) {
  Vector6 out = Vector6::Zero();
  for (std::size_t k = 6 * first_member; k < 6 * (first_member + members); ++k)
    out[static_cast<Eigen::Index>(k % 6)] += signals[k].value(reading);
  return out;
}

TEST(MemberLoads, OfMorisonAddUpToTheLoadOnTheBody) {
  using enum Immersion;
  const std::vector<MorisonMember> members{
      {line(0, {-1, 0.3, -3}, {1, -0.2, -1.4}, whole), 1.1, 0.9, 0.02, told("a", 0)},
      {line(0, {-1, 0.3, -3}, {1, -0.2, 0.8}, surface), 0.7, 1, 0, told("b", 0)},
      {line(1, {2, 0.3, -3}, {1, -0.2, -0.9}, whole), 1, 0.8, 0, {}},
      {line(1, {3, 1, -2}, {5, 1, -1}, whole), 1.3, 0.6, 0, told("d", 1)}};
  for (const double foresight : {0.0, 1e-3}) {
    const MorisonKind kind(members, support::steep_wave(hydro::waves::Stretching::wheeler), foresight);
    const State s = support::random_state(bodies, 3);
    const auto memory = kind.make_memory(s);
    const Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(12, -2, 3), none;
    const Reading reading{s, a, none, 0, memory.get()};
    const auto signals = kind.signals();
    ASSERT_EQ(signals.size(), 18u);
    EXPECT_EQ(signals[0].name, "a.morison_force_x");
    EXPECT_EQ(signals[17].name, "d.morison_moment_z");
    const Vector6 both = whole_load(kind, 0, s, a, memory.get());
    ASSERT_GT(both.norm(), 100);
    // Sums of the same terms in another order: rounding.
    EXPECT_LT((sum_of(signals, 0, 2, reading) - both).norm(), 1e-12 * both.norm());
    // The last alone is that of a kind without the silent one.
    const MorisonKind alone({members[3]}, support::steep_wave(hydro::waves::Stretching::wheeler));
    const Vector6 last = whole_load(alone, 1, s, a, nullptr);
    EXPECT_LT((sum_of(signals, 2, 1, reading) - last).norm(), 1e-12 * last.norm());
  }
}

TEST(MemberLoads, OfImpactsAddUpToTheLoadOnTheBody) {
  const auto member = [](double height, double x, std::optional<ToldLoad> tells) {
    return SlammingMember{line(0, {x, -1, height}, {x + 0.3, 1, height + 0.1}, Immersion::surface),
                          hydro::waves::ImpactTheory::wienke_oumeraci, ImpactBegins::line, 1.5, std::move(tells)};
  };
  const SlammingKind kind({member(0.3, 0, told("a", 0)), member(0.2, 1, told("b", 0))}, support::still_water(), 0.01);
  State s = rest_state(bodies);
  const auto memory = kind.make_memory(s);
  s.pose[0].centre.z() -= 0.5;
  s.velocity << 0.4, 0.2, -3, 0.1, -0.2, 0.3, 0, 0, 0, 0, 0, 0;
  s.time = 1;
  memory->accept(s);
  const Eigen::VectorXd a = Eigen::VectorXd::Ones(12), none;
  s.time = 1.012;
  const Vector6 all = whole_load(kind, 0, s, a, memory.get());
  ASSERT_GT(all.norm(), 1000);
  const Vector6 told_all = sum_of(kind.signals(), 0, 2, {s, a, none, 0, memory.get()});
  EXPECT_LT((told_all - all).norm(), 1e-12 * all.norm());
  s.time = 2;  // long after: nothing, to the bit
  EXPECT_EQ(sum_of(kind.signals(), 0, 2, {s, a, none, 0, memory.get()}).norm(), 0);
}

}  // namespace
}  // namespace member_signals_test
