#pragma once
/// \file  How a result came about, as far as its scene tells.
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Text, every key that acts, seeds.
Provenance provenance_of(const scene::Scene& scene);

/// Notes are numbered, so that each has a name of its own.
/// `kind`: what they are called, "note" or "warning".
void add_notes(const std::vector<std::string>& notes, Provenance& provenance, const std::string& kind = "note");

}  // namespace froude
