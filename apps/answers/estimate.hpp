#pragma once
/// \file  A run whose error is estimated, and that is refused where it misses the accuracy asked. Private to apps.
#include <functional>
#include <string>

#include "answers/checkpoint.hpp"
#include "compile/compile.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Of an answer to a scene, before anything is known of its error, or where nothing can be: `missing` says why.
ErrorEstimate unknown_error(const scene::Scene& scene, std::string missing = {});
/// Beside what the run itself has told to have no estimate.
void set_error(Run& run, ErrorEstimate error);

/// Runs a scene so that the error of each signal asked for, Run::error, stays within [ask] accuracy: the step (or the
/// tolerance) that the program chooses is refined until it does. What the scene itself gives stands, and its error is
/// told. Signals that no step can predict are judged for as long as they can be. `progress` is told the share done.
/// `threads`: 1 or 2, which runs beside each other take; the answer is the same with either. A run that numerics or
/// a signal end early has no estimate. \throws hydro::InputError where the accuracy cannot be met and [solve]
/// accept_error does not take what there is
Run run_to_accuracy(const scene::Scene& scene, const compile::Prepared& prepared,
                    const std::function<void(double)>& progress, int threads, Checkpoints* checkpoints = nullptr,
                    const Interruption* interruption = nullptr);

}  // namespace froude
