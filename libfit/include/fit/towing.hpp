#pragma once
/// \file  Drag coefficient of a body towed steadily; (F12)-(F13), docs/theory/fit.md.
#include <optional>
#include <span>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/morison.hpp"

namespace fit {

/// One run at constant speed. Deviations are standard uncertainties of the two means; if a source states the scatter
/// of samples instead, the result is on the safe side. Both 0 in every run: not known.
struct TowingRun {
  double speed;            ///< U, m/s
  double speed_deviation;  ///< m/s
  double force;            ///< F, N, along the motion's resistance: positive
  double force_deviation;  ///< N
};

struct TowingPoint {
  double cd;            ///< F/(½ρU²DL)
  double cd_deviation;  ///< by propagation, speed and force independent
  std::optional<double> re;
};

/// The rules of a run, number by number, for whoever knows where each is from. \throws hydro::InputError
void require_towing_speed(double speed);
void require_resistance(double force, double speed);
/// Of a mean, by its name: not negative, and smaller than the mean itself.
void require_deviation(const char* of, double deviation, double mean);
/// Deviations must be stated for all runs or for none.
void require_stated_alike(const TowingRun& run, const TowingRun& first);

/// F/(½ρU²DL), of one sample or a mean; noise of a sample may have turned its sign.
double drag_coefficient(const Cylinder& cylinder, double speed, double force);
/// C_D of one run, (F12). \throws hydro::InputError for a run or a cylinder that fit_towing() refuses
TowingPoint towing_point(const Cylinder& cylinder, const TowingRun& run);

struct TowingFit {
  std::vector<TowingPoint> points;  ///< in the order of the runs
  Coefficient cd;     ///< weighted mean of the runs; `white_interval` is that of the stated deviations alone
  double chi_square;  ///< Σ((C_i − C̄)/σ_i)², n − 1 degrees of freedom; NaN where deviations are not known
  double scatter;     ///< √(χ²/(n − 1)): above 1 the runs differ by more than their deviations explain; NaN …
  double allowed;     ///< the largest scatter that the deviations allow (F66): beyond it there is no one C_D; NaN …
  double confidence;
};

/// C_D of each run and of all together, weighted by 1/σ². Where the runs scatter more than they should (scatter > 1)
/// the standard error of the mean is multiplied by the scatter (Birge); it is never reduced. One run gives its own
/// interval. Where no run states deviations, all weigh alike and the error of the mean is that of their scatter. The
/// mean supposes that C_D does not depend on speed: look at the points first. \throws hydro::InputError for no runs, a
/// speed that is not positive, a value that is not finite, deviations that are negative, as large as the mean or stated
/// for some runs only, a single run without deviations, or a mass beyond the load cells (steady motion has no inertia
/// force)
TowingFit fit_towing(const Cylinder& cylinder, std::span<const TowingRun> runs, double confidence = 0.95);

}  // namespace fit
