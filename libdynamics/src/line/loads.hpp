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
  const Places &x, &v, &a;
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

/// Powers of these loads, W.
struct LoadPowers {
  double damping = 0;                                  ///< taken by what acts on nodes by their velocities
  double drag_supplied = 0, drag_dissipated = 0;       ///< F·u and F·(u − w) (D46)
  double inertia_supplied = 0, buoyancy_supplied = 0;  ///< the latter of what is wet in part
};

class Loads {
 public:
  explicit Loads(const Line& line) : line_(line) {}

  /// Adds to `force` (3, nodes) and, where asked, its derivative by the unknowns to `derivative`. Of the water only the
  /// flow's own change from place to place is left out of the derivative: it is small against m/h² (D78).
  void add(const Motion& now, const By& by, Places& force, Blocks* derivative);
  LoadPowers powers(const Motion& now);

  /// Whether the flow at nodes in `x` differs by more than 10⁻³ of the largest velocity, to first order, from the flow
  /// that was looked at last. (D78)
  bool flow_differs(const Places& x) const;

 private:
  void look_at_water(const Motion& now);
  void add_node_forces(const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_water(int j, const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_spheres(const Motion& now, const By& by, Places& force, Blocks* derivative) const;
  void add_sphere_powers(const Motion& now, LoadPowers& out) const;

  const Line& line_;
  bool meets_water(int node) const;
  // The flow at nodes that meet it, kept while neither its instant nor its place changes.
  double looked_at_ = std::numeric_limits<double>::quiet_NaN();  // s
  std::vector<Eigen::Vector3d> points_;
  std::vector<hydro::waves::Kinematics> water_;
  struct {
    std::vector<int> nodes;
    std::vector<Eigen::Vector3d> points;
    std::vector<hydro::waves::Kinematics> water;
  } anew_;              // what of it is to be looked at
  Places node_forces_;  // force of it alone; kept, so that powers() asks for no memory
};

}  // namespace dynamics::line
