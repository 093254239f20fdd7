#pragma once
/// \file  Private to compile/: the time step of a run.
#include "compile/compile.hpp"

namespace froude::compile {

/// The step of a run, and what it follows.
struct ChosenStep {
  double value;  ///< s; divides the distance of samples
  PlanLine plan;
  std::string note;  ///< where the scene's own step is longer than what moves asks for; else empty
};

/// The step that the scene gives, or the one that keeps the period error of generalised-α, (ωh)²/12, a sixteenth of the
/// accuracy asked for the fastest of: the waves that matter, prescribed sines of joints, the bodies' own motions about
/// where they are placed and about where they start, and the turning that they start with. Springs count as stiff as
/// they ever become: slack lines drawn taut, stops that are run into. \throws hydro::InputError where the scene's own
/// step does not divide the distance of samples
ChosenStep choose_step(const scene::Scene& scene, const Prepared& prepared);

/// Springs and dampers, in the order in which a plan lists them.
void add_springs(const Prepared& prepared, std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces);

/// Where the scene puts bodies at t = 0, before an equilibrium is looked for; joints carry along those that it says
/// nothing of. `notes` are told what of joints the digits of the scene left open. \throws hydro::InputError where that
/// is too much
dynamics::State placed_state(const scene::Scene& scene, const Prepared& prepared, const dynamics::Model& model,
                             std::vector<std::string>& notes);

}  // namespace froude::compile
