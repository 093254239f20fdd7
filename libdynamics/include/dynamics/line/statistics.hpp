#pragma once
/// \file  What a run does to a line: slack, snaps, the largest tension, and how far it bends. (D93), (D94)
#include <limits>
#include <vector>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// Counts, step by step, how long segments are slack and how often they snap. (D93)
class TensionStatistics {
 public:
  /// A segment is slack at a tension of `slack_below` or less, and snaps when after that it reaches `snap_above`.
  /// \throws hydro::InputError unless 0 <= slack_below < snap_above
  TensionStatistics(int segments, double slack_below, double snap_above);

  /// A step of `h` seconds ended at `t_s` with these tensions, N, (segments).
  void note(double t_s, double h, Eigen::Ref<const Eigen::VectorXd> tension);

  struct Largest {
    double tension = -std::numeric_limits<double>::infinity(), time = 0;  ///< N, s
    int segment = 0;
  };
  const Largest& largest() const { return largest_; }
  double slack_share() const;             ///< of the time, in which at least one segment is slack
  double slack_share(int segment) const;  ///< of the time, of one
  int snaps() const;                      ///< of all segments together
  int snaps(int segment) const { return snaps_[static_cast<std::size_t>(segment)]; }
  void keep_state(hydro::StateBytes& bytes) {
    bytes.pass(time_, any_slack_, slack_, armed_, snaps_, largest_.tension, largest_.time, largest_.segment);
  }

 private:
  double slack_below_, snap_above_;
  double time_ = 0, any_slack_ = 0;
  Eigen::VectorXd slack_;
  std::vector<char> armed_;  // each true or false
  std::vector<int> snaps_;
  Largest largest_;
};

/// Size of the moment that clamps an end, N m; 0 where nothing does. (D107)
double clamping_moment(const Line& line, const State& state, int node);

/// Curvature at an inner node, 1/m: |t₂ − t₁| over the mean of the lengths beside it. (D94)
double curvature(const State& state, int node);

}  // namespace dynamics::line
