#pragma once
/// \file  Responses per metre of wave: for `froude rao`, and for runs that need no stepping.
#include <string>
#include <vector>

#include "compile/signal_list.hpp"
#include "froude/scene_result.hpp"
#include "froude/simulate.hpp"

namespace froude {

/// Signals per metre of wave along `heading`, rad, about where the bodies are still, from displacements `xi` (6N, Nω)
/// and multipliers (m, Nω) of joints, which may be of no size.
std::vector<ComplexSignal> linear_responses(const std::vector<compile::Signal>& signals,
                                            const dynamics::frequency::SmallMotions& about, const Eigen::MatrixXcd& xi,
                                            const Eigen::MatrixXcd& multipliers, const std::vector<double>& omega,
                                            double heading);

/// What `froude rao` writes: the signals that [ask.rao] names, per metre of wave, at its frequencies and headings.
struct Responses {
  std::vector<double> omega;           ///< rad/s
  std::vector<double> heading;         ///< rad, where the waves go; in the order asked
  std::vector<ComplexSignal> signals;  ///< heading by heading: value of heading h, frequency w at h Nω + w
  std::vector<std::string> notes;
  /// \throws hydro::InputError if there is no such signal
  const ComplexSignal& signal(const std::string& name) const;
};
/// \throws hydro::InputError, hydro::NumericsError; std::logic_error for a scene that asks for no RAO, or for one
/// without a heading, which no reader makes
Responses respond(const scene::Scene& scene);
/// Of what is prepared already, for the frequencies and signals of the scene.
Responses respond(const scene::Scene& scene, const compile::Prepared& prepared);

/// One sentence for each effect of the scene that a linear response has no place for.
std::vector<std::string> left_out_of_linear_responses(const scene::Scene& scene, bool with_drag = false);

/// A run with start = "steady": motions as if the sea had always been there, which transfer functions × sea give
/// without a step. Connectors and joints are linear about rest. \throws hydro::InputError where the scene names an
/// effect that is not linear
Record steady_run(const scene::Scene& scene);

}  // namespace froude
