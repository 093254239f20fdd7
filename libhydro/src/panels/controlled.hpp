#pragma once
/// \file  Refinement until an error is met. (G16), (G17) in docs/theory/panels.md. Not installed.
#include <optional>
#include <vector>

#include "discretisation.hpp"

namespace hydro::panels {

/// What is lost by panels' size, by refining at some frequencies only, and by the partial waves that are left out
/// between hulls, relative (P11).
struct Estimate {
  double panels = 0, interpolation = 0, truncation = 0;
  double total() const { return panels + interpolation + truncation; }
};

/// What a solution is filled from.
struct Work {
  std::vector<OneFrequency> results;  ///< of each frequency
  /// With sections, results that are as far off as is told, (G28): by panels, by interpolation between frequencies, and
  /// by the division of panels at sections.
  std::vector<std::vector<OneFrequency>> doubted = {};
  Eigen::MatrixXd A_inf;
  std::optional<Eigen::MatrixXd> A_zero;  ///< deep water only
  SelfCheck check;
  Eigen::VectorXd own_error = {};  ///< of each mode, see OwnErrors; empty where no error is estimated
};

/// Values of panels of no size on the faces of `given`, to the tolerance of `options`.
/// \throws InputError with the numbers if the tolerance cannot be met
Work controlled_work(const Discretisation& given, const std::vector<double>& omega, const std::vector<double>& heading,
                     const Options& options);

/// At how many frequencies meshes are refined at first.
int first_samples(const Options& options);

}  // namespace hydro::panels
