#pragma once
/// \file  Mooring lines that are always in their static shape: quasi-static catenaries from bodies to the ground. (D63)
#include "dynamics/force/force_kind.hpp"
#include "dynamics/line/catenary.hpp"

namespace dynamics {

struct CatenaryMooring {
  int body;
  Eigen::Vector3d fairlead;  ///< from the centre of gravity, body axes, m
  Eigen::Vector3d anchor;    ///< global, m
  LineProperties line;
};

LineTension tension_of(const CatenaryMooring& mooring, const State& state);

class CatenaryMooringKind final : public ForceKind {
 public:
  explicit CatenaryMooringKind(std::vector<CatenaryMooring> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "mooring.catenary"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "elastic catenary, solved where the fairlead is"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }

 private:
  std::vector<CatenaryMooring> elements_;
};

}  // namespace dynamics
