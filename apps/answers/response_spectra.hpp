#pragma once
/// \file  Spectra of responses in random seas, from transfer functions: for `froude response`. (Q8),
/// docs/theory/frequency.md.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answers/sea_drag.hpp"
#include "compile/kept.hpp"
#include "froude/result.hpp"
#include "hydro/signal/spectrum.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Of one signal; zero everywhere where next to nothing of it responds.
struct ResponseSpectrum {
  std::string name, units;  ///< of the signal
  hydro::signal::SpectrumPerHz spectrum;
};

/// What a sea makes of the signals that [ask.rao] names.
struct ResponseSpectra {
  hydro::signal::SpectrumPerHz sea;  ///< of the elevation, within the frequencies of [ask.rao]
  double left_out;                   ///< share of the sea's energy that lies outside them
  std::size_t headings;              ///< at which responses were computed
  double error;                      ///< estimated, of the moments by the spacing of frequencies and headings, relative
  std::vector<ResponseSpectrum> signals;  ///< at the frequencies of `sea`
  std::vector<std::string> notes;         ///< what had to be decided, and what is left out, but for the second order
  std::vector<std::string> warnings;      ///< what is not to be trusted
  std::optional<DragInSea> drag = {};     ///< where members have drag, in still water
  std::vector<SectionAtRest> sections = {};
};

/// One answer for each of several scenes that differ in their waves alone, which share frequencies and transfer
/// functions. Between the frequencies of [ask.rao] others are put until m₀, m₂ and m₄ of every signal are within the
/// scene's `accuracy`; headings of a sea with spreading likewise. Drag on members is linear for each sea by itself
/// (D143): frequencies and transfer functions are then each sea's own. `kept`: coefficients that are read or computed
/// once. \throws hydro::InputError for a scene without
/// [ask.rao], for waves that are no random sea, one with a crest put in, and for [ask.rao.drag], which is for one
/// height of wave; as respond(). hydro::NumericsError if a response is too sharp, or drag does not settle
std::vector<ResponseSpectra> response_spectra(
    const std::vector<const scene::Scene*>& seas,
    const std::shared_ptr<compile::Kept>& kept = std::make_shared<compile::Kept>());

}  // namespace froude
