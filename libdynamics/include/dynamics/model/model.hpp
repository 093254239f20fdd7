#pragma once
/// \file  A scene compiled: bodies, added mass and the kinds of force that act. Const, shared between threads.
/// All that changes is in Workspace, one per thread.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/joint.hpp"
#include "dynamics/model/kkt_solver.hpp"
#include "dynamics/state/block_matrix.hpp"
#include "dynamics/state/body.hpp"

namespace dynamics {

/// Added mass at infinite frequency of bodies that feel each other, about their centres of gravity, (6n, 6n),
/// symmetric.
struct AddedMass {
  std::vector<int> bodies;
  Eigen::MatrixXd value;
};

class Workspace;

/// The equations of motion (D8): (M(q) + A∞ + mass of the kinds of force (D40)) a + gyro(q, v) + Gᵀλ = Σ loads(t, q, v,
/// memory), with the modes that are not free left out, and the constraints g(q) = 0 of the joints. Integrators see
/// nothing else.
class Model {
 public:
  /// \throws hydro::InputError if mass plus added mass is not positive definite in the free modes, or as JointSet
  Model(std::vector<RigidBody> bodies, std::vector<AddedMass> added_mass,
        std::vector<std::unique_ptr<const ForceKind>> forces, std::vector<Joint> joints = {});

  const std::vector<RigidBody>& bodies() const { return bodies_; }
  const std::vector<std::unique_ptr<const ForceKind>>& forces() const { return forces_; }
  const BlockPattern& pattern() const { return pattern_; }
  const JointSet& joints() const { return joints_; }
  /// One sentence for each joint of which others, or locked modes, already hold a part at rest: that part is left out,
  /// and what it would carry cannot be told.
  const std::vector<std::string>& redundant() const { return redundant_; }
  int modes() const { return 6 * static_cast<int>(bodies_.size()); }
  bool is_free(int mode) const { return bodies_[static_cast<std::size_t>(mode / 6)].is_free(mode % 6); }

  /// M a + gyro − loads, without those of the joints; zero in modes that are not free, N and N m.
  Eigen::VectorXd residual(const State& state, const Eigen::VectorXd& acceleration, Workspace& workspace) const;
  /// The same, into a vector that has room: it asks for no memory of its own.
  void residual(const State& state, const Eigen::VectorXd& acceleration, Workspace& workspace,
                Eigen::VectorXd& out) const;
  /// ∂residual/∂a · c_a + ∂residual/∂v · c_v + ∂residual/∂q · c_q, unit rows and columns in modes that are not free.
  void tangent(const State& state, double c_a, double c_v, double c_q, Workspace& workspace, BlockMatrix& out) const;
  /// Adds factor · M, all of the mass in (D8); and the product of M with x.
  void add_mass(const State& state, double factor, BlockMatrix& out) const;
  Eigen::VectorXd mass_times(const State& state, const Eigen::VectorXd& x) const;
  void mass_times(const State& state, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// Mass of the bodies alone, (6N, 6N).
  Eigen::MatrixXd dry_mass(const State& state) const;
  Eigen::MatrixXd dry_mass_at_rest() const { return dry_mass(rest_state(bodies_)); }
  /// Kinetic energy of the bodies and of the water that moves with them, J.
  double kinetic_energy(const State& state) const;
  /// The same, with room for momenta.
  double kinetic_energy(const State& state, Eigen::VectorXd& momentum) const;
  /// The model for small motions about a state, of the kinds that are linear at rest and the joints (D17).
  struct Linear {
    Eigen::MatrixXd stiffness, damping;  ///< loads, joints' among them, ≈ −K δ − D v; (6N, 6N)
    Eigen::MatrixXd constraints;         ///< G, (m, 6N): G δ = 0
    Eigen::VectorXd multipliers;         ///< λ that carries what the loads ask of the joints there, (m)
    Eigen::VectorXd unbalanced;          ///< load that neither joints nor locked modes carry, (6N)
  };
  Linear linear_at_rest() const { return linear_at(rest_state(bodies_)); }
  /// The same about any state without velocities: `multipliers` balance what they can there.
  Linear linear_at(const State& still) const { return linear_of(still, &ForceKind::linear_at_rest); }
  /// The same of the kinds that act before a run begins, and as they act at the time of `still`.
  Linear linear_before_runs(const State& still) const { return linear_of(still, &ForceKind::acts_before_runs); }
  /// What its elements tell: motions of bodies, then each kind of force, then joints. For as long as the model stays
  /// where it is.
  std::vector<Signal> signals() const;
  /// "m1.heave": for messages.
  std::string mode_name(int mode) const;

 private:
  std::vector<RigidBody> bodies_;
  std::vector<AddedMass> added_mass_;
  std::vector<std::unique_ptr<const ForceKind>> forces_;
  BlockPattern pattern_;
  JointSet joints_;
  std::vector<std::string> redundant_;

  void add_slopes(const State& state, double c_v, double c_q, Workspace& workspace, BlockMatrix& out) const;
  void leave_out_redundant(const Eigen::VectorXd& scale);
  using Counts = bool (ForceKind::*)() const;
  Linear linear_of(const State& still, Counts counts) const;
  void balance(const State& still, Counts counts, Linear& out) const;
};

/// Everything of a run that changes.
class Workspace {
 public:
  Workspace(const Model& model, State start);

  State state;
  Eigen::VectorXd acceleration;                 ///< (6N), satisfies the equations of motion in `state`
  Eigen::VectorXd multipliers;                  ///< λ of the joints' constraints
  std::vector<std::unique_ptr<Memory>> memory;  ///< one a kind, null where it needs none
  std::vector<std::size_t> evaluations;         ///< of the load, one a kind: what a scene pays for
  Eigen::VectorXd load;                         ///< of all kinds, where a residual was asked for last
  BlockMatrix matrix;
  KktSolver solver;
  /// Room for what balances a state (ActiveSet::find_balance()), kept so that a step asks for no memory.
  struct Balancing {
    std::vector<Gradient> gradients, columns;
    Eigen::VectorXd still, residual, convective, left, open, minus_multipliers, acceleration, multipliers;
    KktSolver::Solution found;
  } balancing;

  /// The memory of that type; null if no kind has one.
  template <class OfKind>
  OfKind* find_memory() const {
    for (const auto& m : memory)
      if (auto* found = dynamic_cast<OfKind*>(m.get())) return found;
    return nullptr;
  }
  /// True if loads of a kind are no function of (t, state) alone.
  bool needs_memory(std::size_t kind) const { return memory[kind] && !memory[kind]->spares_work_only(); }
  Instant instant(const State& at, std::size_t kind) { return {at, memory[kind].get()}; }
  /// A signal of `model`, read now.
  double read(const Signal& signal, const Model& model) const {
    Memory* own = signal.kind ? memory[*signal.kind].get() : nullptr;
    return signal.value({state, acceleration, multipliers, model.joints().count(), own});
  }
  /// A full step has been completed: memory moves on.
  void accept();
};

}  // namespace dynamics
