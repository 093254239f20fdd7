#pragma once
/// \file  Any problem that libfit solves. Each kind has a namespace of its own with its Problem (what was measured and
///        what is known), its Options (how it is fitted), and solve(), whose Solution holds the Report that all kinds
///        share beside what is particular to the kind.
#include <variant>

#include "fit/problem/decay.hpp"
#include "fit/problem/friction.hpp"
#include "fit/problem/morison.hpp"
#include "fit/problem/motion.hpp"
#include "fit/problem/radiation.hpp"
#include "fit/problem/towing.hpp"

namespace fit {

using AnyProblem = std::variant<morison::Problem, towing::Problem, decay::Problem, radiation::Problem,
                                friction::Problem, motion::Problem>;

/// What the fit of a problem tells, whatever its kind. \throws what solve() of the kind throws
inline Report solve(const AnyProblem& problem) {
  return std::visit([](const auto& of_kind) { return solve(of_kind).report; }, problem);
}

}  // namespace fit
