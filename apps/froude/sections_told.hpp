#pragma once
/// \file  Private to the commands: what sections of hulls carry at rest.
#include <vector>

#include "froude/report.hpp"
#include "froude/result.hpp"

namespace froude {

/// One row a section; empty where there are none.
Report report_of(const std::vector<SectionAtRest>& sections);

}  // namespace froude
