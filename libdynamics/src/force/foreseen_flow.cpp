#include "foreseen_flow.hpp"

#include <algorithm>
#include <utility>

namespace dynamics {

ForeseenFlow::ForeseenFlow(std::vector<SlenderMember> members, const hydro::waves::WaveField& water, double tolerance)
    : members_(std::move(members)), water_(water), tolerance_(tolerance) {}

void ForeseenFlow::look(const State& state) {
  at_.clear();
  for (const SlenderMember& m : members_) at_.push_back(placed(m, state));
  if (time_ != state.time || differs()) ask(state);
}

ForeseenFlow::Flow ForeseenFlow::of(std::size_t member) const {
  const std::size_t begin = begin_[member], count = begin_[member + 1] - begin;
  return {at_[member], std::span(points_).subspan(begin, count), std::span(flow_).subspan(begin, count)};
}

void ForeseenFlow::ask(const State& state) {
  thread_local std::vector<WetPiece> pieces;         // its room is kept from call to call
  time_ = std::numeric_limits<double>::quiet_NaN();  // until the water has answered
  points_.clear();
  place_.clear();
  begin_.assign(1, 0);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const PlacedMember& at = at_[i];
    find_wet_pieces(members_[i], at, water_, state.time, false, pieces);
    for (const WetPiece& p : pieces) {
      points_.push_back({at.axis.dot(p.arm - at.from) / at.length, p.length});
      place_.push_back(at.centre + p.arm);
    }
    begin_.push_back(points_.size());
  }
  flow_.resize(place_.size());
  water_.at(state.time, place_, flow_);
  time_ = state.time;
}

bool ForeseenFlow::differs() const {
  double difference = 0, speed = 0;  // squares
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Eigen::Vector3d moved = at_[i].centre + at_[i].arm(points_[k].share) - place_[k];
      difference = std::max(difference, (flow_[k].gradient * moved).squaredNorm());
      speed = std::max(speed, flow_[k].velocity.squaredNorm());
    }
  return difference > tolerance_ * tolerance_ * speed;
}

}  // namespace dynamics
