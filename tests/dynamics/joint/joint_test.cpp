// Constraints of joints: gradients and curvatures against differences, and which motions each kind allows.
#include "dynamics/joint/joint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/joint/constraints.hpp"
#include "dynamics/model/model.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace joint_test {
namespace {

using namespace dynamics;
using testing::HasSubstr;
using testing::ThrowsMessage;

RigidBody body(const std::string& name, const Eigen::Vector3d& at,
               std::array<bool, 6> free = {true, true, true, true, true, true}) {
  return RigidBody({.name = name,
                    .mass = 3,
                    .inertia = Eigen::Vector3d(1, 2, 2.5).asDiagonal(),
                    .rest_position = {at},
                    .free = free});
}

const std::vector<RigidBody> two{body("a", {1, 2, 3}), body("b", {4, 2, 2})};

Joint joint(JointKind kind, std::optional<int> second = 1) {
  return {.name = "j",
          .kind = kind,
          .first = 0,
          .second = second,
          .place = {2, 2.5, 3.5},
          .axis = {1, 2, -1},
          .second_axis = {2, -1, 0}};
}

constexpr JointKind all_kinds[] = {JointKind::fixed, JointKind::hinge,  JointKind::universal,
                                   JointKind::ball,  JointKind::slider, JointKind::planar};

Eigen::VectorXd random_vector(Eigen::Index size, std::uint64_t seed) {
  const hydro::RandomStream random(seed, 3);
  Eigen::VectorXd out(size);
  for (Eigen::Index i = 0; i < size; ++i) out[i] = 2 * random.uniform(static_cast<std::uint64_t>(i)) - 1;
  return out;
}

State somewhere(std::uint64_t seed) { return moved(rest_state(two), random_vector(12, seed)); }

TEST(Joint, GradientsAreTheDerivativesOfTheConstraints) {
  for (const JointKind kind : all_kinds)
    for (const std::optional<int> second : {std::optional<int>(1), std::optional<int>()}) {
      const JointSet set(two, {joint(kind, second)});
      const State at = somewhere(1);
      const Eigen::VectorXd direction = random_vector(12, 2);
      const double h = 1e-5;  // central differences: h² and 1e-16/h, 1e-10
      const Eigen::VectorXd difference =
          (set.values(moved(at, h * direction)) - set.values(moved(at, -h * direction))) / (2 * h);
      EXPECT_LT((set.times(set.gradients(at), direction) - difference).norm(), 1e-8) << name_of(kind);
    }
}

TEST(Joint, CurvaturesAreTheDerivativesOfTheGradients) {
  for (const JointKind kind : all_kinds)
    for (const std::optional<int> second : {std::optional<int>(1), std::optional<int>()}) {
      const JointSet set(two, {joint(kind, second)});
      const State at = somewhere(3);
      const Eigen::VectorXd direction = random_vector(12, 4), lambda = random_vector(set.count(), 5);
      BlockPattern pattern(2);
      pattern.couple(0, 1);
      pattern.freeze();
      BlockMatrix H(pattern);
      set.add_curvature(at, lambda, 1, H);
      const auto load = [&](double h) {
        Eigen::VectorXd out = Eigen::VectorXd::Zero(12);
        const State there = moved(at, h * direction);
        set.add_transposed(set.gradients(there), lambda, out);
        return out;
      };
      const double h = 1e-5;
      EXPECT_LT((H * direction - (load(h) - load(-h)) / (2 * h)).norm(), 1e-8) << name_of(kind);
      State moving = at;
      moving.velocity = direction;
      const double expected = direction.dot(H * direction);
      EXPECT_NEAR(set.convective(moving).dot(lambda), expected, 1e-12) << name_of(kind);
    }
}

TEST(Joint, IsClosedAtRestAndHoldsAsManyMotionsAsItsName) {
  const int held[] = {6, 5, 4, 3, 5, 3};
  for (std::size_t i = 0; i < std::size(all_kinds); ++i) {
    const JointSet set(two, {joint(all_kinds[i])});
    EXPECT_EQ(set.count(), held[i]);
    EXPECT_LT(set.values(rest_state(two)).norm(), 1e-15);
    Eigen::MatrixXd G(set.count(), 12);
    const auto rows = set.gradients(rest_state(two));
    for (Eigen::Index k = 0; k < 12; ++k) G.col(k) = set.times(rows, Eigen::VectorXd::Unit(12, k));
    EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(G).rank(), held[i]) << name_of(all_kinds[i]);
  }
}

/// The second body turned about a global line through the joint's place, and shifted.
State second_moved(const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) {
  State out = rest_state(two);
  const Eigen::Vector3d place = joint(JointKind::ball).place;
  const Eigen::Quaterniond R = rotation_exp(turn);
  out.pose[1].centre = place + R * (out.pose[1].centre - place) + shift;
  out.pose[1].attitude = R;
  return out;
}

TEST(Joint, AllowsJustTheMotionsOfItsKind) {
  const Eigen::Vector3d x = Eigen::Vector3d(1, 2, -1).normalized(), y = Eigen::Vector3d(2, -1, 0).normalized(),
                        z = x.cross(y), none = Eigen::Vector3d::Zero();
  const auto open = [](JointKind kind, const State& state) {
    return JointSet(two, {joint(kind)}).values(state).norm();
  };
  using enum JointKind;
  const State about_x = second_moved(1.2 * x, none), about_z = second_moved(0.4 * z, none),
              about_y = second_moved(0.7 * y, none), along_x = second_moved(none, 0.3 * x),
              across = second_moved(none, 0.3 * y);
  // Rounding of poses: 1e-15. What a joint forbids opens it by some tenths.
  for (const JointKind kind : {hinge, universal, ball, planar}) EXPECT_LT(open(kind, about_x), 1e-14) << name_of(kind);
  for (const JointKind kind : {universal, ball}) EXPECT_LT(open(kind, about_y), 1e-14) << name_of(kind);
  EXPECT_LT(open(ball, about_z), 1e-14);
  EXPECT_LT(open(slider, along_x), 1e-14);
  EXPECT_LT(open(planar, across), 1e-14);
  for (const JointKind kind : {fixed, slider}) EXPECT_GT(open(kind, about_x), 0.2) << name_of(kind);
  for (const JointKind kind : {fixed, hinge, slider, planar, universal})
    EXPECT_GT(open(kind, about_z), 0.2) << name_of(kind);
  for (const JointKind kind : {fixed, hinge, universal, ball, planar})
    EXPECT_GT(open(kind, along_x), 0.2) << name_of(kind);
  for (const JointKind kind : {fixed, hinge, universal, ball, slider}) EXPECT_GT(open(kind, across), 0.2);
}

TEST(Joint, ThatOthersHoldAlreadyIsNamedAndLeftOut) {
  std::vector<Joint> door{joint(JointKind::hinge), joint(JointKind::hinge)};
  door[0].name = "lower";
  door[1].name = "upper";
  door[1].place += 2 * door[1].axis;
  const Model model(two, {}, {}, door);
  EXPECT_EQ(model.joints().count(), 5);
  EXPECT_THAT(model.redundant(), testing::ElementsAre(HasSubstr("\"upper\" (hinge): 5 of its 5")));
  // A body that cannot move across needs no holding there.
  const std::vector<RigidBody> on_rails{body("a", {0, 0, 0}, {true, false, false, false, false, false})};
  const Model rails(on_rails, {}, {},
                    {{.name = "rail", .kind = JointKind::slider, .first = 0, .second = {}, .place = {0, 0, 0}}});
  EXPECT_EQ(rails.joints().count(), 0);
  EXPECT_THAT(rails.redundant(), testing::ElementsAre(HasSubstr("5 of its 5")));
}

// Bodies in a plane on a pivot and a rack: of ten constraints the locked modes hold six, and what is kept is regular.
TEST(Joint, ThatLockedModesHoldInPartKeepsTheRest) {
  const std::array<bool, 6> plane{true, false, true, false, true, false};
  const Model model(
      {body("slide", {0, 0, -22}, plane), body("buoy", {0, 0, -3}, plane)}, {}, {},
      {{.name = "pivot", .kind = JointKind::hinge, .first = 0, .second = {}, .place = {0, 0, -40}, .axis = {0, 1, 0}},
       {.name = "rack", .kind = JointKind::slider, .first = 0, .second = 1, .place = {0, 0, 0}, .axis = {0, 0, 1}}});
  ASSERT_EQ(model.joints().count(), 4);
  const Eigen::MatrixXd G = model.joints().dense(model.joints().gradients(rest_state(model.bodies())));
  const Eigen::MatrixXd gram = G * G.transpose();
  EXPECT_GT(gram.determinant(), 1) << "arms of metres, unit directions";
}

TEST(Joint, ThatCannotBeIsRefused) {
  Joint wrong = joint(JointKind::hinge);
  wrong.axis.setZero();
  EXPECT_THAT([&] { JointSet(two, {wrong}); }, ThrowsMessage<hydro::InputError>(HasSubstr("has no direction")));
  wrong = joint(JointKind::universal);
  wrong.second_axis = {1, 0, 0};
  EXPECT_THAT([&] { JointSet(two, {wrong}); }, ThrowsMessage<hydro::InputError>(HasSubstr("across each other")));
  wrong = joint(JointKind::ball, 0);
  EXPECT_THAT([&] { JointSet(two, {wrong}); }, ThrowsMessage<hydro::InputError>(HasSubstr("to itself")));
  wrong = joint(JointKind::ball, 7);
  EXPECT_THAT([&] { JointSet(two, {wrong}); }, ThrowsMessage<hydro::InputError>(HasSubstr("not there")));
}

}  // namespace
}  // namespace joint_test
