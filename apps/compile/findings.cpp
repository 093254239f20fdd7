#include "compile/findings.hpp"

#include <algorithm>
#include <string_view>

#include "hydro/potential/operations/operations.hpp"

namespace froude::compile {
namespace {

using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;

// Checks that look at A and B, and say in which modes; without these modes they look at the others. Those of long waves
// and of still water need all six modes of a body.
constexpr std::array of_matrices{"symmetry of A",  "symmetry of B",     "reciprocity of A",     "reciprocity of B",
                                 "sign of B",      "passivity of B",    "positivity of A(inf)", "spikes",
                                 "Kramers-Kronig", "A(inf) by Ogilvie", "low-frequency tail",   "high-frequency tail"};
constexpr std::string_view of_matrices_and_excitation = "Haskind relation";

bool looks_at_matrices(const Finding& f) {
  return std::find(of_matrices.begin(), of_matrices.end(), f.check) != of_matrices.end();
}

bool has_idle_modes(const TakenCoefficients& taken) {
  return std::any_of(taken.modes.begin(), taken.modes.end(), [](const std::array<bool, 6>& modes) {
    return std::find(modes.begin(), modes.end(), false) != modes.end();
  });
}

/// A, B and X without the modes that have no effect.
Coefficients without_idle_modes(Coefficients c, const TakenCoefficients& taken) {
  for (std::size_t b = 0; b < taken.modes.size(); ++b)
    for (std::size_t mode = 0; mode < 6; ++mode) {
      if (taken.modes[b][mode]) continue;
      const auto at = static_cast<Eigen::Index>(6 * b + mode);
      const auto clear = [&](auto& m) {
        m.row(at).setZero();
        if (m.cols() == m.rows()) m.col(at).setZero();
      };
      for (auto* list : {&c.A, &c.B})
        for (auto& m : *list) clear(m);
      if (c.A_zero) clear(*c.A_zero);
      if (c.A_inf) clear(*c.A_inf);
      for (auto& X : c.X) X.row(at).setZero();
    }
  return c;
}

bool has_error(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::error; });
}

/// Each error gives place to the finding of the same check among `others`, if `concerned` says so and that is milder.
template <class Concerned>
void replace_errors(std::vector<Finding>& findings, const std::vector<Finding>& others, Concerned concerned) {
  for (Finding& f : findings) {
    if (f.severity != Severity::error || !concerned(f)) continue;
    const auto found =
        std::find_if(others.begin(), others.end(), [&](const Finding& other) { return other.check == f.check; });
    if (found != others.end() && found->severity <= f.severity) f = *found;
  }
}

}  // namespace

std::vector<Finding> findings_in(const Coefficients& c, const TakenCoefficients& taken) {
  std::vector<Finding> findings = hydro::potential::check(c);
  if (!taken.radiation)
    std::erase_if(findings, [](const Finding& f) { return f.severity == Severity::error && looks_at_matrices(f); });
  if (!has_error(findings)) return findings;
  const Coefficients of_bodies = hydro::potential::select(c, taken.bodies);
  const bool all_bodies = static_cast<int>(taken.bodies.size()) == c.bodies();
  const auto is_taken = [&](int body) {
    return std::find(taken.bodies.begin(), taken.bodies.end(), body) != taken.bodies.end();
  };
  const auto is_elsewhere = [&](const Finding& f) {
    return !all_bodies && ((f.body && !is_taken(*f.body - 1)) ||
                           (f.entry && !(is_taken(((*f.entry)[0] - 1) / 6) && is_taken(((*f.entry)[1] - 1) / 6))));
  };
  if (!all_bodies) replace_errors(findings, hydro::potential::check(of_bodies), is_elsewhere);
  if (has_error(findings) && (!all_bodies || has_idle_modes(taken)))
    replace_errors(findings, hydro::potential::check(without_idle_modes(of_bodies, taken)),
                   [](const Finding& f) { return looks_at_matrices(f) || f.check == of_matrices_and_excitation; });
  return findings;
}

}  // namespace froude::compile
