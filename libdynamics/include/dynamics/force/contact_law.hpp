#pragma once
/// \file  What an integrator asks of a kind of force whose elements touch and part. (D23)-(D26)
#include <array>
#include <string>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/constraints.hpp"

namespace dynamics {

/// Two shapes of two bodies, in their frames (frame_of()), that do not pass through each other (D23)-(D25).
struct Contact {
  std::string name;
  int first;
  std::optional<int> second;  ///< empty: the ground
  GapConstraint shapes;
  double restitution = 0;  ///< e, of the approach along the normal that comes back; 0 … 1
  double friction = 0;     ///< μ, of the load along the normal; 0: smooth
};

/// What a contact does at present, and what it has done.
struct ContactState {
  enum Is { open, slides, sticks };
  Is is = open;
  Eigen::Index row = -1;  ///< of its normal among an integrator's multipliers; −1: none
  int held = 0;           ///< directions along the surface that follow it there, while it sticks
  Eigen::Vector3d slip = {0, 0,
                          0};  ///< direction in which the second slips over the first, global; of a contact that slides
  std::size_t impacts = 0;
  double dissipated = 0;  ///< J, by impacts and slip, since the start

  void keep_state(hydro::StateBytes& bytes) { bytes.pass(is, row, held, slip, impacts, dissipated); }
};

class ContactMemory final : public Memory {
 public:
  explicit ContactMemory(std::size_t count) : contact(count) {}
  void accept(const State&) override {}  // an integrator changes it where an event is
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override { bytes.pass(contact, supplied_by_joints); }
  std::vector<ContactState> contact;
  double supplied_by_joints = 0;  ///< J, by the impulses of joints with a prescribed motion in impacts, since the start
};

/// The set-valued law of a kind of force, ForceKind::contact(), whose memory is a ContactMemory: the geometry of its
/// elements. Their loads are multipliers of an integrator, which adds a constraint for each contact that is closed.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;
  virtual std::size_t elements() const = 0;
  virtual const Contact& element(std::size_t i) const = 0;

  virtual ClosestPoints closest_points(std::size_t element, const State& state) const = 0;
  double gap(std::size_t element, const State& state) const { return closest_points(element, state).gap; }
  /// How the points that are closest move against each other, the second's seen from the first's.
  struct Motion {
    ClosestPoints closest_points;
    double parting;        ///< along the normal, m/s: the rate of the gap
    Eigen::Vector3d slip;  ///< across it, m/s, global
  };
  virtual Motion motion(std::size_t element, const State& state) const = 0;
  /// Shapes that are apart at both ends of a step but were not between: the share of the step at which they are first
  /// seen to overlap (D131). Nothing if they did not, or moved against each other by less than half their thickness.
  virtual std::optional<double> passing(std::size_t element, const State& before, const State& after) const = 0;
  /// The constraint that keeps the gap at zero.
  virtual Constraint closed(std::size_t element) const = 0;
  /// Two constraints that keep what touches from slipping along the surface, in directions across its normal in
  /// `state`.
  virtual std::array<Constraint, 2> sticking(std::size_t element, const State& state) const = 0;
  /// How the points that touch in `state` move along a direction of the surface.
  virtual Gradient along(std::size_t element, const Eigen::Vector3d& direction, const State& state) const = 0;
  /// Load along the normal, >= 0, N, from the multipliers of an integrator.
  virtual double load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers) const = 0;
};

}  // namespace dynamics
