#pragma once
/// \file  Joints: bodies that keep points or directions together, exactly, whatever the forces.
///
/// A joint is a few constraints g(q) = 0 with multipliers λ: loads −Gᵀλ on the bodies, G = ∂g/∂q. All kinds are made of
/// two types of constraint, (D13) and (D14), so each has one value, one gradient and one curvature to check. A contact
/// that is closed is a third type, (D23).
#include <Eigen/Core>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/spatial/shape.hpp"
#include "dynamics/state/block_matrix.hpp"
#include "dynamics/state/body.hpp"
#include "dynamics/state/point.hpp"
#include "dynamics/state/signal.hpp"

namespace dynamics {

enum class JointKind {
  fixed,      ///< nothing moves
  hinge,      ///< turns about the axis
  universal,  ///< turns about the axis, which the first body holds, and about `second_axis`, which the second holds
  ball,       ///< turns freely about the point
  slider,     ///< slides along the axis of the first body, turns about nothing
  planar      ///< slides across the axis of the first body and turns about it
};
std::string name_of(JointKind kind);

/// Where a prescribed motion has the second body of its joint, seen from the first, at one time: m or rad, per second,
/// per second².
struct PrescribedState {
  double coordinate, rate, acceleration;
};
/// PrescribedState::coordinate is twice differentiable, and the others are its derivatives.
using PrescribedMotion = std::function<PrescribedState(double time_s)>;

/// A joint, described where the bodies are at rest.
struct Joint {
  std::string name;
  JointKind kind;
  int first;
  std::optional<int> second;                               ///< empty: the ground
  Eigen::Vector3d place;                                   ///< global, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();         ///< global, any length
  Eigen::Vector3d second_axis = Eigen::Vector3d::UnitY();  ///< global, across `axis`; of universal joints
  PrescribedMotion prescribed = {};                        ///< of sliders and hinges whose coordinate is given (D31)
  double sign = 1;  ///< −1 where its signals count the coordinate of the first against the second
};

class JointCoordinate;

/// The place of a joint in the frames of its two bodies.
struct JointArms {
  Eigen::Vector3d first, second;
};
JointArms arms_at_rest(const std::vector<RigidBody>& bodies, const Joint& joint);

/// A direction n that keeps d, from the first body's point to the second's, at zero: g = n·d (D13).
struct PointConstraint {
  Eigen::Vector3d first_arm, second_arm;  ///< in the frame of the first, of the second
  Eigen::Vector3d direction;              ///< n, unit; global, or along the first body's axes if `turns`
  bool turns;
};
/// Directions u of the first body and v of the second that stay across each other: g = u·v (D14).
struct AxesConstraint {
  Eigen::Vector3d first_axis, second_axis;  ///< u, v, along the axes of either frame
};

/// Shapes of the two bodies that touch: g is the gap between them (D23).
struct GapConstraint {
  Shape first, second;  ///< in the frame of the first, of the second
};

/// Where the shapes touch, the second does not slip over the first along a direction: a constraint on velocities alone,
/// so that round shapes may roll (D24).
struct StickConstraint {
  GapConstraint shapes;
  Eigen::Vector3d direction;  ///< along the surface, global, unit
};

/// The coordinate of a slider or hinge is what is prescribed: g = s(q) − s(t) (D31).
struct PrescribedConstraint {
  std::shared_ptr<const JointCoordinate> coordinate;
  PrescribedMotion motion;
};
using ConstraintLaw =
    std::variant<PointConstraint, AxesConstraint, GapConstraint, StickConstraint, PrescribedConstraint>;

/// A constraint between two bodies, or a body and the ground. Its numbers stand in the frames of these (frame_of()).
struct Constraint {
  int joint, first;
  std::optional<int> second;  ///< empty: the ground
  ConstraintLaw what;
};

/// G of one constraint, by translation and small global rotation of its two bodies.
struct Gradient {
  Vector6 first, second;
};
Vector12 joined(const Gradient& g);

/// Length of both rows together.
double norm(const Gradient& g);

/// One of the two bodies of a joint.
enum class End { first, second };

/// All joints of a model.
class JointSet {
 public:
  JointSet() = default;
  /// \throws hydro::InputError for a body that is not there, a body joined to itself, an axis of no length, axes of a
  /// universal joint that are not across each other, a prescribed motion of a joint that is neither slider nor hinge
  JointSet(const std::vector<RigidBody>& bodies, std::vector<Joint> joints);

  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Constraint>& constraints() const { return constraints_; }
  Eigen::Index count() const { return static_cast<Eigen::Index>(constraints_.size()); }
  /// Leaves out constraints that others already hold; `keep` has one entry for each constraint.
  void reduce(const std::vector<bool>& keep);
  /// The same bodies, joined by this constraint alone; by nothing if there is none.
  JointSet with_only(std::optional<Constraint> constraint) const;

  void couple(BlockPattern& pattern) const;
  /// True for a constraint on velocities, G v = 0, which no g belongs to.
  bool is_on_velocity(Eigen::Index constraint) const {
    return std::holds_alternative<StickConstraint>(constraints_[static_cast<std::size_t>(constraint)].what);
  }
  /// g, (count): metres, and sines of angles; zero for constraints on velocities.
  Eigen::VectorXd values(const State& state) const;
  /// The same, into a vector that has room.
  void find_values(const State& state, Eigen::VectorXd& g) const;
  /// Columns of modes that are not free are zero.
  std::vector<Gradient> gradients(const State& state) const;
  /// The same, into rows that have room.
  void find_gradients(const State& state, std::vector<Gradient>& G) const;
  /// Of a constraint between the same bodies, whether it is one of the set or not; and what convective() has of it.
  Gradient gradient_of(const Constraint& constraint, const State& state) const;
  double convective_of(const Constraint& constraint, const State& state) const;
  /// Rows over the numbers that belong to their modes, such as √ of masses; of the ground zero.
  std::vector<Gradient> over(const std::vector<Gradient>& G, const Eigen::VectorXd& scale) const;
  /// G x, for x a velocity or displacement of all bodies.
  Eigen::VectorXd times(const std::vector<Gradient>& G, const Eigen::VectorXd& x) const;
  /// One row of it.
  double times(Eigen::Index constraint, const Gradient& row, const Eigen::VectorXd& x) const;
  /// Adds Gᵀ λ.
  void add_transposed(const std::vector<Gradient>& G, const Eigen::VectorXd& lambda, Eigen::VectorXd& out) const;
  /// G, (count, 6N).
  Eigen::MatrixXd dense(const std::vector<Gradient>& G) const;
  /// Adds factor · ∂(Gᵀλ)/∂q (D15).
  void add_curvature(const State& state, const Eigen::VectorXd& lambda, double factor, BlockMatrix& out) const;
  /// Ġ v − s̈(t), (count): the acceleration that the constraints have without any of the bodies'.
  Eigen::VectorXd convective(const State& state) const;
  /// The same, into a vector that has room.
  void find_convective(const State& state, Eigen::VectorXd& out) const;
  bool are_prescribed() const;  ///< one of them at least
  /// ṡ(t), (count): what G v is while the joints stay closed; zero but for prescribed motions.
  Eigen::VectorXd prescribed_rates(double time) const;
  /// λ·ṡ(t): what prescribed motions take, W. `lambda` may go on with multipliers that are not the joints'.
  double prescribed_power(const Eigen::VectorXd& lambda, double time) const;
  /// Load of the joint on one of its bodies: force and moment about the joint's place in that body, in that body's
  /// axes, N and N m. What redundant constraints would carry is not in it. The second body must not be the ground.
  Vector6 load_on(int joint, End end, const State& state, const Eigen::VectorXd& lambda) const;
  /// How each of the six components of load_on() varies where the bodies are still: with their displacements while
  /// `lambda` acts, and with λ.
  std::vector<Variation> load_variations(int joint, End end, const State& still, const Eigen::VectorXd& lambda) const;
  /// Where the joint lets its second body (or the ground) move against the first: the stroke of a slider along the
  /// axis, m, or the angle of a hinge about it, rad, whole turns counted (D133). Zero at rest. For sliders and hinges
  /// only.
  double coordinate(int joint, const State& state) const;
  /// JointCoordinate of sliders and hinges, "hinge.angle", and loads on each body, "hinge.m1.force_x"; `bodies`: those
  /// that it was made of. For as long as the set stays where it is.
  std::vector<Signal> signals(const std::vector<RigidBody>& bodies) const;
  /// Counts on: the angles of hinges and of bodies in `state`, less than half a turn from those that it has counted
  /// last; those of hinges with prescribed motion, from their prescribed angles.
  void count_turns(State& state) const;
  /// The hinge whose angle changes too fast to be counted after h seconds, half a turn or more; empty if all can be.
  std::optional<int> turns_too_fast(const State& state, double h) const;
  /// Sets to zero what stands in modes that are not free.
  void keep_free(int first, std::optional<int> second, Gradient& row) const;
  /// Adds a constraint that belongs to no joint's own.
  void add(Constraint constraint) { constraints_.push_back(std::move(constraint)); }
  /// Takes out all constraints but the first; their room stays.
  void cut(Eigen::Index count) { constraints_.erase(constraints_.begin() + count, constraints_.end()); }

 private:
  JointCoordinate coordinate_of(int joint) const;
  Signal coordinate_signal(int joint) const;
  std::vector<Signal> load_signals(int joint, End end, const std::string& body) const;
  std::vector<Joint> joints_;
  std::vector<Constraint> constraints_;
  std::vector<JointArms> arms_;            // one a joint
  std::vector<std::array<bool, 6>> free_;  // one a body
};

}  // namespace dynamics
