#pragma once
/// \file  The water at members that are always wet, asked once an instant. (D141)
#include <limits>
#include <span>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/member.hpp"

namespace dynamics {

/// Where a step looks first, bodies come to lie closely; the water that was asked there serves while the step is
/// sought. Where bodies come to lie so far away that the flow would differ by more than a tolerance, it is asked anew.
class ForeseenFlow final : public Memory {
 public:
  /// A point of a member: the share of its axis before it, and the length that it stands for, m.
  struct Point {
    double share, length;
  };
  /// A member where it is, its points, and the water at each.
  struct Flow {
    const PlacedMember& at;
    std::span<const Point> points;
    std::span<const hydro::waves::Kinematics> water;
  };

  /// `tolerance`: of the change of the water's velocity with place, relative to the largest at any point. The water
  /// outlives this.
  ForeseenFlow(std::vector<SlenderMember> members, const hydro::waves::WaveField& water, double tolerance);

  void accept(const State&) override {}
  bool spares_work_only() const override { return true; }

  /// Finds the members in a state, and makes sure of the flow there. What of() gives stands until the next call.
  void look(const State& state);
  Flow of(std::size_t member) const;

 private:
  void ask(const State& state);
  bool differs() const;

  std::vector<SlenderMember> members_;
  const hydro::waves::WaveField& water_;
  double tolerance_;
  std::vector<PlacedMember> at_;
  double time_ = std::numeric_limits<double>::quiet_NaN();  // at which the water was asked
  std::vector<Point> points_;
  std::vector<std::size_t> begin_;  // of each member in points_, and the end
  std::vector<Eigen::Vector3d> place_;
  std::vector<hydro::waves::Kinematics> flow_;
};

}  // namespace dynamics
