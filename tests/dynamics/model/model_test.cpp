#include "dynamics/model/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/restoring.hpp"
#include "hydro/base/error.hpp"
#include "support/force_law_models.hpp"

namespace model_test {
namespace {

using namespace dynamics;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RigidBody, RefusesWhatPhysicsForbids) {
  RigidBody::Properties p{.name = "raft", .mass = 10, .inertia = Eigen::Matrix3d::Identity()};
  auto bad = p;
  bad.mass = -1;
  EXPECT_THAT([&] { RigidBody{bad}; }, ThrowsMessage<hydro::InputError>(HasSubstr("mass must be positive, got -1 kg")));
  bad = p;
  bad.inertia(1, 1) = -2;
  EXPECT_THAT([&] { RigidBody{bad}; }, ThrowsMessage<hydro::InputError>(HasSubstr("not positive definite")));
  bad.free = {true, true, true, true, false, true};  // a rotation that cannot happen needs no inertia
  EXPECT_NO_THROW(RigidBody{bad});
}

std::vector<std::unique_ptr<const ForceKind>> springs(const std::vector<RigidBody>& bodies) {
  std::vector<std::unique_ptr<const ForceKind>> f;
  Matrix6 C = Matrix6::Identity() * 800;
  f.push_back(std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, C, 0.1 * C}, {1, C}}));
  f.push_back(std::make_unique<AxialConnectorKind>(
      std::vector<AxialConnector>{{{{0, {1, 0, 0}}, PointOnBody{1, {-1, 0, 0}}}, {500, 20}, 1.8}}));
  return f;
}

Eigen::MatrixXd added_mass() {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(12, 12) * 300;
  A.topRightCorner(6, 6).diagonal().setConstant(-40);
  A.bottomLeftCorner(6, 6).diagonal().setConstant(-40);
  return A;
}

// The tangent is the derivative of the residual; by differences, leaving out only what the model leaves out: the
// turning of the inertia with the body, which multiplies the angular acceleration (taken as zero here).
TEST(Model, TangentIsTheDerivativeOfTheResidual) {
  const auto bodies = support::two_bodies();
  const Model model(bodies, {{{0, 1}, added_mass()}}, springs(bodies));
  State state = support::random_state(bodies, 3);
  state.velocity[4] = state.velocity[3] = state.velocity[5] = 0;  // gyroscopic moment turns with the body too
  state.velocity.segment<3>(9).setZero();
  Workspace w(model, state);
  const Eigen::VectorXd a = Eigen::VectorXd::Zero(12);
  constexpr double e = 1e-6;
  BlockMatrix matrix(model.pattern());
  model.tangent(state, 0.7, 0.2, 0.05, w, matrix);
  for (Eigen::Index i = 0; i < 12; ++i) {
    const Eigen::VectorXd d = e * Eigen::VectorXd::Unit(12, i);
    const auto at = [&](double sign) {
      State s = dynamics::moved(state, sign * 0.05 * d);
      s.velocity += sign * 0.2 * d;
      return model.residual(s, a + sign * 0.7 * d, w);
    };
    const Eigen::VectorXd difference = (at(1) - at(-1)) / (2 * e);
    EXPECT_LT((matrix.dense().col(i) - difference).norm(), 1e-6 * (1 + difference.norm())) << i;
  }
}

TEST(Model, LeavesOutModesThatAreNotFree) {
  RigidBody::Properties p = support::two_bodies()[0].properties();
  p.free = {false, false, true, false, false, false};
  const std::vector<RigidBody> bodies{RigidBody(p)};
  std::vector<std::unique_ptr<const ForceKind>> f;
  f.push_back(std::make_unique<RestoringKind>(
      "mooring", bodies, std::vector<Restoring>{{0, Matrix6::Constant(50) + 100 * Matrix6::Identity()}}));
  const Model model(bodies, {}, std::move(f));
  Workspace w(model, support::random_state(bodies, 1));
  const Eigen::VectorXd r = model.residual(w.state, Eigen::VectorXd::Zero(6), w);
  model.tangent(w.state, 1, 0.1, 0.1, w, w.matrix);
  for (int i = 0; i < 6; ++i) {
    if (i == 2) continue;
    EXPECT_EQ(r[i], 0);
    EXPECT_EQ(w.matrix.dense().row(i), Eigen::RowVectorXd::Unit(6, i));
    EXPECT_EQ(w.matrix.dense().col(i), Eigen::VectorXd::Unit(6, i));
  }
}

TEST(Model, RefusesAnIndefiniteMassAndNamesTheMode) {
  const auto bodies = support::two_bodies();
  Eigen::MatrixXd A = added_mass();
  A(8, 8) = -5000;  // heave of b
  EXPECT_THAT(
      [&] {
        Model(bodies, {{{0, 1}, A}}, {});
      },
      ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr("not positive definite"), HasSubstr("b.heave"))));
}

// What a scene does not name is not there: no kind, hence nothing evaluated, and no coupling in the pattern.
TEST(Model, HasNothingThatWasNotNamed) {
  const auto bodies = support::two_bodies();
  const Model bare(bodies, {}, {});
  EXPECT_EQ(bare.pattern().blocks(), 2u);
  Workspace w(bare, rest_state(bodies));
  bare.residual(w.state, w.acceleration, w);
  EXPECT_TRUE(w.evaluations.empty());
  const Model sprung(bodies, {}, springs(bodies));
  Workspace v(sprung, rest_state(bodies));
  sprung.residual(v.state, v.acceleration, v);
  EXPECT_EQ(v.evaluations, (std::vector<std::size_t>{1, 1}));
  EXPECT_EQ(sprung.pattern().blocks(), 4u);
}

}  // namespace
}  // namespace model_test
