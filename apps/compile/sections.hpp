#pragma once
/// \file  Private to apps: sectional loads of `[[body.section]]`, in responses to waves. (D160) in
/// docs/theory/loads.md.
#include <vector>

#include "compile/compile.hpp"
#include "compile/signal_list.hpp"

namespace froude::compile {

bool any_sections(const scene::Scene& scene);

/// Sections of `prepared`, whose groups are there already, from the pressures of its meshes. \throws hydro::InputError
/// where the body has another hull in still water
void add_sections(const scene::Scene& scene, Prepared& prepared);

/// Six loads a section on the part that it describes: "barge.midship.force_x" … "barge.midship.moment_z". `model`: of
/// small motions, made of `prepared`. \throws hydro::InputError at a section on whose part something acts of which no
/// load is told
void add_section_signals(const scene::Scene& scene, const Prepared& prepared, const dynamics::Model& model,
                         std::vector<Signal>& out);

/// What each section carries where the bodies are still. \throws hydro::InputError as add_section_signals()
std::vector<SectionAtRest> sections_at_rest(const scene::Scene& scene, const Prepared& prepared,
                                            const dynamics::frequency::SmallMotions& about);

/// The section whose load a signal is; null: of none.
const scene::Section* section_of_signal(const scene::Scene& scene, const std::string& signal);

/// The same prepared of coefficients that are as far off as the error of panels is told, where there are sections: by
/// the size of panels, by refining at some frequencies only, and by dividing panels (G28), (G30).
std::vector<Prepared> doubted(const scene::Scene& scene, const Prepared& prepared);

/// \throws hydro::InputError at the first section of a scene that is to be stepped
void require_no_sections(const scene::Scene& scene);

}  // namespace froude::compile
