#pragma once
/// \file  Private to apps: a scene in regular waves as a periodic system.
#include <memory>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "dynamics/frequency/periodic_model.hpp"
#include "dynamics/state/signal.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The scene in its own regular waves, of this period (s) and height (m), by whatever step.
scene::Scene with_waves(scene::Scene scene, double period, double height);

/// The same without ramp, asked for one period.
scene::Scene in_waves(scene::Scene scene, double period, double height);

/// What runs of a scene share, with radiation by poles, which harmonic balance and multipliers both know; a note says
/// so where the scene names another method.
compile::Prepared prepare_periodic(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr);

/// Parts that PeriodicScene hands to its base, which must be there before it.
struct PeriodicParts {
  std::unique_ptr<const compile::TimeModel> time;
  dynamics::frequency::SmallMotions small;
};

/// Motions about rest or about the equilibrium in still water, as [ask.stability] says.
class PeriodicScene final : private PeriodicParts, public dynamics::frequency::PeriodicModel {
 public:
  /// `scene`: as in_waves() makes it, with `[ask] stability`. \throws hydro::InputError as PeriodicModel
  PeriodicScene(const scene::Scene& scene, const compile::Prepared& prepared, double period);

  const dynamics::Model& model() const { return time->model; }
  const std::vector<std::string>& notes() const { return time->notes; }
  /// Signals of the model in a motion, (times, signals).
  Eigen::MatrixXd values(const std::vector<dynamics::Signal>& signals,
                         const dynamics::frequency::PeriodicMotion& motion, const std::vector<double>& times);
};

}  // namespace froude
