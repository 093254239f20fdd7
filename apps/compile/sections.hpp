#pragma once
/// \file  Private to compile/: sectional loads of `[[body.section]]`, in responses to waves. (D160) in
/// docs/theory/loads.md.
#include <vector>

#include "compile/compile.hpp"
#include "compile/signal_list.hpp"

namespace froude::compile {

bool any_sections(const scene::Scene& scene);

/// Sections of `prepared`, whose groups are there already, from the pressures of its meshes. \throws hydro::InputError
/// at a section on whose part something acts that has no share in its loads
void add_sections(const scene::Scene& scene, Prepared& prepared);

/// Six loads a section on the part that it describes: "barge.midship.force_x" … "barge.midship.moment_z".
void add_section_signals(const scene::Scene& scene, const Prepared& prepared, std::vector<Signal>& out);

/// \throws hydro::InputError at the first section of a scene that is to be stepped
void require_no_sections(const scene::Scene& scene);

}  // namespace froude::compile
