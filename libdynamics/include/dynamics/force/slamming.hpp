#pragma once
/// \file  Impact of water on members that it meets: each piece is struck once when its axis goes under. (D47)
#include <memory>
#include <optional>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/member.hpp"
#include "dynamics/force/member_signals.hpp"
#include "hydro/waves/kinematics/impact.hpp"

namespace dynamics {

/// What has to go under before a piece counts as struck.
enum class ImpactBegins {
  underside,  ///< its lowest point
  line,       ///< its axis
  submerged   ///< its highest point (Van Zanten 2020, below eq. 2.19)
};

struct SlammingMember {
  SlenderMember line;  ///< immersion: surface or still_water
  hydro::waves::ImpactTheory theory;
  ImpactBegins begins = ImpactBegins::line;
  double factor = 1;  ///< of the theory's force
  std::optional<ToldLoad> told = {};
};

/// The load of a struck piece points along the velocity of the water relative to it across its axis at the first whole
/// step at which it is found under, and that velocity stays frozen. The force is the mean of the theory's over the last
/// step, so that the impulse is the theory's whatever the step; the instant is late by a step at most. A piece can be
/// struck again once it has come up.
class SlammingKind final : public ForceKind {
 public:
  /// `step`: of the run, s.
  SlammingKind(std::vector<SlammingMember> members, std::shared_ptr<const hydro::waves::WaveField> water, double step)
      : members_(std::move(members)), water_(std::move(water)), step_(step) {}
  std::string effect() const override { return "slamming"; }
  std::size_t elements() const override { return members_.size(); }
  std::string method() const override { return "impulse of each piece that goes under, velocity frozen at contact"; }
  std::unique_ptr<Memory> make_memory(const State& start) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  /// Of members that tell their loads: the mean over the last step. (D154)
  std::vector<Signal> signals() const override;

  const std::vector<SlammingMember>& members() const { return members_; }
  const hydro::waves::WaveField& water() const { return *water_; }

 private:
  std::vector<SlammingMember> members_;
  std::shared_ptr<const hydro::waves::WaveField> water_;
  double step_;
};

}  // namespace dynamics
