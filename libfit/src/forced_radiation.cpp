#include "fit/forced_radiation.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "fit/correlated.hpp"
#include "harmonic_series.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"
#include "restored_body.hpp"

namespace fit {
namespace {

constexpr int force_harmonics = 3;

/// Student's t that an interval was made with.
double quantile_of(const Coefficient& c) {
  return c.standard_error > 0 ? (c.interval.high - c.interval.low) / (2 * c.standard_error) : 0;
}

/// Standard error without what is the same throughout.
double scatter_of(const Coefficient& c) {
  return std::sqrt(std::max(0.0, c.standard_error * c.standard_error - c.systematic_error * c.systematic_error));
}

/// What A and B of point i are moved by.
using Shift = std::function<Eigen::Vector2d(std::size_t)>;

hydro::radiation::RationalFit poles_of(const std::vector<RadiationPoint>& points, double tolerance,
                                       const Shift& shift) {
  hydro::radiation::DampingTable table;
  std::vector<Eigen::MatrixXd> added;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d by = shift(i);
    table.omega.push_back(points[i].omega);
    added.push_back(Eigen::MatrixXd::Constant(1, 1, *points[i].added_mass.value + by[0]));
    table.B.push_back(Eigen::MatrixXd::Constant(1, 1, *points[i].damping.value + by[1]));
  }
  return hydro::radiation::fit(
      table, added, std::nullopt,
      {.tolerance = tolerance, .largest_order = static_cast<int>(std::min<std::size_t>(20, points.size() - 1))});
}

}  // namespace

AddedMass added_mass(const DecayFit& decay, const RestoredBody& body, double confidence) {  // (F54)
  check(body);
  hydro::require(body.stiffness > 0, "without stiffness there is no natural period");
  const Coefficient& omega0 = decay.motion.parameters[0];
  hydro::require(omega0.value.has_value(), "the record does not tell its period: {}", omega0.why_not);
  AddedMass out;
  out.omega = *omega0.value;
  const double all = body.stiffness / (out.omega * out.omega), t = quantile_of(omega0);
  out.added_mass = with_parts("added_mass", all - body.mass, 2 * all * omega0.standard_error / out.omega, t,
                              std::hypot(all * body.stiffness_error, body.mass * body.mass_error), confidence);
  if (Coefficient& a = out.added_mass; a.interval.low <= 0 && a.interval.high >= 0) {
    a.why_not = fmt::format("mass and period are not known well enough to tell it from zero ({:.3g} to {:.3g})",
                            a.interval.low, a.interval.high);
    a.value.reset();
  }
  for (const Coefficient& term : decay.damping) {
    if (!term.value) {
      out.damping.push_back(term);
      continue;
    }
    // The period is known much better than a damping: its error does not enter, that of the stiffness does.
    out.damping.push_back(with_parts(term.name, *term.value * all, all * term.standard_error, quantile_of(term),
                                     std::abs(*term.value) * all * body.stiffness_error, confidence));
  }
  return out;
}

RadiationPoint fit_radiation(std::span<const double> time, std::span<const double> motion,
                             std::span<const double> force, const RestoredBody& body, double confidence) {  // (F55)
  check(body);
  const std::size_t n = time.size();
  hydro::require(motion.size() == n && force.size() == n, "{} times, {} motions, {} forces: they must be as many", n,
                 motion.size(), force.size());
  hydro::require(n >= 64, "a forced oscillation needs 64 samples at least, got {}", n);
  const double step = hydro::signal::even_step(time);
  const auto as = [n](std::span<const double> v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(n)));
  };
  const Eigen::VectorXd t = as(time), x = as(motion), f = as(force);
  hydro::require(x.allFinite() && f.allFinite(), "motion or force holds a value that is not finite");
  hydro::require(x.maxCoeff() > x.minCoeff(), "the body does not move");
  const double omega = frequency_of(x.array() - x.mean(), step);
  const HarmonicSeries moved = fit_series(t, x, omega, 1, step),
                       carried = fit_series(t, f, omega, force_harmonics, step);
  const std::complex<double> x1 = moved.amplitude(1), f1 = carried.amplitude(1);
  const double amplitude = std::abs(x1);
  hydro::require(moved.rms < 0.1 * amplitude / std::numbers::sqrt2,
                 "{:.2g} % of the motion is not in one sinusoid of {:.4g} Hz: it is not steady, or not one frequency",
                 100 * moved.rms * std::numbers::sqrt2 / amplitude, omega / (2 * std::numbers::pi));
  // F₁ = −(C − ω²(M + A) + iωB) X₁
  const std::complex<double> d = -f1 / x1;
  RadiationPoint p{.omega = omega,
                   .amplitude = amplitude,
                   .added_mass = {},
                   .damping = {},
                   .second_harmonic = std::abs(carried.amplitude(2) / f1),
                   .third_harmonic = std::abs(carried.amplitude(3) / f1),
                   .residual_rms = carried.rms,
                   .caution = carried.repeats || moved.repeats
                                  ? "what is left hardly forgets within the record, or repeats: it is an error of the "
                                    "model more than noise, which no interval made from scatter covers"
                                  : "",
                   .fitted = {carried.fitted.begin(), carried.fitted.end()}};
  const double scatter = std::hypot(carried.error() / amplitude, std::abs(d) * moved.error() / amplitude),
               q = hydro::signal::student_t_quantile((1 + confidence) / 2, std::min(carried.dof, moved.dof)),
               squared = omega * omega;
  p.added_mass =
      with_parts("added_mass", (body.stiffness - d.real()) / squared - body.mass, scatter / squared, q,
                 std::hypot(body.stiffness * body.stiffness_error / squared, body.mass * body.mass_error), confidence);
  p.damping = with_parts("damping", d.imag() / omega, scatter / omega, q, 0, confidence);
  return p;
}

RadiationMemory fit_radiation_memory(std::span<const RadiationPoint> points, double confidence) {  // (F56)
  hydro::require(points.size() >= 5, "poles need added mass and damping at five frequencies at least, got {}",
                 points.size());
  std::vector<RadiationPoint> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.omega < b.omega; });
  double largest = 0, error = 0, last = 0;
  for (const RadiationPoint& p : sorted) {
    hydro::require(p.omega > last * (1 + 1e-3), "two runs have the frequency {:.4g} rad/s: keep one of them", p.omega);
    last = p.omega;
    hydro::require(p.damping.interval.high > 0,
                   "the damping at {:.4g} rad/s is negative, {:.3g} at most: look at the signs", p.omega,
                   p.damping.interval.high);
    largest = std::max(largest, *p.damping.value);
    error = std::max({error, scatter_of(p.damping), p.omega * scatter_of(p.added_mass)});
  }
  RadiationMemory out{{}, std::max(1e-3, 2 * error / largest), {}, {}};
  const auto fitted = [&](const Shift& shift) { return poles_of(sorted, out.tolerance, shift); };
  out.poles = fitted([](std::size_t) { return Eigen::Vector2d(0, 0); });
  // Four errors, which one table of ten points in a thousand leaves by chance.
  if (const auto& r = out.poles.report; r.error > 2 * out.tolerance) {
    out.refused = out.limit.why_not =
        fmt::format("{} poles differ from the points by {:.2g} of the largest damping, which are known to {:.2g}: {}",
                    r.order, r.error, out.tolerance, r.why);
    return out;
  }
  const double limit = out.poles.A_inf(0, 0);
  if (error > 0.016 * largest) {  // three deviations stay within the 5 % below zero that a table of damping may have
    out.limit.name = "added_mass_limit";
    out.limit.why_not =
        fmt::format("the points are known to {:.2g} % of the largest damping only", 100 * error / largest);
    return out;
  }
  constexpr int draws = 40;
  double squares = 0;
  for (int d = 0; d < draws; ++d) {
    const hydro::RandomStream random(1, static_cast<std::uint64_t>(d));
    const auto redrawn = fitted([&](std::size_t i) {
      return Eigen::Vector2d(scatter_of(sorted[i].added_mass) * random.normal(2 * i),
                             scatter_of(sorted[i].damping) * random.normal(2 * i + 1));
    });
    squares += std::pow(redrawn.A_inf(0, 0) - limit, 2) / draws;
  }
  const auto moved = fitted([&](std::size_t i) { return Eigen::Vector2d(sorted[i].added_mass.systematic_error, 0); });
  out.limit = with_parts("added_mass_limit", limit, std::sqrt(squares),
                         hydro::signal::student_t_quantile((1 + confidence) / 2, draws - 1),
                         std::abs(moved.A_inf(0, 0) - limit), confidence);
  return out;
}

}  // namespace fit
