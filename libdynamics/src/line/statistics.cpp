#include "dynamics/line/statistics.hpp"

#include <numeric>

#include "hydro/base/error.hpp"

namespace dynamics::line {

TensionStatistics::TensionStatistics(int segments, double slack_below, double snap_above)
    : slack_below_(slack_below),
      snap_above_(snap_above),
      slack_(Eigen::VectorXd::Zero(segments)),
      armed_(static_cast<std::size_t>(segments), 0),
      snaps_(static_cast<std::size_t>(segments), 0) {
  hydro::require(
      slack_below >= 0 && slack_below < snap_above,
      "a line is slack below a tension that is not negative, and snaps above a larger one; got {} N and {} N",
      slack_below, snap_above);
}

void TensionStatistics::note(double t_s, double h, Eigen::Ref<const Eigen::VectorXd> tension) {
  bool any = false;
  for (Eigen::Index j = 0; j < tension.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    if (tension[j] > largest_.tension) largest_ = {tension[j], t_s, static_cast<int>(j)};
    if (tension[j] <= slack_below_) {
      slack_[j] += h;
      armed_[at] = true;
      any = true;
    } else if (armed_[at] && tension[j] >= snap_above_) {
      armed_[at] = false;
      ++snaps_[at];
    }
  }
  time_ += h;
  if (any) any_slack_ += h;
}

double TensionStatistics::slack_share() const { return time_ > 0 ? any_slack_ / time_ : 0; }
double TensionStatistics::slack_share(int segment) const { return time_ > 0 ? slack_[segment] / time_ : 0; }
int TensionStatistics::snaps() const { return std::accumulate(snaps_.begin(), snaps_.end(), 0); }

double clamping_moment(const Line& line, const State& state, int node) {
  if (line.held(node) == nullptr || line.bending(node) == 0) return 0;
  const int j = line.before(node) < 0 ? line.after(node) : line.before(node), i = line.first(j);
  const Eigen::Vector3d along = (state.position.col(i + 1) - state.position.col(i)) / line.segment(j).length;
  return line.bending(node) * (along - line.held(node)->clamp).norm();
}

double curvature(const State& state, int node) {
  const Eigen::Vector3d before = state.position.col(node) - state.position.col(node - 1),
                        after = state.position.col(node + 1) - state.position.col(node);
  return 2 * (after.normalized() - before.normalized()).norm() / (before.norm() + after.norm());
}

}  // namespace dynamics::line
