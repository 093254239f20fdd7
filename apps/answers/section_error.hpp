#pragma once
/// \file  What the size of panels does to sectional loads, (G28) in docs/theory/panels.md. Private to apps.
#include <functional>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The largest change of each signal, over its size, when a linear answer is made of these coefficients.
using RelativeChanges = std::function<std::vector<double>(const compile::Prepared&)>;

/// Adds to `error` the source "panels" of the signals of these names that are sectional loads, where one is.
/// \throws hydro::InputError at a section whose load misses the accuracy asked and what the section accepts
void add_error_of_sections(const scene::Scene& scene, const compile::Prepared& prepared,
                           const std::vector<std::string>& names, const RelativeChanges& changes, ErrorEstimate& error);

}  // namespace froude
