#pragma once
/// \file  Scenes of cases: the very files that a user would run, with the folder of the reference data put in.
#include "harness/case.hpp"
#include "scene/scene.hpp"

namespace froude::validation {

/// Reads validation/<case>/scene.toml, or another file there, in which the data are at ../../../shared/data/…; `needs` is one of them. Where
/// the scene says `from` (if anything), `to` is read instead. \throws MissingData if the data are absent
scene::Scene read_scene(const Folders& folders, const std::string& needs, const std::string& from = {},
                        const std::string& to = {}, const std::string& name = "scene.toml");

}  // namespace froude::validation
