#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "harness/case.hpp"
#include "harness/hendriksen.hpp"
#include "hydro/base/random.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::hendriksen_oscillation {
namespace {

constexpr double two_pi = 2 * std::numbers::pi, step = 0.001;
constexpr int seeds = 20, build_up = 3, full = 7, run_down = 1;
const ::fit::Cylinder cylinder{.diameter = 0.12,
                               .length = 0.5,
                               .density = 997,
                               .viscosity = 1.05e-6,
                               .experiment = ::fit::Experiment::body_moves,
                               .mass_beyond_load_cells = 5.9};

struct Row {
  double amplitude, period, cd, cm, rmse;
};

/// Amplitude of cycle c, a share of the full one: grows and falls over whole cycles.
double ramp(double c) {
  const double x = std::clamp(std::min(c / build_up, build_up + full + run_down - c), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Two load cells in newtons with offsets, lines of the structure and noise with a memory of 0.2 s; a position with
/// 0.1 mm of noise; a second at rest on either side.
::fit::RawRun made(const Row& row, int seed) {
  const hydro::RandomStream random(static_cast<std::uint64_t>(seed), 33);
  const double omega = two_pi / row.period, phi = std::exp(-step / 0.2), cells = std::sqrt(0.5);
  const auto n = static_cast<std::size_t>((2 + (build_up + full + run_down) * row.period) / step);
  ::fit::RawRun run;
  run.force = {{"F1", {}, {}, {}}, {"F2", {}, {}, {}}};
  double e[2] = {row.rmse * cells * random.normal(0), row.rmse * cells * random.normal(1)};
  const double lines[] = {5, 7, 8, 14, 17, 21, 42};  // Hz, appendix C
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j), at = t - 1, r = ramp(at / row.period);
    const double v = r * row.amplitude * omega * std::cos(omega * at);
    const double a = -r * row.amplitude * omega * omega * std::sin(omega * at);
    double shake = 0;
    for (const double hz : lines) shake += 0.4 * std::sin(two_pi * hz * t + hz);
    const double f = ::fit::morison_force(cylinder, row.cd, row.cm - 1, v, a) + (r > 0 ? shake : 0.0);
    run.time.push_back(t);
    run.position.push_back(r * row.amplitude * std::sin(omega * at) + 1e-4 * random.normal(4 * j + 2));
    for (std::size_t i = 0; i < 2; ++i) {
      run.force[i].values.push_back(0.5 * f + 2 + e[i]);
      e[i] = phi * e[i] + row.rmse * cells * std::sqrt(1 - phi * phi) * random.normal(4 * j + 4 + i);
    }
  }
  for (auto& f : run.force)
    for (std::size_t j = 0; j < 2000; ++j)
      f.zero_run.push_back(2 + 0.05 * random.normal(1'000'000'000 + 2 * j + (&f - run.force.data())));
  return run;
}

bool holds(const ::fit::Interval& interval, double truth) { return interval.low <= truth && truth <= interval.high; }

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("hendriksen_tableA2_forced_oscillation.csv"));
  const auto column = [&](const char* name) { return table.column(name); };
  const auto amplitude = column("amplitude_m"), period = column("period_s"), cd = column("cd"), cm = column("cm"),
             rmse = column("rmse_N"), low = column("cd_lo95"), high = column("cd_hi95");
  double covered_cd = 0, covered_cm = 0, sets = 0, worst_kc = 0;
  std::vector<double> wider;
  plot::Series truth{"printed", {}, {}, false, true}, ours{"fitted, first seed", {}, {}, false, true};
  plot::Series bars{"95 % interval", {}, {}};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    double half = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const auto f = fitted_as_the_source(
          cylinder, made({amplitude[i], period[i], cd[i], cm[i], rmse[i]}, 100 * static_cast<int>(i) + seed));
      covered_cd += holds(f.cd.interval, cd[i]);
      covered_cm += holds(::fit::inertia_as(f, "cm").interval, cm[i]);
      ++sets;
      half += (f.cd.interval.high - f.cd.interval.low) / 2 / seeds;
      worst_kc = std::max(worst_kc, std::abs(f.kc / (two_pi * amplitude[i] / 0.12) - 1));
      if (seed > 1) continue;
      truth.x.push_back(f.kc), truth.y.push_back(cd[i]);
      ours.x.push_back(f.kc), ours.y.push_back((f.cd.interval.low + f.cd.interval.high) / 2);
      for (const double y : {f.cd.interval.low, f.cd.interval.high, std::nan("")})
        bars.x.push_back(f.kc), bars.y.push_back(y);
    }
    wider.push_back(half / ((high[i] - low[i]) / 2));
  }
  std::sort(wider.begin(), wider.end());
  return {.numbers = {{"share of sets whose interval holds cd", covered_cd / sets, ""},
                      {"share of sets whose interval holds cm", covered_cm / sets, ""},
                      {"interval of cd over the printed one, median over runs", wider[wider.size() / 2], ""},
                      {"interval of cd over the printed one, least over runs", wider.front(), ""},
                      {"largest relative difference of KC from 2 pi A/D", worst_kc, ""}},
          .pictures = {{"cd",
                        "Drag coefficients that went in, and those that came out of one set of the 33 runs.",
                        {.title = "33 forced oscillations",
                         .panels = {{.x = {.label = "KC"}, .y = {.label = "C_D"}, .series = {truth, ours, bars}}}}}}};
}

}  // namespace froude::validation::hendriksen_oscillation
