#pragma once
/// \file  Mooring lines that are always in their static shape: quasi-static catenaries from bodies to the ground. (D63)
#include <memory>
#include <string>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/line/catenary_table.hpp"
#include "dynamics/state/point.hpp"

namespace dynamics {

struct CatenaryMooring {
  PointOnBody fairlead;
  PointOnGround anchor;
  LineProperties line;
  std::shared_ptr<const CatenaryTable> table = {};  ///< used where it holds the fairlead; empty: always solved
  std::string name = {};
};

LineTension tension_of(const CatenaryMooring& mooring, const State& state);

/// How the tensions change with the body's displacement about its centre of gravity, N/m and N.
struct TensionGradient {
  Eigen::Matrix<double, 1, 6> fairlead, anchor;
};
/// Of an anchor to which no tension comes: zero.
TensionGradient tension_gradient(const CatenaryMooring& mooring, const State& state);

class CatenaryMooringKind final : public ForceKind {
 public:
  explicit CatenaryMooringKind(std::vector<CatenaryMooring> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "mooring.catenary"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;

 private:
  std::vector<CatenaryMooring> elements_;
};

}  // namespace dynamics
