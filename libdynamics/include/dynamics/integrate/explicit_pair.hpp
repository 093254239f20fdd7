#pragma once
/// \file  An explicit pair of orders 5 and 4 that chooses its own steps, for motions without stiffness.
#include <array>

#include "dynamics/integrate/integrator.hpp"

namespace dynamics {

/// Dormand & Prince (1980) in places, rotation vectors within the step and velocities (D28). Each step asked for is cut
/// so that the estimated local error of places over the step, and of velocities, in the metric of the masses, stays
/// below the tolerance relative to the velocities and what accelerations add in the step. Joints: as SemiImplicitEuler.
///
/// Cheap where nothing is stiff; springs of frequency ω hold it to steps below some 3/ω whatever they move.
/// \throws hydro::InputError for models with contacts
class ExplicitPair final : public Integrator {
 public:
  struct Settings {
    double tolerance = 1e-8;  ///< infinite: one step of order 5 each, to see its order
  };
  ExplicitPair(const Model& model, const Settings& settings);

 private:
  int order() const override { return 5; }
  const char* steps_stay_whole() const override { return "the pair has one of its own"; }
  void keep_own_state(hydro::StateBytes& bytes) override { bytes.pass(last_); }
  bool try_step(Workspace& workspace, double h, StepReport& report) override;
  /// One step of both orders: `end_` by order 5. \returns the estimated error relative to what is allowed; none where
  /// there are no accelerations
  std::optional<double> attempt(Workspace& workspace, double h);
  bool find_stages(Workspace& workspace, double h);

  static constexpr int stages = 7;
  Settings settings_;
  double last_ = 0;  // step that was taken last, s
  // Kept, so that a step asks for no memory: where the step begins and what is asked for, what a stage comes from, what
  // stages give.
  State begin_, start_, end_;
  Eigen::VectorXd multipliers_, begin_acceleration_, begin_multipliers_;
  Eigen::VectorXd move_, gain_, velocity_, off_, off_speed_;
  std::array<Eigen::VectorXd, stages> moving_, gaining_;
};

}  // namespace dynamics
