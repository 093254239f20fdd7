#pragma once
/// \file  Decays that Coulomb friction brings to rest within the record; (F114), docs/theory/fit.md. Private to libfit.
#include <optional>
#include <vector>

#include "fit/decay.hpp"

namespace fit {

/// The samples of a record until the motion that was fitted to it comes to rest; all where it does not.
Window before_rest(const Window& record, const Eigen::MatrixXd& motion);

/// The fit from a start, or none where its search has no end.
std::optional<ShootingFit> fit_from(const ShootingProblem& start);

/// Starts from which searches end with different numbers of half cycles before the rest: about the fit of what swings.
std::vector<ShootingProblem> starts_of_rests(const ShootingProblem& decay);

/// The best of several ends of a search, whose intervals hold those of all other ends that its likelihood cannot
/// exclude: its caution says so.
struct BestEnd {
  std::size_t which;
  ShootingFit fit;
  bool has_rivals;
};
BestEnd best_of(std::vector<ShootingFit> ends, double confidence);

}  // namespace fit
