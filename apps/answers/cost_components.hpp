#pragma once
/// \file  What the number of components of a sea costs. Private to apps.
#include "answers/cost_interview.hpp"
#include "froude/cost.hpp"

namespace froude {

/// Random seas of other components, each with several seeds; empty for other waves. As many seeds as `limit_s` of
/// processor time allows, or a note in `notes` why there are none.
std::vector<CostOfComponents> cost_of_components(const scene::Scene& scene, Interview& interview, const Question& own,
                                                 double limit_s, std::vector<std::string>& notes);

}  // namespace froude
