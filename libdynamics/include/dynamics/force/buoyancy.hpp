#pragma once
/// \file  Still water's load on hulls as they are and where they are: exact for the shape at any pose.
#include <memory>
#include <variant>

#include "dynamics/force/force_kind.hpp"
#include "hydro/hydrostatics/shapes.hpp"

namespace dynamics {

/// What a body shows the water, in body axes from the body's origin.
using FloatingShape =
    std::variant<hydro::hydrostatics::Hull, hydro::hydrostatics::CircularCylinder, hydro::hydrostatics::Sphere>;

struct Buoyancy {
  int body;
  std::shared_ptr<const FloatingShape> shape;  ///< copies of a body share it
};

/// What of the shape is under water while its body is in this pose.
hydro::hydrostatics::Immersion immersion(const Buoyancy& element, const RigidBody& body, const Pose& pose);

/// ρ g V up at the centre of buoyancy, of the part of the shape below z = 0 in the body's true pose (D30); stored
/// energy −ρ g V z_B less that at rest. Still water only: what waves add is excitation and radiation. For bodies that
/// feel their weight (GravityKind) and have no linear hydrostatics.
class BuoyancyKind final : public ForceKind {
 public:
  /// \throws hydro::InputError if water comes in through an opening of a hull at rest
  BuoyancyKind(const std::vector<RigidBody>& bodies, std::vector<Buoyancy> elements, const hydro::Water& water);

  std::string effect() const override { return "buoyancy"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override;
  /// \throws hydro::NumericsError with the time if water comes in through an opening: there the model ends. The same of
  /// add_jacobian() and energy()
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }

 private:
  hydro::hydrostatics::Immersion immersion_of(const Buoyancy& element, const State& state) const;
  double stored(const State& state) const;

  std::vector<RigidBody> bodies_;
  std::vector<Buoyancy> elements_;
  hydro::Water water_;
  double at_rest_ = 0;  // J
};

}  // namespace dynamics
