#pragma once
/// \file  What is asked for, whether it can be done, and what it takes. Not installed.
#include <cstddef>
#include <vector>

#include "panel_mesh.hpp"

namespace hydro::panels {

/// \throws InputError as solve(), for all but the hulls
void check_request(const std::vector<double>& omega, const std::vector<double>& heading, const Options& options);
/// \throws InputError if the centre of a panel is inside another body
void require_apart(const PanelMesh& mesh, const std::vector<HullBody>& bodies);
/// True if a panel that waves of rad/s `highest` reach is longer than a fifth of them; over a panel that faces up they
/// are as short as the water there is shallow (G34).
bool too_long(const PanelMesh& mesh, const Water& water, double highest);
/// \throws InputError if too_long()
void require_short_panels(const PanelMesh& mesh, const Water& water, double highest);
/// Of `mesh`, and of it refined at so many frequencies. `threads` as in Options.
Cost cost_of(const PanelMesh& mesh, std::size_t bodies, std::size_t frequencies, std::size_t headings, int threads,
             int refined_frequencies);
/// Of a complex multiplication, by which costs are compared: a choice must not hang on how busy the machine is.
inline constexpr double multiplication_seconds = 1.6e-9;
/// \throws InputError if the machine has less
void require_memory(const Cost& cost);
/// Where panels are cut in four: both ends and evenly between; a single one is the last.
std::vector<std::size_t> frequencies_to_refine(std::size_t all, int wanted);

}  // namespace hydro::panels
