#pragma once
/// \file  Coulomb friction in hinges and sliders: a set-valued law, which sticks or slips and is never smoothed.
#include "dynamics/force/friction_law.hpp"
#include "dynamics/joint/coordinate.hpp"

namespace dynamics {

/// Friction of one joint: while it sticks it carries up to `breakaway`, while it slips it resists with `sliding` (D19),
/// or falls from the one to the other over the rate `stribeck` (D32). Or a latch: it holds whatever the load, for the
/// time `hold` from where it came to rest, and is nothing otherwise (D33).
struct Friction {
  std::string name;  ///< of the joint
  JointCoordinate coordinate;
  double breakaway;                     ///< static level, N m or N, >= sliding; of latches infinite
  double sliding;                       ///< dynamic level, > 0; of latches 0
  std::optional<double> stribeck = {};  ///< rad/s or m/s, > 0
  std::optional<double> hold = {};      ///< s, > 0
  double sign = 1;                      ///< −1 where its signal is told along the axis turned round
  double level(double rate) const;      ///< against the slip, N m or N
  double slope(double rate) const;      ///< its derivative by the rate
};

/// Loads of frictions that slip, and the law of all: those that stick are JointCoordinate::holding(), and hold up to
/// the static level.
class FrictionKind final : public ForceKind, public FrictionLaw {
 public:
  /// \throws hydro::InputError if a level, rate or time is not positive, or the static level is below the dynamic one
  explicit FrictionKind(std::vector<Friction> elements);

  std::string effect() const override;  ///< "friction", or "latch" where there is nothing else
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "sticks or slips, events located"; }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  const FrictionLaw* friction() const override { return this; }
  std::vector<Signal> signals() const override;

  double rate(std::size_t element, const State& state) const override {
    return elements_[element].coordinate.rate(state);
  }
  Constraint holding(std::size_t element, const State& state) const override {
    return elements_[element].coordinate.holding(state);
  }
  double utilisation(std::size_t element, double load, const FrictionMemory& memory, double time) const override;
  double load(std::size_t element, const State& state, const Memory* memory, const Eigen::VectorXd& multipliers,
              Eigen::Index joints) const override;
  void note_work(const State& before, const State& after, FrictionMemory& memory) const override;

 private:
  std::vector<Friction> elements_;
};

}  // namespace dynamics
