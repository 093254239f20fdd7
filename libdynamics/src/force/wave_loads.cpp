#include "dynamics/force/wave_loads.hpp"

#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// The velocities of some bodies in one column.
Eigen::VectorXd gathered(const std::vector<int>& bodies, const Eigen::VectorXd& all) {
  Eigen::VectorXd out(6 * static_cast<Eigen::Index>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    out.segment<6>(6 * static_cast<Eigen::Index>(i)) = all.segment<6>(6 * bodies[i]);
  return out;
}

void scatter(const std::vector<int>& bodies, const Eigen::VectorXd& load, LoadSink& out) {
  for (std::size_t i = 0; i < bodies.size(); ++i) out.add(bodies[i], load.segment<6>(6 * static_cast<Eigen::Index>(i)));
}

}  // namespace

std::string ExcitationKind::method() const {
  return fmt::format("sum over {} wave components, tabulated on the step grid", elements_.front().load.components());
}

void ExcitationKind::add_load(const Instant& now, LoadSink& out) const {
  for (const auto& e : elements_) scatter(e.bodies, e.load.at(now.state.time), out);
}

EnergyFlow ExcitationKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const auto& e : elements_)
    flow.supplied += e.load.at(now.state.time).dot(gathered(e.bodies, now.state.velocity));
  return flow;
}

namespace {

Eigen::VectorXd at_modes(const std::vector<int>& modes, const Eigen::VectorXd& all) { return all(modes); }

/// The memories of all groups, and the history force of each integral: at the newest step itself, and at one
/// time after it.
class RadiationState final : public Memory {
 public:
  RadiationState(const std::vector<RadiationMemory>& groups, const State& start)
      : groups_(groups), newest_(start.time) {
    for (const auto& g : groups_) {
      past_.push_back(g.method->start(at_modes(g.modes, start.velocity)));
      at_newest_.push_back(Eigen::VectorXd::Zero(g.method->modes()));
    }
  }
  void accept(const State& state) override {
    refresh(1);
    at_newest_ = after_;
    for (std::size_t i = 0; i < groups_.size(); ++i) past_[i]->accept(at_modes(groups_[i].modes, state.velocity));
    newest_ = state.time;
    known_at_ = 0;
    if (!begun_) weight_.clear();
    begun_ = true;
  }
  /// −(integral) of one group at the time and velocity of `state`; good until asked for another.
  const Eigen::VectorXd& load(std::size_t group, const State& state) {
    const double fraction = fraction_of(state.time, groups_[group].method->step());
    if (fraction > 0) refresh(fraction);
    const Eigen::VectorXd& history_force = fraction > 0 ? after_[group] : at_newest_[group];
    velocity_ = state.velocity(groups_[group].modes);
    load_ = -history_force;
    load_.noalias() -= weight(group, fraction) * velocity_;
    return load_;
  }
  /// What multiplies the velocity of this very moment. At the start of a run nothing has been radiated yet.
  const Eigen::MatrixXd& weight(std::size_t group, double fraction) {
    if (weight_.empty() || fraction != weight_at_) {
      weight_.clear();
      for (const auto& g : groups_) weight_.push_back(weight_of(*g.method, fraction));
      weight_at_ = fraction;
    }
    return weight_[group];
  }
  /// Time since the newest stored velocity in steps, 0 … 1.
  double fraction_of(double time, double step) const {
    const double f = (time - newest_) / step;
    hydro::ensure(f > -1e-6 && f < 1 + 1e-6, "radiation asked for outside the step at hand");
    if (std::abs(f) < 1e-6) return 0;
    return f > 1 - 1e-6 ? 1 : f;
  }

 private:
  Eigen::MatrixXd weight_of(const hydro::radiation::MemoryMethod& method, double fraction) const {
    if (fraction > 0) return method.instantaneous(fraction);
    return begun_ ? method.instantaneous(1) : Eigen::MatrixXd::Zero(method.modes(), method.modes());
  }
  void refresh(double fraction) {
    if (fraction == known_at_) return;
    after_.clear();
    for (const auto& past : past_) after_.push_back(past->history_force(fraction));
    known_at_ = fraction;
  }

  const std::vector<RadiationMemory>& groups_;
  std::vector<std::unique_ptr<hydro::radiation::MemoryState>> past_;
  std::vector<Eigen::VectorXd> at_newest_, after_;
  std::vector<Eigen::MatrixXd> weight_;
  Eigen::VectorXd velocity_, load_;               // kept to spare making them at each evaluation
  double newest_, known_at_ = 0, weight_at_ = 0;  // fractions for which after_ and weight_ hold; 0: none, or the newest
  bool begun_ = false;
};

}  // namespace

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
  Eigen::VectorXd load = Eigen::VectorXd::Zero(now.state.velocity.size());
  LoadSink sink(load);
  add_load(now, sink);
  return {.stored = 0, .supplied = 0, .dissipated = -load.dot(now.state.velocity)};
}

}  // namespace dynamics
