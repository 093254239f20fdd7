#pragma once
/// \file  Linear hydrostatics of bodies that may turn: what still water does to a body whose restoring matrix is known.
#include <Eigen/Core>

#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// Still water has no heading: loads depend on how far a body is above its place and how far its vertical leans, seen
/// from the body, and on no turn about the vertical (D156).
struct Hydrostatics {
  int body;
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< C of heave, roll and pitch about the centre of gravity
  double lift = 0;  ///< N, a constant force upwards at the centre of gravity: buoyancy less weight of a body that
                    ///< others hold at its draught
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  ///< N m at rest about the centre of gravity, roll and pitch, of
                                                     ///< buoyancy that acts beside it
};

/// K(c) = θ/sin θ with c = cos θ, 0 <= θ < π, and its slopes over c. Exact to rounding.
struct TiltScale {
  double value, slope, curvature;
};
TiltScale tilt_scale(double cosine);

class HydrostaticsKind final : public ForceKind {
 public:
  HydrostaticsKind(const std::vector<RigidBody>& bodies, std::vector<Hydrostatics> elements);

  const std::vector<Hydrostatics>& all() const { return elements_; }
  std::string effect() const override { return "hydrostatics"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "matrix of heave, roll and pitch about the rest position"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  /// A body that leans by half a turn: beyond it the moment would act the other way.
  std::string breaks_off(const State& before, const State& after) const override;

 private:
  std::vector<Hydrostatics> elements_;
  std::vector<double> rest_height_;  // of centres of gravity, one an element, m
};

}  // namespace dynamics
