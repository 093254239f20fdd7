#include "dynamics/force/recorded_load.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

Eigen::VectorXd load_at(const LoadRecord& record, double time) {
  const Eigen::Index last = record.on_modes.cols() - 1;
  const double place = std::clamp(time / record.spacing, 0.0, static_cast<double>(last));
  const auto before = static_cast<Eigen::Index>(std::floor(place)), after = std::min(before + 1, last);
  const double part = place - static_cast<double>(before);
  return (1 - part) * record.on_modes.col(before) + part * record.on_modes.col(after);
}

}  // namespace

RecordedLoadKind::RecordedLoadKind(std::vector<LoadRecord> elements) : elements_(std::move(elements)) {
  for (const LoadRecord& e : elements_)
    hydro::require(e.spacing > 0 && e.on_modes.cols() > 0, "a record of loads needs samples and the time between them");
}

void RecordedLoadKind::add_load(const Instant& now, LoadSink& out) const {
  for (const LoadRecord& e : elements_) {
    const Eigen::VectorXd load = load_at(e, now.state.time);
    for (Eigen::Index mode = 0; mode < load.size(); ++mode) out.add_mode(static_cast<int>(mode), load[mode]);
  }
}

EnergyFlow RecordedLoadKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const LoadRecord& e : elements_) flow.supplied += load_at(e, now.state.time).dot(now.state.velocity);
  return flow;
}

}  // namespace dynamics
