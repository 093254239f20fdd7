#pragma once
/// \file  Responses per metre of wave: for `froude rao`, and for runs that need no stepping.
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "compile/signal_list.hpp"
#include "dynamics/frequency/signal_amplitudes.hpp"
#include "froude/result.hpp"
#include "hydro/base/parallel.hpp"

namespace froude {

/// Height, m, of the waves of this frequency, rad/s, for which [ask.rao.drag] makes drag linear.
double height_of(const scene::AskRao::DragIn& waves, double omega, const hydro::Water& water);

/// Frequencies, rad/s, in each of several headings, rad.
struct Cells {
  std::vector<double> omega, headings;
};

/// How signals vary with small motions about where the bodies are still, one each.
std::vector<dynamics::Variation> variations_of(const std::vector<compile::Signal>& signals,
                                               const dynamics::frequency::SmallMotions& about);

/// Signals per metre of wave about where the bodies are still, heading by heading, from the amplitudes of these cells.
std::vector<ComplexSignal> linear_responses(const std::vector<compile::Signal>& signals,
                                            const dynamics::frequency::SmallMotions& about,
                                            const dynamics::frequency::Amplitudes& found, const Cells& cells);

/// How respond() goes about it.
struct HowToRespond {
  int threads = hydro::all_processors();  ///< which share the frequencies; numbers do not depend on how many there are
  bool refine =
      false;  ///< frequencies are put between those asked for, until straight lines are within `accuracy` (Q15)
  bool judge_sections = true;  ///< errors of sectional loads are told, and refused where they miss the accuracy asked
  const Eigen::VectorXd* drag_of_sea =
      nullptr;  ///< coefficients of the pieces of members with drag, N s/m, in place of [ask.rao.drag] (D143)
};

/// The signals that [ask.rao] names, at its frequencies and headings.
/// \throws hydro::InputError, hydro::NumericsError; std::logic_error for a scene that asks for no RAO, or for one
/// without a heading, which no reader makes
Responses respond(const scene::Scene& scene);
/// Of what is prepared already, for the frequencies and signals of the scene.
Responses respond(const scene::Scene& scene, const compile::Prepared& prepared, const HowToRespond& how = {});

/// In one wave, per metre of its amplitude.
struct MotionInWave {
  Eigen::VectorXcd xi;  ///< displacements of all bodies about their centres of gravity, (6N), m/m and rad/m
  /// W/m², what dampers, connectors, joints and moorings take of the motion: as much as the bodies take from the waves.
  /// Empty where loads on members bring in or take power too, or radiation is left out.
  std::optional<double> damped;
};
/// As respond() has them: with the drag and about the rest of [ask.rao], where there is one.
/// \throws hydro::InputError, hydro::NumericsError
MotionInWave motions_in_wave(const scene::Scene& scene, const compile::Prepared& prepared, double omega, double heading,
                             const scene::Place& place, std::vector<std::string>& notes);

/// Without dimension: rotations over the slope kζ of the wave, translations over its amplitude ζ, as they are; loads
/// stay per metre of amplitude.
Responses over_wave_slope(Responses responses, const hydro::Water& water);

/// One sentence for each effect of the scene that a linear response has no place for.
std::vector<std::string> left_out_of_linear_responses(const scene::Scene& scene, const compile::Prepared& prepared,
                                                      bool with_drag = false);

/// A run with start = "steady": motions as if the sea had always been there, which transfer functions × sea give
/// without a step. Connectors and joints are linear about rest. \throws hydro::InputError where the scene names an
/// effect that is not linear
Run steady_run(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept = nullptr, int threads = 1);

}  // namespace froude
