#pragma once
/// \file  Private to apps: a scene in regular waves as a periodic system.
#include "compile/compile.hpp"
#include "dynamics/frequency/periodic_model.hpp"

namespace froude {

/// The scene in regular waves of this period and height, without ramp.
scene::Scene in_waves(scene::Scene scene, double period, double height);

/// What runs of a scene share, with radiation by poles, which harmonic balance and multipliers both know.
compile::Prepared prepare_periodic(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr);

struct PeriodicParts {
  std::unique_ptr<const compile::TimeModel> time;
  dynamics::frequency::SmallMotions about;
};

/// Motions about rest or about the equilibrium in still water, as `about` says.
class PeriodicScene final : private PeriodicParts, public dynamics::frequency::PeriodicModel {
 public:
  /// `scene` as in_waves() makes it. \throws hydro::InputError as PeriodicModel, and for lines that are stepped by
  /// themselves
  PeriodicScene(const scene::Scene& scene, const compile::Prepared& prepared, const scene::About& about, double period);

  const compile::TimeModel& model() const { return *time; }
  /// One period of signals of the model, (samples, signals).
  Eigen::MatrixXd values(const std::vector<dynamics::Signal>& signals,
                         const dynamics::frequency::PeriodicMotion& motion, const std::vector<double>& times);
};

}  // namespace froude
