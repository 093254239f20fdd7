#pragma once
/// \file  What pulls at the nodes of a line besides its segments and its bed: constant loads, forces by places and
/// velocities of nodes, water. (D73), (D74)
#include <Eigen/Core>

#include <limits>
#include <vector>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// Place, velocity and acceleration of all nodes at one instant.
struct Motion {
  double t;
  Eigen::Ref<const Places> x, v, a;
  const Places* water_at = nullptr;  ///< where the flow is taken that the nodes meet; null: where they are
};

/// How each of them changes with one unknown displacement of the same node.
struct By {
  double x, v, a;
};

/// 3 × 3 blocks of a matrix that joins neighbours: of node i itself, and of a segment in the row of its first node and
/// the column of its second, and the other way round.
struct Blocks {
  std::vector<Eigen::Matrix3d> diagonal, upper, lower;
  void set_zero(int nodes, int segments);
};

struct WaterPoint;
struct PerLength;

/// Powers of these loads, W.
struct LoadPowers {
  double damping = 0;                                  ///< taken by what acts on nodes by their velocities
  double drag_supplied = 0, drag_dissipated = 0;       ///< F·u and F·(u − w) (D46)
  double inertia_supplied = 0, buoyancy_supplied = 0;  ///< the latter of what is wet in part
  double load_supplied = 0;                            ///< by loads that are given over time

  /// Of a point of a segment.
  void add(const PerLength& c, const WaterPoint& point, bool lifted);
  void keep_state(hydro::StateBytes& bytes) {
    bytes.pass(damping, drag_supplied, drag_dissipated, inertia_supplied, buoyancy_supplied, load_supplied);
  }
};

/// Powers of all that acts, W; means over a step where the step has them.
struct Powers : LoadPowers {
  double axial = 0, bed = 0;  ///< dissipated
  double friction = 0;        ///< taken by the bed's shear, lost or stored
  double held = 0;            ///< supplied by what holds nodes
  void keep_state(hydro::StateBytes& bytes) {
    LoadPowers::keep_state(bytes);
    bytes.pass(axial, bed, friction, held);
  }
};

/// The water at a node: height of its surface above, m, velocity, and acceleration of the water itself.
struct Flow {
  double elevation = 0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), acceleration = Eigen::Vector3d::Zero();
};

/// Coefficients per length: ½ρC_D D, ½ρC_T πD, ρA, ρA C_A, and ρgA.
struct PerLength {
  double normal = 0, tangential = 0, displaced = 0, added = 0, lift = 0;
  PerLength(const Segment& s, const hydro::Water& water);
};

class Loads {
 public:
  explicit Loads(const Line& line);

  /// Adds to `force` (3, nodes) and, where asked, its derivative by the unknowns to `derivative`. Of the water only the
  /// flow's own change from place to place is left out of the derivative: it is small against m/h² (D78).
  void add(const Motion& now, const By& by, Places& force, Blocks* derivative);
  LoadPowers powers(const Motion& now);

  /// The parts of add() and powers(): the flow at the nodes is looked at before; then what acts at nodes alone, by
  /// their own laws and on spheres, and what acts along segments.
  void look_at_water(const Motion& now);
  void add_at_nodes(const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_powers_at_nodes(const Motion& now, LoadPowers& out);
  /// Adds the loads that are given over time at the instant t.
  void add_timed_loads(double t, Places& force) const;
  /// From here on they are those of the piece in which `t` lies, until they are told of another; they are those of
  /// each instant before the first call. (D150)
  void stay_in_piece_of(double t) { within_ = t; }
  double within() const { return within_; }
  bool are_wet() const { return line_.description().water.wet != Wet::nothing; }
  bool meet_water() const { return are_wet() || line_.has_bobs(); }
  /// Whether segments are lifted by as much of them as is wet.
  bool lifts_what_is_wet() const {
    return line_.description().water.buoyancy && line_.description().water.wet == Wet::below_surface;
  }
  /// Whether the water moves, ever.
  bool flow_changes() const { return meet_water() && !still_; }
  const std::vector<Flow>& flow() const { return flow_; }
  const PerLength& per_length(int segment) const { return per_length_[static_cast<std::size_t>(segment)]; }

  /// Whether the flow at nodes in `x` differs by more than 10⁻³ of the largest velocity, to first order, from the flow
  /// that was looked at last. (D78)
  bool flow_differs(const Places& x) const;

 private:
  void add_node_forces(const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_water(int j, const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_point(int j, const WaterPoint& p, const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_bobs(const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_bob_powers(const Motion& now, LoadPowers& out) const;

  const Line& line_;
  bool meets_water(int node) const;
  // The flow at nodes that meet it, kept while neither its instant nor its place changes.
  bool still_ = false;
  double within_ = std::numeric_limits<double>::quiet_NaN();     // s, of the piece of the loads over time
  double looked_at_ = std::numeric_limits<double>::quiet_NaN();  // s
  std::vector<Eigen::Vector3d> points_;
  std::vector<hydro::waves::Kinematics> water_;
  std::vector<Flow> flow_;
  std::vector<PerLength> per_length_;  // of wet segments
  struct {
    std::vector<int> nodes;
    std::vector<Eigen::Vector3d> points;
    std::vector<hydro::waves::Kinematics> water;
  } anew_;              // what of it is to be looked at
  Places node_forces_;  // force of it alone; kept, so that powers() asks for no memory
};

}  // namespace dynamics::line
