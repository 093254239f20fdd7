#include "fit/towing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/force/morison.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {
namespace {

void check(const Cylinder& c) {
  hydro::require(c.diameter > 0 && c.length > 0 && c.density > 0,
                 "diameter, length and density must be positive, got {} m, {} m, {} kg/m³", c.diameter, c.length,
                 c.density);
  hydro::require(!c.viscosity || *c.viscosity > 0, "the viscosity must be positive, got {} m²/s",
                 c.viscosity.value_or(0));
  hydro::require(c.mass_beyond_load_cells == 0,
                 "steady towing has no inertia force: leave out the mass beyond the load cells");
}

void check(const TowingRun& r) {
  require_towing_speed(r.speed);
  require_resistance(r.force, r.speed);
  require_deviation("speed", r.speed_deviation, r.speed);
  require_deviation("force", r.force_deviation, r.force);
}

void check(const Cylinder& c, std::span<const TowingRun> runs, double confidence) {
  check(c);
  hydro::require(!runs.empty(), "there are no towing runs");
  hydro::require(confidence > 0 && confidence < 1, "a confidence level must lie between 0 and 1, got {}", confidence);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TowingRun& r = runs[i];
    try {
      check(r);
      require_stated_alike(r, runs[0]);
    } catch (const hydro::InputError& e) {
      throw hydro::InputError(fmt::format("run {}: {}", i + 1, e.rule()), {}, e.remedy());
    }
  }
}

}  // namespace

void require_towing_speed(double speed) {
  if (!std::isfinite(speed) || speed <= 0)
    throw hydro::InputError(fmt::format("the speed must be positive, got {} m/s", speed), {},
                            "leave runs at rest out, and write a tow the other way round with both signs turned");
}

void require_resistance(double force, double speed) {
  if (!std::isfinite(force)) throw hydro::InputError("the force is not finite");
  if (force <= 0)
    throw hydro::InputError(fmt::format("the force is {} N at {} m/s: drag is positive, so it has the wrong sign, or "
                                        "the wrong zero",
                                        force, speed),
                            {}, "turn the channel round, force = \"-F\", or take the zero off first");
}

void require_deviation(const char* of, double deviation, double mean) {
  if (!(deviation >= 0) || !std::isfinite(deviation))
    throw hydro::InputError(fmt::format("the deviation of the {} must not be negative, got {}", of, deviation));
  if (deviation >= mean)
    throw hydro::InputError(
        fmt::format("the deviation of the {}, {:g}, is no smaller than the {} itself, {:g}: such a mean tells nothing",
                    of, deviation, of, mean),
        {}, "look at the unit of both columns, or leave the run out");
}

void require_stated_alike(const TowingRun& run, const TowingRun& first) {
  const auto stated = [](const TowingRun& r) { return r.force_deviation + r.speed_deviation > 0; };
  if (stated(run) != stated(first))
    throw hydro::InputError("deviations must be stated for all runs or for none", {},
                            "write that of each run, or leave the columns speed_sd and force_sd out");
}

double drag_coefficient(const Cylinder& c, double speed, double force) {
  return force / (c.length * dynamics::MorisonPerLength(c.diameter, c.density, 1, 0).drag(speed, speed));
}

TowingPoint towing_point(const Cylinder& c, const TowingRun& r) {  // (F12)
  check(c);
  check(r);
  const double cd = drag_coefficient(c, r.speed, r.force);
  TowingPoint p{
      cd, std::hypot(drag_coefficient(c, r.speed, r.force_deviation), 2 * cd * r.speed_deviation / r.speed), {}};
  if (c.viscosity) p.re = r.speed * c.diameter / *c.viscosity;
  return p;
}

TowingFit fit_towing(const Cylinder& cylinder, std::span<const TowingRun> runs, double confidence) {  // (F13)
  check(cylinder, runs, confidence);
  TowingFit fit{};
  fit.confidence = confidence;
  for (const TowingRun& run : runs) fit.points.push_back(towing_point(cylinder, run));
  const auto n = static_cast<double>(runs.size());
  const bool stated = fit.points[0].cd_deviation > 0;
  hydro::require(stated || n > 1, "one run without deviations has no uncertainty: state them, or add runs");
  double weights = 0, weighted = 0, squares = 0;
  for (const TowingPoint& p : fit.points) {
    const double w = stated ? std::pow(p.cd_deviation, -2) : 1.0;
    weights += w;
    weighted += w * p.cd;
  }
  const double mean = weighted / weights;
  for (const TowingPoint& p : fit.points) squares += std::pow((p.cd - mean) / (stated ? p.cd_deviation : 1.0), 2);
  const double scatter = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
  // With an error taken from the scatter of n runs, the quantile is Student's; with stated ones it is the normal's.
  const bool scattered = !stated || scatter > 1;
  const double own = 1 / std::sqrt(weights), normal = own * hydro::signal::normal_quantile((1 + confidence) / 2);
  const double half =
      scattered ? own * scatter * hydro::signal::student_t_quantile((1 + confidence) / 2, n - 1) : normal;
  fit.chi_square = stated ? squares : std::numeric_limits<double>::quiet_NaN();
  fit.scatter = stated ? scatter : std::numeric_limits<double>::quiet_NaN();
  fit.allowed = stated && n > 1 ? allowed_ratio(n - 1) : std::numeric_limits<double>::quiet_NaN();
  fit.cd.name = "cd";
  fit.cd.value = mean;
  fit.cd.standard_error = scattered ? own * scatter : own;
  fit.cd.interval = {mean - half, mean + half};
  fit.cd.white_interval = stated ? Interval{mean - normal, mean + normal} : fit.cd.interval;
  fit.cd.effective_samples = n;
  return fit;
}

}  // namespace fit
