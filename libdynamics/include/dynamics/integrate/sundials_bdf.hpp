#pragma once
/// \file  Backward differences of variable order by SUNDIALS' CVODE, as an outside reference. Only in builds configured
/// with FROUDE_SUNDIALS.
#include <memory>

#include "dynamics/integrate/integrator.hpp"

namespace dynamics {
namespace detail {
class Cvode;
}

/// The equations of motion in places, rotation vectors within the step and velocities (D28), as for ExplicitPair, given
/// to CVODE, which chooses order, 1 to 5, and its own steps, and makes its matrices by differences. It begins anew with
/// each step asked for, so it is no measure of speed; stiff springs do not hold it back. Joints: as SemiImplicitEuler.
/// Hindmarsh et al. (2005), ACM TOMS 31, 363.
/// \throws hydro::InputError for models with contacts
class SundialsBdf final : public Integrator {
 public:
  struct Settings {
    double tolerance = 1e-8;  ///< of the local error of velocities, and of places over the step; relative to speeds
  };
  SundialsBdf(const Model& model, const Settings& settings);
  ~SundialsBdf() override;

  const char* cannot_be_kept() const override { return "its past steps are inside SUNDIALS"; }

 private:
  int order() const override { return 5; }
  const char* steps_stay_whole() const override { return "CVODE has a tolerance of its own"; }
  bool try_step(Workspace& workspace, double h, StepReport& report) override;

  Settings settings_;
  std::unique_ptr<detail::Cvode> solver_;
};

}  // namespace dynamics
