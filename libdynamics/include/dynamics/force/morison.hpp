#pragma once
/// \file  Morison's load on slender members that move, at their true position: drag across and along the axis,
///        Froude–Krylov, and added mass on the left of the equations of motion. (D43)-(D45)
#include <memory>
#include <optional>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/member.hpp"
#include "dynamics/force/member_signals.hpp"

namespace dynamics {

/// Per length, with u the water's velocity and u̇ the acceleration of its particles at the member's axis, w and ẇ those
/// of the member, P the projection across the axis t (D43):
///   ½ρ C_D D |P(u−w)| P(u−w) + ½ρ C_T πD |t·(u−w)| t·(u−w) t + ρ ¼πD² P(u̇ + C_A (u̇ − ẇ))
/// Buoyancy, and pressure on the ends, are other effects.
struct MorisonMember {
  SlenderMember line;
  double cd, ca;
  double cd_tangential = 0;  ///< of the wetted skin πD
  std::optional<ToldLoad> told = {};
};

/// What a cylinder takes of flow across its axis, per length (D43): coefficients of drag and of the mass of water, and
/// the loads of one velocity and one acceleration, as vectors across the axis or as numbers along one line. Members of
/// a run and the fits of measured forces have their loads from here.
struct MorisonPerLength {
  double normal;     ///< ½ρ C_D D, kg/m²
  double displaced;  ///< ρ ¼πD², kg/m
  double added;      ///< C_A times that, kg/m

  MorisonPerLength(double diameter, double density, double cd, double ca);
  /// Of the velocity w of the water past the member, `speed` its length, m/s: N/m.
  template <class W>
  W drag(const W& w, double speed) const {
    return normal * speed * w;
  }
  /// Of the water's acceleration and of that of the member, m/s²: N/m.
  template <class W>
  W inertia(const W& water, const W& own) const {
    return (displaced + added) * water - added * own;
  }
};

/// Gauss' two points of each piece of a member that is always wet: the error is (κΔ)⁴/4320 of the inertia load and 16
/// times that of the drag, κ the wavenumber, Δ the length of a piece. Of members wet in part the middle of the wet
/// part: (κΔ)²/24 and four times that, κ also the inverse of the distance to the point about which the member turns
/// (D44).
///
/// With a tolerance of foresight the water at members that are always wet is asked once an instant, at the places to
/// which bodies are on their way, and stays there while a step is sought: loads and their derivatives are then those
/// of water that does not change over the little that is missed, by no more than this of the velocity (D141). Without
/// one, and for members wet in part, it is that of their true places.
class MorisonKind final : public ForceKind {
 public:
  /// `water`: still water is a field without waves. `foresight`: 0 … 1, of the largest velocity of the water at any
  /// point; 0: none.
  MorisonKind(std::vector<MorisonMember> members, std::shared_ptr<const hydro::waves::WaveField> water,
              double foresight = 0);
  std::string effect() const override { return "morison"; }
  std::size_t elements() const override { return members_.size(); }
  std::string method() const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  void add_mass(const State& state, MassSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  /// Of members that tell their loads, with −M a of their own added mass. (D154)
  std::vector<Signal> signals() const override;

 private:
  Vector6 whole_load(std::size_t member, const Reading& now) const;
  /// Added mass of the members that are always wet, about the body's centre of gravity, body axes.
  struct BodyMass {
    int body;
    Matrix6 added;
  };
  std::vector<MorisonMember> members_;
  std::vector<BodyMass> always_;
  std::shared_ptr<const hydro::waves::WaveField> water_;
  double foresight_;
};

}  // namespace dynamics
