#include "dynamics/model/model.hpp"

#include <Eigen/SPQRSupport>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "dynamics/joint/independent.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "joint/columns.hpp"

namespace dynamics {
namespace {

Eigen::Matrix3d inertia_in_world(const RigidBody& body, const Pose& pose) {
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  return R * body.inertia() * R.transpose();
}

/// All bodies, in sets within which added mass makes one move the other.
std::vector<std::vector<int>> moved_together(std::size_t bodies, const std::vector<AddedMass>& added_mass) {
  std::vector<std::size_t> set(bodies);
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (const AddedMass& added : added_mass)
    for (const int body : added.bodies) {
      const std::size_t from = set[static_cast<std::size_t>(body)],
                        to = set[static_cast<std::size_t>(added.bodies.front())];
      if (from != to) std::replace(set.begin(), set.end(), from, to);
    }
  std::vector<std::vector<int>> out(bodies);
  for (std::size_t b = 0; b < bodies; ++b) out[set[b]].push_back(static_cast<int>(b));
  std::erase_if(out, [](const auto& one) { return one.empty(); });
  return out;
}

/// \throws hydro::InputError if the mass of these bodies together is not positive definite in the free modes
void require_positive(const Model& model, const std::vector<int>& bodies, const BlockMatrix& mass) {
  const auto n = static_cast<Eigen::Index>(bodies.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  const auto body_of = [&](Eigen::Index i) { return bodies[static_cast<std::size_t>(i)]; };
  for (Eigen::Index i = 0; i < n; ++i)
    for (const int j : mass.pattern().columns(body_of(i)))
      if (const auto at = std::lower_bound(bodies.begin(), bodies.end(), j); at != bodies.end() && *at == j)
        M.block<6, 6>(6 * i, 6 * (at - bodies.begin())) = mass.block(body_of(i), j);
  const auto mode_of = [&](Eigen::Index i) { return 6 * body_of(i / 6) + static_cast<int>(i % 6); };
  for (Eigen::Index i = 0; i < 6 * n; ++i)
    if (!model.is_free(mode_of(i))) {
      M.row(i).setZero();
      M.col(i).setZero();
      M(i, i) = 1;
    }
  M = hydro::dense::symmetric_part(M);
  if (hydro::dense::Cholesky(M)) return;
  const auto [values, vectors] = hydro::dense::symmetric_eigen(M);
  Eigen::Index worst = 0;
  vectors.col(0).cwiseAbs().maxCoeff(&worst);
  throw hydro::InputError(fmt::format("mass plus added mass is not positive definite: eigenvalue {:.4g}, mostly {}",
                                      values[0], model.mode_name(mode_of(worst))),
                          {}, "check the added mass at infinite frequency with `froude bem check`");
}

}  // namespace

Model::Model(std::vector<RigidBody> bodies, std::vector<AddedMass> added_mass,
             std::vector<std::unique_ptr<const ForceKind>> forces, std::vector<Joint> joints)
    : bodies_(std::move(bodies)),
      added_mass_(std::move(added_mass)),
      forces_(std::move(forces)),
      pattern_(static_cast<int>(bodies_.size())),
      joints_(bodies_, std::move(joints)) {
  for (const AddedMass& added : added_mass_)
    for (const int i : added.bodies)
      for (const int j : added.bodies)
        if (i < j) pattern_.couple(i, j);
  for (const auto& kind : forces_) kind->couple(pattern_);
  joints_.couple(pattern_);
  pattern_.freeze();
  if (bodies_.empty()) return;  // a scene may hold lines alone
  // Dynamics with an indefinite mass run away at once; say so before the first step.
  BlockMatrix mass(pattern_);
  add_mass(rest_state(bodies_), 1, mass);
  for (const auto& set : moved_together(bodies_.size(), added_mass_)) require_positive(*this, set, mass);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(modes());
  for (int i = 0; i < modes(); ++i)
    if (is_free(i)) scale[i] = std::sqrt(mass.block(i / 6, i / 6)(i % 6, i % 6));
  leave_out_redundant(scale);
}

void Model::leave_out_redundant(const Eigen::VectorXd& scale) {
  if (joints_.count() == 0) return;
  const std::vector<bool> keep = independent(joints_, rest_state(bodies_), scale);
  std::vector<int> lost(joints_.joints().size(), 0), of(joints_.joints().size(), 0);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const auto joint = static_cast<std::size_t>(joints_.constraints()[i].joint);
    ++of[joint];
    if (!keep[i]) ++lost[joint];
  }
  for (std::size_t j = 0; j < lost.size(); ++j)
    if (lost[j] > 0)
      redundant_.push_back(fmt::format("joint \"{}\" ({}): {} of its {} constraints are held already and left out",
                                       joints_.joints()[j].name, name_of(joints_.joints()[j].kind), lost[j], of[j]));
  joints_.reduce(keep);
}

std::vector<Signal> Model::signals() const {
  std::vector<Signal> out = motion_signals(bodies_);
  for (std::size_t k = 0; k < forces_.size(); ++k)
    for (Signal& s : forces_[k]->signals()) {
      s.kind = k;
      out.push_back(std::move(s));
    }
  for (Signal& s : joints_.signals(bodies_)) out.push_back(std::move(s));
  return out;
}

std::string Model::mode_name(int mode) const {
  return bodies_[static_cast<std::size_t>(mode / 6)].name() + "." +
         std::string(hydro::mode_names[static_cast<std::size_t>(mode % 6)]);
}

void Model::add_mass(const State& state, double factor, BlockMatrix& out) const {
  for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) {
    const auto& body = bodies_[static_cast<std::size_t>(i)];
    Matrix6& block = out.block(i, i);
    block.topLeftCorner<3, 3>().diagonal().array() += factor * body.mass();
    block.bottomRightCorner<3, 3>() += factor * inertia_in_world(body, state.pose[static_cast<std::size_t>(i)]);
  }
  for (const AddedMass& added : added_mass_)
    for (std::size_t i = 0; i < added.bodies.size(); ++i)
      for (std::size_t j = 0; j < added.bodies.size(); ++j)
        out.block(added.bodies[i], added.bodies[j]) +=
            factor * added.value.block<6, 6>(6 * static_cast<Eigen::Index>(i), 6 * static_cast<Eigen::Index>(j));
  MassSink sink(out, factor);
  for (const auto& kind : forces_) kind->add_mass(state, sink);
}

Eigen::MatrixXd Model::dry_mass(const State& state) const {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(modes(), modes());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    M.block<3, 3>(row, row).diagonal().setConstant(bodies_[i].mass());
    M.block<3, 3>(row + 3, row + 3) = inertia_in_world(bodies_[i], state.pose[i]);
  }
  return M;
}

Eigen::VectorXd Model::mass_times(const State& state, const Eigen::VectorXd& x) const {
  Eigen::VectorXd out;
  mass_times(state, x, out);
  return out;
}

void Model::mass_times(const State& state, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    y.segment<3>(row) = bodies_[i].mass() * x.segment<3>(row);
    y.segment<3>(row + 3) = inertia_in_world(bodies_[i], state.pose[i]) * x.segment<3>(row + 3);
  }
  for (const AddedMass& added : added_mass_)
    for (std::size_t i = 0; i < added.bodies.size(); ++i)
      for (std::size_t j = 0; j < added.bodies.size(); ++j)
        y.segment<6>(6 * added.bodies[i]) +=
            added.value.block<6, 6>(6 * static_cast<Eigen::Index>(i), 6 * static_cast<Eigen::Index>(j)) *
            x.segment<6>(6 * added.bodies[j]);
  MassSink sink(x, y);
  for (const auto& kind : forces_) kind->add_mass(state, sink);
}

Eigen::VectorXd Model::residual(const State& state, const Eigen::VectorXd& acceleration, Workspace& workspace) const {
  Eigen::VectorXd out;
  residual(state, acceleration, workspace, out);
  return out;
}

void Model::residual(const State& state, const Eigen::VectorXd& acceleration, Workspace& workspace,
                     Eigen::VectorXd& r) const {
  workspace.load.setZero(modes());
  LoadSink sink(workspace.load);
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    forces_[k]->add_load(workspace.instant(state, k), sink);
    ++workspace.evaluations[k];
  }
  mass_times(state, acceleration, r);
  r -= workspace.load;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i) + 3;
    const Eigen::Vector3d omega = state.velocity.segment<3>(row);
    r.segment<3>(row) += omega.cross(inertia_in_world(bodies_[i], state.pose[i]) * omega);
  }
  for (int i = 0; i < modes(); ++i)
    if (!is_free(i)) r[i] = 0;
}

void Model::add_slopes(const State& state, double c_v, double c_q, Workspace& workspace, BlockMatrix& out) const {
  JacobianSink sink(out, c_q, c_v);
  for (std::size_t k = 0; k < forces_.size(); ++k) forces_[k]->add_jacobian(workspace.instant(state, k), sink);
  for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) {
    const Eigen::Matrix3d I =
        inertia_in_world(bodies_[static_cast<std::size_t>(i)], state.pose[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d omega = state.twist(i).tail<3>();
    out.block(i, i).bottomRightCorner<3, 3>() += c_v * (cross_matrix(omega) * I - cross_matrix(I * omega));
  }
}

void Model::tangent(const State& state, double c_a, double c_v, double c_q, Workspace& workspace,
                    BlockMatrix& out) const {
  out.set_zero();
  add_mass(state, c_a, out);
  if (c_v != 0 || c_q != 0) add_slopes(state, c_v, c_q, workspace, out);
  for (int i = 0; i < modes(); ++i) {
    if (is_free(i)) continue;
    for (const int j : pattern_.columns(i / 6)) {
      out.block(i / 6, j).row(i % 6).setZero();
      out.block(j, i / 6).col(i % 6).setZero();
    }
    out.block(i / 6, i / 6)(i % 6, i % 6) = 1;
  }
}

double Model::kinetic_energy(const State& state) const {
  Eigen::VectorXd momentum;
  return kinetic_energy(state, momentum);
}

double Model::kinetic_energy(const State& state, Eigen::VectorXd& momentum) const {
  mass_times(state, state.velocity, momentum);
  return 0.5 * state.velocity.dot(momentum);
}

Model::Linear Model::linear_of(const State& still, Counts counts) const {
  const auto assembled = [&](double c_v, double c_q) {
    BlockMatrix m(pattern_);
    JacobianSink sink(m, c_q, c_v);
    for (const auto& kind : forces_)
      if ((*kind.*counts)()) kind->add_jacobian({still, nullptr}, sink);
    return m.dense();
  };
  Linear out{assembled(0, 1), assembled(1, 0), {}, {}, {}};
  balance(still, counts, out);
  if (joints_.count() == 0) return out;
  BlockMatrix curvature(pattern_);
  joints_.add_curvature(still, out.multipliers, 1, curvature);
  out.stiffness += curvature.dense();
  return out;
}

// F = Gᵀλ + what is left, the least in the metric of M⁻¹, in which newtons and newton metres compare.
void Model::balance(const State& still, Counts counts, Linear& out) const {
  out.unbalanced = Eigen::VectorXd::Zero(modes());
  LoadSink sink(out.unbalanced);
  for (const auto& kind : forces_)
    if ((*kind.*counts)()) kind->add_load({still, nullptr}, sink);
  for (int m = 0; m < modes(); ++m)
    if (!is_free(m)) out.unbalanced[m] = 0;
  out.constraints.resize(0, modes());
  out.multipliers.resize(joints_.count());
  if (joints_.count() == 0) return;
  const std::vector<Gradient> G = joints_.gradients(still);
  out.constraints = joints_.dense(G);
  const Eigen::VectorXd root = dry_mass_at_rest().diagonal().cwiseSqrt();
  const Eigen::SPQR<SparseColumns> qr(sparse_columns(joints_, joints_.over(G, root), modes()));
  out.multipliers = qr.solve(Eigen::VectorXd(out.unbalanced.cwiseQuotient(root)));
  joints_.add_transposed(G, -out.multipliers, out.unbalanced);
}

Workspace::Workspace(const Model& model, State start)
    : state(std::move(start)),
      acceleration(Eigen::VectorXd::Zero(model.modes())),
      multipliers(Eigen::VectorXd::Zero(model.joints().count())),
      evaluations(model.forces().size(), 0),
      matrix(model.pattern()),
      solver(model.pattern(), model.joints()) {
  model.joints().count_turns(state);
  for (const auto& kind : model.forces()) memory.push_back(kind->make_memory(state));
}

void Workspace::accept() {
  for (auto& m : memory)
    if (m) m->accept(state);
}

}  // namespace dynamics
