#pragma once
/// \file  Other ways to read the same record, and what a fit has left over; (F29)-(F30), docs/theory/fit.md.
#include <Eigen/Core>

#include <span>
#include <vector>

#include "fit/morison.hpp"

namespace fit {

/// Coefficients of one cycle by least squares.
struct CycleFit {
  double start, end;  ///< s
  double cd, inertia;
};
/// One fit for each stretch between two neighbouring `starts` (s). \throws hydro::InputError for a stretch of fewer
/// than 8 samples or a record that does not cover them
std::vector<CycleFit> fit_cycles(const Cylinder& cylinder, const ForceRecord& record, std::span<const double> starts);

/// Coefficients from the main harmonic alone (Keulegan & Carpenter 1958): what least squares would give were all of
/// the drag in its first harmonic.
struct FourierAverages {
  double cd, inertia;
};
/// \throws hydro::InputError for a record shorter than one period
FourierAverages fourier_averages(const Cylinder& cylinder, const ForceRecord& record, double period_s);

struct HarmonicLeft {
  int number;        ///< of the main frequency
  double amplitude;  ///< N
  double relative;   ///< to the force's rms times √2
};
/// What the residuals still hold.
struct ResidualReport {
  std::vector<HarmonicLeft> harmonics;  ///< 1 to 7
  double harmonic_share;                ///< of the residuals' variance that lies in those harmonics, 0 … 1
  double lag_one;                       ///< correlation of neighbouring block means (a fortieth of the period)
  double ljung_box_p;                   ///< probability of so much autocorrelation over 20 block means, were they white
};
/// \throws hydro::InputError for fewer than 64 samples
ResidualReport look_at_residuals(const Eigen::VectorXd& residuals, double force_rms, double step_s, double period_s);

}  // namespace fit
