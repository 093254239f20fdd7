#include "answers/rao_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "answers/checked_run.hpp"
#include "answers/convergence.hpp"
#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"
#include "hydro/waves/dispersion.hpp"

namespace froude {
namespace {

constexpr int periods = 80, of_ramp = 10, of_look = 40, samples_a_period = 24;

/// The scene in one regular wave, asked for the run that shows its response.
scene::Scene in_regular_wave(scene::Scene scene, double omega, double heading, double height) {
  const double period = 2 * std::numbers::pi / omega;
  scene.waves = {.kind = scene::RegularWave{.amplitude = height / 2, .period = period},
                 .heading = hydro::Angle::from_radians(heading),
                 .ramp = of_ramp * period,
                 .place = scene.rao->place};
  return asked_to_run(std::move(scene), periods * period, period / samples_a_period);
}

/// Periods from one to another of a run that ends at the last.
struct Harmonic {
  std::complex<double> amplitude;
  double rest;
};
Harmonic harmonic(const Run& run, const std::vector<double>& values, double omega, int from, int to) {
  const auto begin = from * samples_a_period, count = (to - from) * samples_a_period;
  const std::array at{omega};
  const auto fit = hydro::signal::fit_harmonics(
      std::span(run.time).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(count)),
      std::span(values).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(count)), at);
  return {fit.amplitude.at(0), fit.residual_rms};
}

/// The largest of each signal, and of signals that are next to nothing a thousandth of the largest of their unit.
std::vector<double> peaks_of(const Responses& all) {
  std::vector<double> out;
  for (const ComplexSignal& s : all.signals) {
    double& peak = out.emplace_back(0);
    for (std::size_t i = 0; i < all.omega.size(); ++i) peak = std::max(peak, std::abs(s.values[i]));
  }
  return at_least_a_thousandth(std::move(out), all.signals, &ComplexSignal::units);
}

CheckedCell cell(const ComplexSignal& linear, const Responses& all, std::size_t w, double height, double peak,
                 const Run& run) {
  const double omega = all.omega[w], amplitude = height / 2;
  const std::vector<double>& values = run.signal(linear.name);
  constexpr int first = periods - of_look, middle = periods - of_look / 2;
  const Harmonic whole = harmonic(run, values, omega, first, periods),
                 before = harmonic(run, values, omega, first, middle),
                 after = harmonic(run, values, omega, middle, periods);
  return {linear.name,
          linear.units,
          omega,
          all.heading.front(),
          height,
          linear.values[w],
          whole.amplitude / amplitude,
          peak,
          peak > 0 ? std::abs(after.amplitude - before.amplitude) / amplitude / peak : 0,
          whole.rest / amplitude};
}

/// A quarter, half and three quarters of the way, each once.
std::vector<std::size_t> some_of(std::size_t count) {
  const std::set<std::size_t> out{count / 4, count / 2, 3 * count / 4};
  return {out.begin(), out.end()};
}

/// Linear drag is that of waves of one height or steepness: they are those to check it in.
double height_of_check(const scene::Scene& scene, double omega, std::optional<double> steepness) {
  constexpr double usual = 0.002;  // of the length
  if (!steepness && scene.rao->drag) return height_of(*scene.rao->drag, omega, scene.water);
  return steepness.value_or(usual) * 2 * std::numbers::pi / hydro::waves::wavenumber(omega, scene.water);
}

}  // namespace

std::vector<CheckedCell> check_in_time(const scene::Scene& scene, const Responses& linear,
                                       std::optional<double> steepness, const std::function<void(double)>& done) {
  const std::vector<std::size_t> at = some_of(linear.omega.size());
  const std::vector<double> peak = peaks_of(linear);
  std::vector<CheckedCell> out;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double omega = linear.omega[at[i]];
    const double height = height_of_check(scene, omega, steepness);
    const auto share = [&](double part) {
      if (done) done((static_cast<double>(i) + part) / static_cast<double>(at.size()));
    };
    const Run run = simulate(in_regular_wave(scene, omega, linear.heading.front(), height), share);
    if (!run.stopped.empty())
      throw hydro::NumericsError(
          fmt::format("the run in a wave of {:.4g} m at {:.6g} rad/s stopped: {}", height, omega, run.stopped));
    for (std::size_t k = 0; k < peak.size(); ++k)
      if (linear.signals[k].name != "wave.elevation")
        out.push_back(cell(linear.signals[k], linear, at[i], height, peak[k], run));
  }
  return out;
}

}  // namespace froude
