#pragma once
/// \file  Any problem that libfit solves. Each kind has a namespace of its own with its Problem (what was measured and
///        what is known), its Options (how it is fitted), and solve(), whose Solution holds the Report that all kinds
///        share beside what is particular to the kind. A kind of somebody else's that has these is one too.
#include <any>
#include <concepts>
#include <utility>

#include "fit/report.hpp"

namespace fit {

class AnyProblem;

template <class P>
concept IsProblem = !std::same_as<P, AnyProblem> && requires(const P& problem) {
  { solve(problem).report } -> std::convertible_to<Report>;
};

/// A problem whose kind is forgotten.
class AnyProblem {
 public:
  template <IsProblem P>
  AnyProblem(P problem)  // NOLINT: a problem of one kind is one of any
      : problem_(std::move(problem)), solve_([](const std::any& of) { return solve(*std::any_cast<P>(&of)).report; }) {}
  /// The problem, where it is of this kind; else null.
  template <IsProblem P>
  P* as() {
    return std::any_cast<P>(&problem_);
  }

 private:
  friend Report solve(const AnyProblem& problem);
  std::any problem_;
  Report (*solve_)(const std::any& of);
};

/// What the fit of a problem tells, whatever its kind. \throws what solve() of the kind throws
inline Report solve(const AnyProblem& problem) { return problem.solve_(problem.problem_); }

}  // namespace fit
