#pragma once
/// \file  Private to the commands that answer scenes: what they share in naming results.
#include <string>

#include "froude/commands.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The path of the result asked for, or the scene's name with `ending` in the current folder. All that the command will
/// write is checked before it computes (outputs.hpp). \throws hydro::InputError
Path checked_output(const SceneArguments& arguments, const std::string& ending);

/// \throws hydro::InputError if the scene does not ask for this, saying how to
void require_asked(bool asked, const scene::Scene& scene, const std::string& what, const std::string& example);

}  // namespace froude
