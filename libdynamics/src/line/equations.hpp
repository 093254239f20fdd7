#pragma once
/// \file  The equations of a line at one instant or over one step, and Newton's method on them. (D70), (D72)-(D80)
#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

#include "band_matrix.hpp"
#include "loads.hpp"
#include "network_solver.hpp"
#include "sag.hpp"

namespace dynamics::line {

/// What a step asks: balance at an instant t at which place, velocity and acceleration follow from the displacement u
/// of the step, x = x₀ + x_by u, v = v_from + v_by u, a = a_from + a_by u. Held nodes move as their paths say. With
/// x_by = v_by = 0 it is one instant, u is what is added to its accelerations, and lengths are kept by those.
struct Stage {
  double t, end, h;  ///< of the balance; of the step's end; its duration, s
  double x_by, v_by, a_by;
  Places v_from, a_from;
  bool mean = false;        ///< pulls as the means over the step (D79), else as they are at its end
  bool still = false;       ///< at rest: no masses, held nodes without velocity (D86)
  double relax = 0;         ///< (relax) u resists: steps towards rest, N/m
  double rounding = 1e-14;  ///< of places, below which no correction means anything, relative to the farthest
  bool foreseen = false;    ///< the flow is that at places that are known before the step (D78), else where nodes are
  Places water_at = {};     ///< those places, if so

  void set(double of_balance, double of_end, double duration) {
    t = of_balance;
    end = of_end;
    h = duration;
  }
  void set_factors(double x, double v, double a) {
    x_by = x;
    v_by = v;
    a_by = a;
  }
};

/// Makes `out` the balance of a state with accelerations a: an instant, which it asks no memory for once it has room.
/// `flow_of`: a stage that ended there, whose flow it then has; null: the flow where nodes are.
void set_instant(const State& state, const Places& a, const Stage* flow_of, Stage& out);

class Equations {
 public:
  struct Outcome {
    bool converged = false;
    int iterations = 0, worst = 0;  ///< the node whose balance is worst
    double size = 0;                ///< of what is left over, m
    std::string why = {};
  };

  explicit Equations(const Line& line);

  /// Solves for u and T from the guesses given. `tolerance`: of the last correction, relative to u and T. Where nodes
  /// come to lie too far from the places at which the stage foresees the flow, these are moved to them.
  Outcome solve(Stage& stage, const State& before, double tolerance, int most, Places& u, Eigen::VectorXd& T);

  /// Which piece of the loads over time acts. (D150)
  void stay_in_piece_of(double t) { loads_.stay_in_piece_of(t); }
  double within() const { return loads_.within(); }

  /// Whether the energy of what a step towards rest leads to, with (relax + margin)|u|²/2, is least there: pressed
  /// links could give way otherwise. Of loads that have no energy the symmetric part of their change counts. (D157)
  bool is_least(const Stage& stage, const State& before, const Places& u, const Eigen::VectorXd& T, double margin);

  /// Accelerations and tensions of a state (D77), in the flow that set_instant() has. False if masses leave them open.
  bool accelerations(const State& state, Places& a, Eigen::VectorXd& T, const Stage* flow_of = nullptr);

  /// Takes from v what changes lengths that are kept, the least in the metric of the masses. (D82)
  bool project_velocity(const State& state, Places& v);
  /// Moves x along the directions of `from` until lengths are kept.
  bool project_place(const Places& from, double tolerance, Places& x);

  /// The force that each node is held by where solve() ended last, N; next to nothing for free ones.
  const Places& needed() const { return needed_; }

  /// What nodes with prescribed motion need at the end of a step with places u and tensions T, and how it follows them
  /// while the rest of the line moves as the step has it; their accelerations follow their velocities by `a_by_v`.
  /// (D90) The answer stands until the next one.
  const Response& response(const Stage& stage, const State& before, const Places& u, const Eigen::VectorXd& T,
                           const std::vector<int>& prescribed, double a_by_v);

  /// What held nodes need besides loads and pulls, N.
  void find_holding(const State& state, const Places& a, const Eigen::VectorXd& T, Places& out,
                    const Stage* flow_of = nullptr);

  Powers powers(const Stage& stage, const State& before, const Places& u, const Eigen::VectorXd& T);
  /// Stored in stretched segments, and in the bed, J.
  double stored_in_segments(const State& state);
  double stored_in_bed(const State& state) const;
  double stored_in_bending(const State& state) const;
  /// Of the bed's shear under a state, J. (D95)
  double stored_in_shear(const State& state) const;
  /// Where the bed holds nodes after the step that powers() looked at last. (D95)
  void take_grip(State& state) const;
  double kinetic(const Places& v) const;

 private:
  static constexpr double undetermined = 1e-13;

  /// One segment's pull T n on its first node (and −T n on its second), and what its law leaves open, m.
  struct Pull {
    Eigen::Vector3d direction;
    Eigen::Matrix3d direction_by;  ///< by the vector from first to second node at the end of the step
    double law, law_by_T;
    Eigen::Vector3d law_by;
    double lost = 0;  ///< by its damper, W
    Sag sag = {};     ///< of a catenary segment; by_height and by_level in the law come on top of law_by
    Eigen::Vector3d level_by = Eigen::Vector3d::Zero();  ///< of cos² of the slope by that vector
  };
  void add_sag_derivatives(int j, const Pull& p, const Stage& stage);
  void sag(int j, double T, Pull& p) const;
  double tension_of_sag(int j, const Stage& stage, const State& before) const;
  /// The bed's force up on a node, N, its derivative by the node's depth at the end of the step, and what it takes, W.
  struct Push {
    double force, by_end, lost;
  };
  int tension_index(int segment) const { return 4 * (line_.first(segment) + 1); }
  static int place_index(int node) { return 4 * node + 1; }
  void move(const Stage& stage, const State& before, const Places& u);
  Pull pull(int j, const Stage& stage, const State& before, double T) const;
  void find_columns(const std::vector<int>& prescribed, Eigen::Ref<BandMatrix::Columns> out);
  void add_rows_times(const std::vector<int>& prescribed, const BandMatrix::Columns& y, Eigen::MatrixXd& out);
  void find_columns_of_motion(const Stage& stage, const Eigen::VectorXd& T, const std::vector<int>& prescribed,
                              double a_by_v);
  void follow(double v_by, double a_by, const Eigen::VectorXd& T);
  bool solve_columns();
  /// From the first to the second node of a segment, of places or velocities.
  Eigen::Vector3d along(const Places& x, int j) const { return x.col(line_.first(j) + 1) - x.col(line_.first(j)); }
  void keep_held();
  void add_up_ties();
  void add_mass(const Places& a);
  void add_bed(const Stage& stage, const State& before, bool matrix);
  double shear_stiffness(int i) const { return line_.description().bed.front().stiffness * line_.bed_area(i); }
  double weight_on_bed(int i) const;
  void add_friction(const Stage& stage, const State& before, bool matrix);
  void add_slip_derivatives(int i, const Eigen::Vector2d& along);
  void add_bending(const Stage& stage, bool matrix);
  void add_pulls(const Stage& stage, const State& before, const Eigen::VectorXd& T, bool matrix);
  double assemble(const Stage& stage, const State& before, const Places& u, const Eigen::VectorXd& T, bool matrix);
  Push bed(int i, const Stage& stage, const State& before) const;
  void fill(double mass_by, double relax);
  void add_block(int row, int column, const Eigen::Matrix3d& block);
  void set_pull(int j, const Eigen::Vector3d& direction);
  bool solve_linear(Places& u, Eigen::VectorXd& T);
  struct Correction {
    Places u;
    Eigen::VectorXd T;
  };
  void scale_for(const Stage& stage, const Eigen::VectorXd& T);
  Outcome newton(const Stage& stage, const State& before, double tolerance, int most, Places& u, Eigen::VectorXd& T);
  Motion motion(const Stage& stage) const;
  double search(const Stage& stage, const State& before, double size, bool enough, bool last, Places& u,
                Eigen::VectorXd& T);
  int worst_node() const;
  double told(const Stage& stage) const;
  void scale_by_mass();
  void assemble_projection(const Places& along, const Places& x);

  const Line& line_;
  Loads loads_;
  BandMatrix matrix_;
  std::unique_ptr<NetworkSolver> network_;  // null for a single chain
  Eigen::VectorXd rhs_, law_;
  Blocks blocks_;
  Places x_, v_, a_, force_, residual_, needed_;
  std::vector<Push> push_;              // of the bed, each node
  std::vector<Sag> sag_;                // each segment
  Eigen::Matrix2Xd friction_, strain_;  // on each node, N, and what the bed has given way under it, m; empty without
  bool any_inextensible_ = false, any_catenary_ = false;
  // What is made on the way, kept from call to call, so that a step asks for no memory.
  Correction by_, from_;  // Newton's, and what it is added to
  Places none_, whole_;   // zeros; what is left over with all that acts
  Stage instant_;
  State still_;
  struct {
    Stage here;
    State end;
    BandMatrix::Columns by, y;  // by what the prescribed nodes do; what the rest of the line does then
    BandMatrix matrix;
    Eigen::MatrixXd of_rest, total;  // of the force on the prescribed nodes
    Response found = {};
  } follow_;
  double scale_ = 1;  // what makes newtons and metres comparable, N/m
  double met_ = 0;    // m: what is left of a kept length and asks for no correction
};

}  // namespace dynamics::line
