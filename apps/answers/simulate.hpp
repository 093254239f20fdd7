#pragma once
/// \file  A scene run in time.
#include <functional>
#include <memory>
#include <vector>

#include "answers/checkpoint.hpp"
#include "compile/control.hpp"
#include "compile/defect.hpp"
#include "compile/restart.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Runs a model that is compiled already, from its start and for its steps; the start may be later than 0. `end`, if it
/// is not null, is told the last state; `motion`, if it is not, the velocities at each step. `kept`: where its
/// checkpoints are, from the last of which it goes on; a scene that asks for none has none.
/// \throws hydro::InputError at a signal that there is not
Run run_model(const scene::Scene& scene, const compile::TimeModel& model, const std::function<void(double)>& done = {},
              compile::MovingState* end = nullptr, compile::VelocityRecord* motion = nullptr, const KeptRun& kept = {});

/// Compiles and runs a scene that asks for a run. `done` is told the share of the steps completed; `controls` rule
/// connectors. `threads`: 1 or 2, which the runs that estimate the error take beside the run itself; the answer is the
/// same with either. `checkpoints`: of this result, if the scene asks for them; what has none of them has the same
/// bits. `interruption`: may end it after any step. \throws hydro::InputError; numerics that give up, or a signal, end
/// the record early with a reason instead
Run simulate(const scene::Scene& scene, const std::function<void(double)>& done = {},
             const std::vector<Control>& controls = {}, const std::shared_ptr<compile::Kept>& kept = nullptr,
             int threads = 1, Checkpoints* checkpoints = nullptr, const Interruption* interruption = nullptr);

}  // namespace froude
