#pragma once
/// \file  What water does to the flat ends of slender members, and to plates on them: pressure of the waves, drag and
///        added mass along the member. (D171)
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/member_signals.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace dynamics {

/// One end of a member, under water; body axes.
struct MemberEnd {
  Eigen::Vector3d arm;     ///< from the body's centre of gravity, m
  Eigen::Vector3d inward;  ///< t, unit vector from the end into the member
  double pressed = 0;      ///< A, on which the waves press, m²
  double added = 0;        ///< m_a, of the water that goes along with the end, kg
  double drag = 0;         ///< ½ρ C_D A_p, kg/m
};

/// The ends of one member that are loaded: one or both.
struct MemberEnds {
  std::string name;  ///< of the member
  int body;
  std::vector<MemberEnd> ends;
  std::optional<ToldLoad> told = {};
};

/// Mass of water, ρ C_A πD³/12, of an end or a plate of diameter D: C_A times half a sphere. A thin disc alone in the
/// water has 8/3 ρR³ on both sides together, C_A = 2/π on each (Lamb 1932, article 102).
double end_added_mass(double ca, double diameter_m, double density);

/// On an end, with t into the member and p the waves' pressure, u and u̇ the velocity of the water and the acceleration
/// of its particles, w and ẇ those of the end, all where the end is (D171):
///   (p A + m_a t·(u̇ − ẇ) + ½ρ C_D A_p |t·(u − w)| t·(u − w)) t
/// Pressure at rest is buoyancy's. Valid for ends that are small beside the wave and stay under water: a run in which
/// one comes out stops.
class MemberEndsKind final : public ForceKind {
 public:
  MemberEndsKind(std::vector<MemberEnds> members, std::shared_ptr<const hydro::waves::WaveField> water)
      : members_(std::move(members)), water_(std::move(water)) {}
  std::string effect() const override { return "ends"; }
  std::size_t elements() const override;
  std::string method() const override { return "pressure, drag and added mass along the member, where its ends are"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  void add_mass(const State& state, MassSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  /// Of members that tell their loads, with −M a of their own added mass. (D154)
  std::vector<Signal> signals() const override;
  /// Ends that come out of the water.
  std::string breaks_off(const State& before, const State& after) const override;

 private:
  Vector6 whole_load(std::size_t member, const Reading& now) const;
  std::vector<MemberEnds> members_;
  std::shared_ptr<const hydro::waves::WaveField> water_;
};

}  // namespace dynamics
