#pragma once
/// \file  The report of libfit as the program tells it. Private to apps/froude.
#include "fit/report.hpp"
#include "froude/report.hpp"

namespace froude {

/// Lines and facts of a fit whose intervals are at this level.
Report told(const ::fit::Report& fit, double confidence);

}  // namespace froude
