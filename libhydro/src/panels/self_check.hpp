#pragma once
/// \file  What theory and a finer mesh say of the result. (G14), (G15) in docs/theory/panels.md. Not installed.
#include <string>
#include <vector>

#include "discretisation.hpp"

namespace hydro::panels {

/// Sizes of the modes, (P11), by which numbers are measured; a tenth of the largest of the kind at least.
struct Sizes {
  Eigen::VectorXd A, B, X;
};
/// `arm` [m] is a length of the hulls.
Sizes sizes(const std::vector<OneFrequency>& results, double arm);
/// The largest of A, B and X.
double largest(const OneFrequency& difference, const Sizes& size);

/// Of each mode the largest difference of its own entries of A, B and X over their own largest values in `results`
/// (G35). NaN: symmetry leaves next to nothing of the mode.
struct OwnErrors {
  OwnErrors(const std::vector<OneFrequency>& results, double arm);
  void take(const OneFrequency& difference, double factor);
  Eigen::VectorXd of_mode;

 private:
  Sizes own_;  ///< 0: next to nothing
};
/// In words, of all bodies the largest of each mode; empty if nothing was taken. `told`: the error of all modes.
std::string in_words(const Eigen::VectorXd& own_errors, double told);

/// What the laws say of results; the estimate is NaN.
SelfCheck self_check(const std::vector<OneFrequency>& results, double arm);
/// The error that panels cut in four tell (G15): `finer` belongs to the frequencies refined[…] of `results`. `own`: of
/// each mode by itself, as OwnErrors.
double estimate_of(const std::vector<OneFrequency>& results, const std::vector<OneFrequency>& finer,
                   const std::vector<std::size_t>& refined, double arm, Eigen::VectorXd& own);

/// What the partial waves that `fewer` leaves out change, from the same with more of them.
double truncation_of(const OneFrequency& fewer, const OneFrequency& more, const Sizes& size);

}  // namespace hydro::panels
