#include "dynamics/force/wave_loads.hpp"

#include <algorithm>

#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// Calls use(body, load) for each body at a time.
template <class Use>
void for_each_load(const std::vector<Excitation>& elements, double time, const Use& use) {
  for (const Excitation& e : elements)
    e.load.use_at(time, [&](const auto& loads) {
      for (std::size_t i = 0; i < e.bodies.size(); ++i)
        use(e.bodies[i], Vector6(loads.template segment<6>(6 * static_cast<Eigen::Index>(i))));
    });
}

}  // namespace

std::string ExcitationKind::method() const {
  return fmt::format("sum over {} wave components, tabulated on the step grid", elements_.front().load.components());
}

void ExcitationKind::add_load(const Instant& now, LoadSink& out) const {
  for_each_load(elements_, now.state.time, [&](int body, const Vector6& load) { out.add(body, load); });
}

EnergyFlow ExcitationKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for_each_load(elements_, now.state.time, [&](int body, const Vector6& load) {
    flow.supplied += load.dot(now.state.velocity.segment<6>(6 * body));
  });
  return flow;
}

namespace {

/// The numbers of some modes, into a vector that has room.
void take_modes(const std::vector<int>& modes, const Eigen::VectorXd& all, Eigen::VectorXd& out) {
  out.resize(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) out[static_cast<Eigen::Index>(i)] = all[modes[i]];
}

/// The memories of all groups, and the history force of each integral: at the newest step itself, and at one
/// time after it.
class RadiationState final : public Memory {
 public:
  RadiationState(const std::vector<RadiationMemory>& groups, const State& start)
      : groups_(groups), newest_(start.time) {
    for (const auto& g : groups_) {
      take_modes(g.modes, start.velocity, velocity_);
      past_.push_back(g.method->start(velocity_));
      at_newest_.push_back(Eigen::VectorXd::Zero(g.method->modes()));
      after_.push_back(at_newest_.back());
      at_end_.push_back(g.method->instantaneous(1));
      at_start_.push_back(at_end_.back());
      if (g.method->has_past()) at_start_.back().setZero();
    }
  }
  void accept(const State& state) override {
    refresh(1);
    at_newest_ = after_;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      take_modes(groups_[i].modes, state.velocity, velocity_);
      past_[i]->accept(velocity_);
    }
    newest_ = state.time;
    known_at_ = 0;
    begun_ = true;
  }
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override {
    for (const auto& one : past_) one->keep_state(bytes);
    bytes.pass(at_newest_, after_, newest_, known_at_, begun_);
  }
  /// −(integral) of one group at the time and velocity of `state`; good until asked for another.
  const Eigen::VectorXd& load(std::size_t group, const State& state) {
    const double fraction = fraction_of(state.time, groups_[group].method->step());
    if (fraction > 0) refresh(fraction);
    const Eigen::VectorXd& history_force = fraction > 0 ? after_[group] : at_newest_[group];
    take_modes(groups_[group].modes, state.velocity, velocity_);
    load_ = -history_force;
    load_.noalias() -= weight(group, fraction) * velocity_;
    return load_;
  }
  /// Of that load, W.
  double power(std::size_t group, const State& state) { return load(group, state).dot(velocity_); }
  /// What multiplies the velocity of this very moment. At the start of a run a memory has nothing yet.
  const Eigen::MatrixXd& weight(std::size_t group, double fraction) {
    if (fraction == 1) return at_end_[group];
    if (fraction == 0) return begun_ ? at_end_[group] : at_start_[group];
    if (fraction != within_at_) {
      within_.clear();
      for (const auto& g : groups_) within_.push_back(g.method->instantaneous(fraction));
      within_at_ = fraction;
    }
    return within_[group];
  }
  /// Time since the newest stored velocity in steps, 0 … 1.
  double fraction_of(double time, double step) const {
    const double f = (time - newest_) / step;
    hydro::ensure(f > -1e-6 && f < 1 + 1e-6, "radiation asked for outside the step at hand");
    if (std::abs(f) < 1e-6) return 0;
    return f > 1 - 1e-6 ? 1 : f;
  }

 private:
  void refresh(double fraction) {
    if (fraction == known_at_) return;
    for (std::size_t i = 0; i < past_.size(); ++i) past_[i]->find_history_force(fraction, after_[i]);
    known_at_ = fraction;
  }

  const std::vector<RadiationMemory>& groups_;
  std::vector<std::unique_ptr<hydro::radiation::MemoryState>> past_;
  std::vector<Eigen::VectorXd> at_newest_, after_;
  std::vector<Eigen::MatrixXd> at_start_, at_end_, within_;  // what multiplies the velocity
  Eigen::VectorXd velocity_, load_;                          // kept to spare making them at each evaluation
  double newest_, known_at_ = 0, within_at_ = 0;             // fractions for which after_ and within_ hold; 0: none
  bool begun_ = false;
};

}  // namespace

bool RadiationKind::remembers_whole_steps() const {
  return std::any_of(elements_.begin(), elements_.end(), [](const auto& e) { return e.method->has_past(); });
}

std::string RadiationKind::method() const { return elements_.front().method->describe(); }

void RadiationKind::couple(BlockPattern& pattern) const {
  for (const auto& e : elements_)
    for (const int i : e.modes)
      for (const int j : e.modes)
        if (j / 6 < i / 6) pattern.couple(i / 6, j / 6);
}

std::unique_ptr<Memory> RadiationKind::make_memory(const State& start) const {
  return std::make_unique<RadiationState>(elements_, start);
}

void RadiationKind::add_load(const Instant& now, LoadSink& out) const {
  auto& memory = static_cast<RadiationState&>(*now.memory);
  for (std::size_t g = 0; g < elements_.size(); ++g) {
    const Eigen::VectorXd& load = memory.load(g, now.state);
    const auto& modes = elements_[g].modes;
    for (std::size_t i = 0; i < modes.size(); ++i) out.add_mode(modes[i], load[static_cast<Eigen::Index>(i)]);
  }
}

void RadiationKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  auto& memory = static_cast<RadiationState&>(*now.memory);
  for (std::size_t g = 0; g < elements_.size(); ++g) {
    const auto& e = elements_[g];
    out.add_velocity_modes(e.modes, -memory.weight(g, memory.fraction_of(now.state.time, e.method->step())));
  }
}

EnergyFlow RadiationKind::energy(const Instant& now) const {
  EnergyFlow flow;
  auto& memory = static_cast<RadiationState&>(*now.memory);
  for (std::size_t g = 0; g < elements_.size(); ++g) flow.dissipated -= memory.power(g, now.state);
  return flow;
}

}  // namespace dynamics
