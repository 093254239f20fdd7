#pragma once
/// \file  Private to the commands rao, run and plan: what they share in naming, recording and drawing results.
#include <span>

#include "compile/compile.hpp"
#include "froude/commands.hpp"
#include "froude/plot.hpp"
#include "froude/result_file.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The path of the result asked for, or the scene's name with `ending` in the current folder. All that the command will
/// write is checked before it computes (outputs.hpp). \throws hydro::InputError
Path checked_output(const SceneArguments& arguments, const std::string& ending);

/// Scene text, echo and notes; wall times and energies are added by the caller.
Provenance provenance_of(const scene::Scene& scene, const std::vector<std::string>& notes);

/// True if `froude waves make` makes whole series at once for this scene, instead of asking the field at each instant.
bool is_synthesised(const scene::Scene& scene);

/// \throws hydro::InputError if the scene does not ask for this, saying how to
void require_asked(bool asked, const scene::Scene& scene, const std::string& what, const std::string& example);

}  // namespace froude
