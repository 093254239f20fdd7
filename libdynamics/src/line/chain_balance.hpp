#pragma once
/// \file  The balance of a chain of segments that stretch, and its derivatives by places, velocities and accelerations
/// apart, as a linearly implicit step needs them. (D138)
#include <Eigen/Core>

#include <vector>

#include "block_tridiagonal.hpp"
#include "loads.hpp"
#include "sag.hpp"
#include "triple.hpp"

namespace dynamics::line {

/// Places, velocities, accelerations and tensions of a chain at one time.
struct Instant : Motion {
  Eigen::Ref<const Eigen::VectorXd> T;
};

/// R = M a − F − Σ T t of each node (3, nodes), N, and the law g of each segment, m, both zero in balance: those of
/// (D70), (D72)-(D75), (D88).
struct Balance {
  Places force;
  Eigen::VectorXd law;
};

class ChainBalance {
 public:
  /// For a line that unfit() has nothing against.
  explicit ChainBalance(const Line& line);

  /// Why this line has no such balance, with the remedy; empty if it has.
  struct Unfit {
    std::string why, remedy;
  };
  static Unfit unfit(const Line& line);

  void evaluate(const Instant& now, Balance& out);
  /// The same, and its derivatives, which stay until the next call; and the powers.
  void linearise(const Instant& now, Balance& out, Powers& powers);
  /// Derivatives by time where nodes and water stay and only what is prescribed moves on, by a difference over `dt`.
  /// `now` was linearised, with `balance`.
  void differentiate_by_time(const Instant& now, const Balance& balance, double dt, Balance& out);

  /// Makes ready for solve() with velocities that follow places by `by`, 1/s, and accelerations by its square.
  /// \returns false where that has no solution
  bool factorise(double by);
  /// Adds the derivatives by velocities times `v` and by accelerations times `a`.
  void add_rates(const Eigen::Ref<const Places>& v, const Eigen::Ref<const Places>& a, Balance& out) const;
  /// Places and tensions that make `right` of the derivatives. Overwrites `right`. Held nodes stay.
  void solve(Balance& right, Eigen::Ref<Places> x, Eigen::Ref<Eigen::VectorXd> T) const;

  bool changes_by_time() const { return loads_.flow_changes() || any_path_ || line_.has_timed_loads(); }
  /// Which piece of the loads over time acts. (D150)
  void stay_in_piece_of(double t) { loads_.stay_in_piece_of(t); }
  /// Puts held nodes where their paths have them.
  void prescribe(double t, Eigen::Ref<Places> x, Eigen::Ref<Places> v, Eigen::Ref<Places> a) const;

 private:
  /// How a segment lies and moves: vector between its nodes, length, direction; relative velocity, rate of length.
  struct Bar {
    Triple t, w;
    double r, rate;
  };
  /// Its law g and what that changes with: T, the length, its rate; the sag besides. What its damper takes, W.
  struct Law {
    double left, by_T, by_length, by_rate, lost;
    Sag sag;
  };
  /// What eliminates a tension: its columns in the balance of both nodes, and its law's row by their places and by
  /// their relative velocity.
  struct Elimination {
    Triple column[2], by_place[2], by_rate, row[2];
    double by_T;
  };
  /// A push of the bed, N, its derivatives by depth and its rate, what it takes, W.
  struct Push {
    double force, by_depth, by_rate, lost;
  };
  static Bar bar(int j, const Instant& now);
  Law law(int j, const Bar& bar, const Instant& now, bool derivatives) const;
  Push push(int i, const Instant& now) const;
  void add_segment(int j, const Instant& now, Balance& out) const;
  void add_segments(const Instant& now, Balance& out) const;
  void add_nodes(const Instant& now, Balance& out);
  void add_up(double by);
  void differentiate_segments(const Instant& now, Powers& powers);
  void differentiate_segment(int j, const Instant& now, Powers& powers);
  void differentiate_water(int j, const Instant& now, const Bar& bar, Powers& powers);
  void differentiate_nodes(const Instant& now, Powers& powers);

  const Line& line_;
  Loads loads_;
  Blocks by_place_, by_velocity_, by_acceleration_;  // of forces, so of opposite sign to R
  std::vector<Elimination> eliminations_;
  BlockTridiagonal matrix_;
  Places forces_, x_, v_, a_, foreseen_;
  Balance there_;
  std::vector<int> beside_paths_;  // segments
  bool any_path_ = false, any_at_nodes_ = false;
};

}  // namespace dynamics::line
