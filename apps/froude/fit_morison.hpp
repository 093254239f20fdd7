#pragma once
/// \file  Runs of a Morison fit, and what is told of them. Private to apps/froude.
#include <string>
#include <vector>

#include "fit/diagnose.hpp"
#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "froude/fit_summary.hpp"

namespace froude {

/// A fit repeated with one choice made otherwise.
struct MorisonVariant {
  std::string what;    ///< "low pass at 2.33 Hz"
  double cd, inertia;  ///< changes
};

/// One file of a Morison fit.
struct MorisonRun {
  std::string name;  ///< of the file
  RunLabels labels;
  ::fit::Cylinder cylinder;
  ::fit::Prepared prepared;  ///< what was fitted, and the steps that led there
  ::fit::MorisonFit fit;
  ::fit::ResidualReport left;  ///< in the residuals
  ::fit::FourierAverages fourier;
  std::vector<::fit::CycleFit> cycles;   ///< where asked for
  std::vector<MorisonVariant> variants;  ///< where asked for
  std::vector<::fit::Coefficient> asked;
};

/// The law of one coefficient over all runs.
struct CoefficientLaw {
  std::string coefficient;                 ///< "cd", "ca", "cm"
  std::vector<::fit::RandomEffects> laws;  ///< the one asked for, or all, best first
  std::size_t runs, left_out;              ///< fitted; not identifiable
};

FitSummary summary_of(const scene::FitScene& scene, const scene::MorisonModel& model,
                      const std::vector<MorisonRun>& runs, const std::vector<CoefficientLaw>& laws);
/// Force and residual of each run; of three runs and more, the coefficients over KC and the map of KC and Re.
plot::Figure runs_figure(const scene::FitScene& scene, const std::vector<MorisonRun>& runs,
                         const std::vector<CoefficientLaw>& laws);
/// One row for each run, as CSV; cells of what is not identifiable are empty.
std::string runs_table(const std::vector<MorisonRun>& runs);

}  // namespace froude
