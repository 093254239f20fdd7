#pragma once
/// \file  A chain of nodes and straight segments: pendulums, droppers, cables and moorings. (D70)-(D76)
///
/// Nodes have Cartesian places, so that no direction is special. A segment is a rod without torsion: it keeps its
/// length (its tension is then what does so) or stretches by a law. n segments join n + 1 nodes, one after the other.
/// A network is several chains, one after the other in the same numbering, some of whose nodes are tied: they are one
/// place, and move as one. (D110)
#include <Eigen/Core>

#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "dynamics/line/node_force.hpp"
#include "dynamics/time/load_history.hpp"
#include "hydro/base/state_bytes.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace dynamics::line {

using Places = Eigen::Matrix3Xd;  ///< one column a node

/// From one node to the next.
struct Segment {
  double length;        ///< ℓ, unstretched, m, > 0
  double mass = 0;      ///< m, kg
  double centre = 0.5;  ///< of the mass: share of the length from the first node
  double inertia = 0;  ///< about that centre, across the axis, kg m²: mℓ²/12 of a uniform rod, mℓ²/4 of two half masses
  double axial_stiffness = std::numeric_limits<double>::infinity();  ///< EA, N; ∞: inextensible
  double axial_damping = 0;                                          ///< N per strain rate, N s
  double bending_stiffness = 0;                                      ///< EI, N m² (D106)
  bool tension_only = false;                                         ///< goes slack instead of being pressed
  bool catenary =
      false;            ///< hangs through between its nodes and rests on the bed in part, by its weight in water (D88)
  double diameter = 0;  ///< of what the water and the bed meet, m
  double cd = 0, cd_tangential = 0, ca = 0;  ///< drag across the axis and of the skin πD, added mass across (D74)
  bool meets_bed = true;                     ///< false: goes through the bed, if there is one

  /// A uniform rod, or half the mass at either end.
  static Segment rod(double length, double mass);
  static Segment bobs(double length, double mass);
  bool is_inextensible() const { return axial_stiffness == std::numeric_limits<double>::infinity(); }
};

/// Which part of something is taken as wet.
enum class Wet { nothing, all, below_surface };

/// What the water meets at a node: a float or sinker (D113), or a cylinder that stands for what hangs there (D153). Its
/// loads know no axis: they are the same from all sides.
struct Bob {
  double diameter = 0;         ///< m; 0: there is none
  double cd = 0, ca = 0;       ///< drag by its section, added mass by its volume
  double length = 0;           ///< of a cylinder, m; 0: a sphere
  bool by_component = false;   ///< drag of each component of the velocity by itself, which depends on the axes
  bool relative_only = false;  ///< no Froude–Krylov load: C_A ρV times the acceleration of the water past it
  Wet wet = Wet::all;          ///< of a cylinder all
  bool buoyancy = false;

  bool is_sphere() const { return length == 0; }
  /// Across the flow, m².
  double section() const { return is_sphere() ? std::numbers::pi / 4 * diameter * diameter : diameter * length; }
  double volume() const {  ///< m³
    return std::numbers::pi * diameter * diameter * (is_sphere() ? diameter / 6 : length / 4);
  }
};

/// A force that is given over time. (D150)
struct TimedForce {
  Eigen::Vector3d force;  ///< in full, global axes, N
  LoadHistory history = {};
};

struct Node {
  double mass = 0;                                  ///< a bob, clump or pin besides the segments' own, kg
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< constant, N
  Bob bob = {};
  std::vector<std::shared_ptr<const NodeForce>> forces = {};  ///< by its place and velocity, as NodeDamping
  double share = 1;                                           ///< of each of them that acts here
  std::vector<TimedForce> loads = {};                         ///< what they give is counted as supplied
};

/// Where a node is at each time, whatever pulls at it. Immutable.
class Path {
 public:
  struct Place {
    Eigen::Vector3d position, velocity, acceleration;
  };
  virtual ~Path() = default;
  virtual Place at(double t_s) const = 0;
};

/// A node with a prescribed path; it holds still without one.
struct Held {
  int node;
  std::shared_ptr<const Path> path = nullptr;
  /// Of an end: the direction, first node to last, in which the line is clamped there; zero: it turns freely. (D107)
  Eigen::Vector3d clamp = Eigen::Vector3d::Zero();
};

/// A level bed that pushes back at nodes under it, as an area of bed under each segment's diameter. (D75)
struct Bed {
  double z;             ///< m
  double stiffness;     ///< Pa per metre of depth, and of shear before it slips
  double damping;       ///< Pa per m/s, of shear too
  double friction = 0;  ///< μ: what lies on it is held by up to μ times its weight on it (D95)
};

/// The water and what of it acts.
struct Surroundings {
  std::shared_ptr<const hydro::waves::WaveField> field = nullptr;  ///< null: no water
  Wet wet = Wet::nothing;
  bool buoyancy = false;
};

/// What is given of a line.
struct Description {
  std::vector<Node> nodes;
  std::vector<Segment> segments;  ///< of each chain one fewer than nodes
  std::vector<Held> held;
  double gravity = 9.81;      ///< m/s²; 0: no weight
  std::vector<Bed> bed = {};  ///< none or one
  Surroundings water = {};
  std::vector<int> begins = {};             ///< of a network: the first node of each chain after the first
  std::vector<std::vector<int>> ties = {};  ///< sets of free nodes that are one place each
};

/// The force on each of k nodes with prescribed motion by what moves it, N, and its derivatives by places and
/// velocities of all of them, (3k, 3k), while the rest of the line follows. (D90)
struct Response {
  Places force;
  Eigen::MatrixXd by_place, by_velocity;
};

/// A line, checked, with its constant matrices. Immutable.
class Line {
 public:
  /// \throws hydro::InputError naming the node or segment whose numbers cannot be
  explicit Line(Description description);

  int nodes() const { return static_cast<int>(d_.nodes.size()); }
  int segments() const { return static_cast<int>(d_.segments.size()); }
  const Node& node(int i) const { return d_.nodes[static_cast<std::size_t>(i)]; }
  const Segment& segment(int j) const { return d_.segments[static_cast<std::size_t>(j)]; }
  const Description& description() const { return d_; }

  /// The node at which segment j begins; it ends at the next one.
  int first(int j) const { return first_[static_cast<std::size_t>(j)]; }
  /// The segment that begins at node i, or ends there; −1: none.
  int after(int i) const { return after_[static_cast<std::size_t>(i)]; }
  int before(int i) const { return i > 0 ? after(i - 1) : -1; }
  int chains() const { return static_cast<int>(d_.begins.size()) + 1; }
  int first_of_chain(int c) const { return c == 0 ? 0 : d_.begins[static_cast<std::size_t>(c - 1)]; }
  int last_of_chain(int c) const { return c + 1 == chains() ? nodes() - 1 : first_of_chain(c + 1) - 1; }
  /// The tie of node i; −1: it has none.
  int tie(int i) const { return tie_[static_cast<std::size_t>(i)]; }
  /// The first node of its tie, or the node itself.
  int same_as(int i) const { return tie(i) < 0 ? i : d_.ties[static_cast<std::size_t>(tie(i))].front(); }
  bool is_network() const { return !d_.ties.empty(); }
  /// Whether a step moves node i by itself: it is not held, and of its tie the first.
  bool moves(int i) const { return held(i) == nullptr && same_as(i) == i; }

  /// Null: free. Otherwise where node i is held, by its path or where it was at the start.
  const Held* held(int i) const {
    const int k = held_[static_cast<std::size_t>(i)];
    return k < 0 ? nullptr : &d_.held[static_cast<std::size_t>(k)];
  }
  /// The mass matrix (D71) is block-tridiagonal with m ⊗ 1: its diagonal, and what joins nodes j and j + 1, kg.
  double mass(int i) const { return diagonal_[i]; }
  double mass_between(int j) const { return between_[j]; }
  /// c of what bends at a node, N m: its moment by the change of direction there. (D106)
  double bending(int i) const { return bending_[i]; }
  bool bends() const { return hardest_bending_ > 0; }
  /// Of c over squares of the lengths beside it, N/m.
  double hardest_bending() const { return hardest_bending_; }
  /// Weight in water of a catenary segment, N/m.
  double sag_weight(int j) const { return sag_weight_[j]; }
  /// Weight, buoyancy of what is always wet, and the given constant load of each node, N.
  const Places& constant_load() const { return constant_; }
  /// Area of bed under a node, m²: diameter times half of each segment beside it that meets the bed.
  double bed_area(int i) const { return bed_area_[i]; }
  bool has_bobs() const { return bobs_; }
  bool has_timed_loads() const { return timed_loads_; }
  /// Of the histories of loads on nodes, the first corner after t; ∞: there is none. (D150)
  double next_corner(double t) const;
  /// True if the bed has friction. (D95)
  bool rubs_on_bed() const { return !d_.bed.empty() && d_.bed.front().friction > 0; }
  bool has_massless_nodes() const;
  double length() const;

 private:
  void find_chains();
  void find_held();
  void find_ties();
  void find_bending();
  void add_node(int i);
  void add_segment(int j);
  Description d_;
  std::vector<int> held_;                 // index into d_.held, −1: free
  std::vector<int> first_, after_, tie_;  // −1: none
  Eigen::VectorXd diagonal_, between_, bed_area_, sag_weight_, bending_;
  double hardest_bending_ = 0;
  bool bobs_ = false, timed_loads_ = false;
  Places constant_;
};

/// Where a line is and how it moves.
struct State {
  double time = 0;
  Places position, velocity;   ///< tied nodes each have their own columns, which are the same
  Eigen::VectorXd tension;     ///< of each segment, N, > 0 pulls
  Eigen::Matrix2Xd grip = {};  ///< x and y at which a bed with friction holds each node, m; empty: where it starts
  void keep_state(hydro::StateBytes& bytes) { bytes.pass(time, position, velocity, tension, grip); }
};

/// Direction of the link that begins at node `first`, as Huijgen 2024 has it (eqs. 4.3-4.5): d = ℓ (cos θ cos φ, cos θ
/// sin φ, −sin θ).
struct LinkAngles {
  double polar;    ///< θ from the horizontal, positive down, −π/2 … π/2
  double azimuth;  ///< φ from x towards y, −π … π; of a vertical link 0
};
LinkAngles link_angles(const State& state, int first);

/// The same where a record begins: with the azimuth within ±π/2, so that links of one plane are counted alike. Towards
/// −x the polar angle lies beyond ±π/2: π towards −x itself (D134).
LinkAngles first_link_angles(const State& state, int first);

/// The same with the branch (θ, φ) or (π − θ, φ + π), and the turn, that is nearest to `before`: series without jumps
/// (D134). Of a vertical link the azimuth stays.
LinkAngles link_angles(const State& state, int first, const LinkAngles& before);

/// Rates of those angles, rad/s, for a link whose angles are `now` (of either branch). Of a vertical link the polar
/// rate is that in the plane of the azimuth, which has none: 0.
LinkAngles link_rates(const State& state, int first, const LinkAngles& now);

}  // namespace dynamics::line
