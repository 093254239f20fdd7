#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/diagnose.hpp"
#include "fit/morison.hpp"
#include "harness/case.hpp"

namespace froude::validation::morison {
namespace {

/// Force and motion in closed form: five sinusoids that share no period, or one.
::fit::ForceRecord made(const ::fit::Cylinder& c, double cd, double inertia, double amplitude, bool irregular) {
  ::fit::ForceRecord r;
  for (int j = 0; j < 8000; ++j) {
    const double t = 0.01 * j;
    double v = 0, a = 0;
    for (int k = 1; k <= (irregular ? 5 : 1); ++k) {
      const double omega = irregular ? 0.9 + 0.313 * k * k : 2 * std::numbers::pi / 4, size = amplitude / k;
      v += size * omega * std::cos(omega * t + k);
      a -= size * omega * omega * std::sin(omega * t + k);
    }
    r.time.push_back(t);
    r.velocity.push_back(v);
    r.acceleration.push_back(a);
    r.force.push_back(::fit::morison_force(c, cd, inertia, v, a));
  }
  return r;
}

}  // namespace

Outcome outcome(const Folders&) {
  double worst = 0, worst_delayed = 0, fourier = 0;
  for (const auto experiment : {::fit::Experiment::water_moves, ::fit::Experiment::body_moves})
    for (const bool irregular : {false, true})
      for (const double cd : {0.6, 1.2, 3.5})
        for (const double inertia : {0.8, 2.0}) {
          const ::fit::Cylinder c{.diameter = 0.12,
                                  .length = 0.5,
                                  .density = 997,
                                  .viscosity = {},
                                  .experiment = experiment,
                                  .mass_beyond_load_cells = experiment == ::fit::Experiment::body_moves ? 5.9 : 0.0};
          const auto record = made(c, cd, inertia, 0.4, irregular);
          const auto fit = ::fit::fit_morison(c, record);
          worst = std::max(
              {worst, std::abs(fit.cd.value.value_or(9) - cd), std::abs(fit.inertia.value.value_or(9) - inertia)});
          const auto delayed = ::fit::fit_morison_and_delay(c, record, 0.5).fit;
          worst_delayed = std::max(worst_delayed, std::abs(delayed.delay->value.value_or(9)));
          if (!irregular) fourier = std::max(fourier, std::abs(::fit::fourier_averages(c, record, 4).cd - cd));
        }
  return {.numbers = {{"largest difference of a coefficient", worst, ""},
                      {"largest delay found where there is none", worst_delayed, "s"},
                      {"largest difference of C_D from the main harmonic alone", fourier, ""}}};
}

}  // namespace froude::validation::morison
