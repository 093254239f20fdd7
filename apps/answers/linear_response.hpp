#pragma once
/// \file  Responses per metre of wave: for `froude rao`, and for runs that need no stepping.
#include <string>
#include <vector>

#include "compile/signal_list.hpp"
#include "froude/result.hpp"

namespace froude {

/// Signals per metre of wave along `heading`, rad, about where the bodies are still, from displacements `xi` (6N, Nω)
/// and multipliers (m, Nω) of joints, which may be of no size.
std::vector<ComplexSignal> linear_responses(const std::vector<compile::Signal>& signals,
                                            const dynamics::frequency::SmallMotions& about, const Eigen::MatrixXcd& xi,
                                            const Eigen::MatrixXcd& multipliers, const std::vector<double>& omega,
                                            double heading);

/// The signals that [ask.rao] names, at its frequencies and headings.
/// \throws hydro::InputError, hydro::NumericsError; std::logic_error for a scene that asks for no RAO, or for one
/// without a heading, which no reader makes
Responses respond(const scene::Scene& scene);
/// Of what is prepared already, for the frequencies and signals of the scene.
Responses respond(const scene::Scene& scene, const compile::Prepared& prepared);

/// One sentence for each effect of the scene that a linear response has no place for.
std::vector<std::string> left_out_of_linear_responses(const scene::Scene& scene, const compile::Prepared& prepared,
                                                      bool with_drag = false);

/// A run with start = "steady": motions as if the sea had always been there, which transfer functions × sea give
/// without a step. Connectors and joints are linear about rest. \throws hydro::InputError where the scene names an
/// effect that is not linear
Run steady_run(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr);

}  // namespace froude
