#pragma once
/// \file  Everything that holds bodies at one time: joints, frictions that stick, contacts that are closed.
#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

#include "dynamics/force/contact_law.hpp"
#include "dynamics/force/friction_law.hpp"
#include "dynamics/model/model.hpp"

namespace dynamics {

/// The constraints of the joints come first, then one for each friction that sticks, then the normal of each contact
/// that is closed and, if it sticks, its directions along the surface.
class ActiveSet {
 public:
  explicit ActiveSet(const Model& model);
  /// The same constraints, with factors of its own.
  ActiveSet(const ActiveSet& other);

  const FrictionLaw* friction() const { return friction_; }
  const ContactLaw* contact() const { return contact_; }
  bool may_change() const { return friction_ != nullptr || contact_ != nullptr; }
  FrictionMemory& friction_memory(Workspace& workspace) const;
  ContactMemory& contact_memory(Workspace& workspace) const;

  /// Takes up what the memories say, where the bodies are now; the workspace's solver with it.
  void rebuild(Workspace& workspace);
  const JointSet& constraints() const { return constraints_; }
  /// Loads are −columns · λ: G, and friction along with the normal of a contact that slides, against its slip in
  /// `state` (D24).
  std::vector<Gradient> columns(std::vector<Gradient> G, const State& state) const {
    add_sliding(state, G);
    return G;
  }
  /// Makes G these columns.
  void add_sliding(const State& state, std::vector<Gradient>& G) const;
  /// Adds by_speed times the derivative of that friction by the velocities that turn its direction.
  void add_turning(const State& state, const Eigen::VectorXd& multipliers, double by_speed, BlockMatrix& out) const;
  /// Accelerations and multipliers in a state: G a = −Ġ v (D16).
  struct Balance {
    Eigen::VectorXd acceleration, multipliers;
  };
  /// Of the workspace's state; none if they cannot be had.
  std::optional<Balance> balance(Workspace& workspace) const;
  /// The same, into vectors that have room. \returns false if they cannot be had
  bool find_balance(Workspace& workspace, Eigen::VectorXd& acceleration, Eigen::VectorXd& multipliers) const;
  /// Takes them into the workspace. \returns false if they cannot be had
  bool solve_accelerations(Workspace& workspace) const;
  /// The same. \throws hydro::NumericsError with the time if they cannot be had
  void require_accelerations(Workspace& workspace) const;

  /// √ of the diagonal of mass plus added mass: makes newtons and newton metres comparable.
  const Eigen::VectorXd& scale() const { return scale_; }
  /// √ of the mass that each constraint moves.
  const Eigen::VectorXd& constraint_scale() const { return constraint_scale_; }
  /// That mass for each constraint; of closed contacts the least of any between the same two bodies, so that their
  /// loads over it compare as those of equal pads, wherever these are.
  const Eigen::VectorXd& mass_of_loads() const { return mass_of_loads_; }
  /// Of closed contacts, which may be more than needed to hold a body: a small inverse mass, for Newton's matrix alone,
  /// by which they share the load evenly (D24). Zero for joints.
  const Eigen::VectorXd& compliance() const { return compliance_; }
  /// Of a place computed from the bodies' positions, m.
  double rounding() const { return rounding_; }

 private:
  void close(std::size_t element, Workspace& workspace);
  bool moves(const Constraint& constraint, const State& state) const;
  void find_constraint_scale(const State& state);
  void find_mass_of_loads(Workspace& workspace);
  void find_pairs();
  bool add_correction(Workspace& workspace, Eigen::VectorXd& acceleration, Eigen::VectorXd& multipliers) const;
  bool balanced_by_kept(Workspace& workspace, Eigen::VectorXd& acceleration, Eigen::VectorXd& multipliers) const;

  struct Slide {
    Eigen::Index row;  ///< of the normal
    std::size_t element;
    Eigen::Vector3d start;  ///< direction of slip where the step begins, global
  };
  Eigen::Vector3d direction(const Slide& slide, const State& state) const;
  const Model& model_;
  const FrictionLaw* friction_ = nullptr;
  const ContactLaw* contact_ = nullptr;
  std::size_t friction_index_ = 0, contact_index_ = 0;  // among the model's forces
  JointSet constraints_;
  std::vector<Slide> slides_;
  std::vector<std::size_t> first_of_pair_;  // of each contact: the first between the same two bodies
  Eigen::VectorXd least_of_pair_;
  Eigen::VectorXd scale_, constraint_scale_, mass_of_loads_, compliance_;
  // Factors of masses and constraints, apart from those of the workspace, which are of steps. Its `of_step` is 1 while
  // there are any.
  std::unique_ptr<KktSolver> balancer_;
  double rounding_ = 0;
};

}  // namespace dynamics
