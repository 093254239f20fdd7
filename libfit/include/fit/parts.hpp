#pragma once
/// \file  A coefficient whose error has two parts: what scatters, and what is the same throughout; (F26),
///        docs/theory/fit.md.
#include <string>

#include "fit/coefficient.hpp"

namespace fit {

/// Student's t of the scatter and the normal quantile of what is the same throughout, in one half width. `t` belongs to
/// the same confidence.
Coefficient with_parts(const std::string& name, double value, double scatter, double t, double systematic,
                       double confidence);

}  // namespace fit
