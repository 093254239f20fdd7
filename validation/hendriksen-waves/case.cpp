#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/prepare.hpp"
#include "harness/case.hpp"
#include "harness/hendriksen.hpp"
#include "hydro/base/random.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/waves/kinematics/sea.hpp"

namespace froude::validation::hendriksen_waves {
namespace {

namespace hw = hydro::waves;
constexpr double g = 9.81, depth = 1.25, z = -0.48, diameter = 0.12, two_pi = 2 * std::numbers::pi;

double wavenumber_by_bisection(double omega) {
  double low = 0, high = omega * omega / g + omega / std::sqrt(g * depth);
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (g * middle * std::tanh(middle * depth) < omega * omega ? low : high) = middle;
  }
  return (low + high) / 2;
}

hw::HarmonicField wave(double amplitude, double period) {
  const hw::Sea sea = hw::Sea::regular(hydro::WaveAmplitude::from_metres(amplitude),
                                       hydro::AngularFrequency::from_period_s(period), hydro::Angle::from_radians(0),
                                       {.density = 997, .gravity = g, .depth = hydro::WaterDepth::from_metres(depth)});
  return hw::linear_field(sea, {.stretching = hw::Stretching::vertical});
}

struct Row {
  double period, amplitude, cd, cm, rmse;
};
const ::fit::Cylinder cylinder{.diameter = diameter,
                               .length = 0.5,
                               .density = 997,
                               .viscosity = 1.05e-6,
                               .experiment = ::fit::Experiment::water_moves,
                               .mass_beyond_load_cells = 0};

/// Horizontal force on the horizontal cylinder over ten waves: drag with the whole velocity √(u² + w²) u; noise with a
/// memory of 0.2 s and the printed residual as its deviation.
::fit::RawRun made(const Row& row, std::uint64_t seed) {
  constexpr double step = 0.005;
  const hydro::RandomStream random(seed, 34);
  const hw::HarmonicField field = wave(row.amplitude, row.period);
  const double phi = std::exp(-step / 0.2);
  ::fit::RawRun run;
  run.force = {{"F", {}, {}, {}}};
  double e = row.rmse * random.normal(0);
  for (std::size_t j = 0; static_cast<double>(j) * step < 10 * row.period + 2; ++j) {
    const hw::Kinematics at = field.at(static_cast<double>(j) * step, {0, 0, z});
    const double u = at.velocity.x(), w = at.velocity.z(), a = at.acceleration.x();
    run.time.push_back(static_cast<double>(j) * step);
    run.velocity.push_back(u);
    run.cross_velocity.push_back(w);
    run.acceleration.push_back(a);
    run.force[0].values.push_back(cylinder.density * cylinder.volume() * row.cm * a +
                                  0.5 * cylinder.density * diameter * cylinder.length * row.cd * std::hypot(u, w) * u +
                                  e);
    e = phi * e + row.rmse * std::sqrt(1 - phi * phi) * random.normal(j + 1);
  }
  return run;
}

/// Shares over all runs and seeds.
struct Fits {
  double cd = 0, cm = 0, told_short = 0, told_long = 0;
};
Fits fit_all(const hydro::io::CsvTable& table) {
  constexpr int seeds = 20;
  Fits out;
  const auto column = [&](const char* name) { return table.column(name); };
  const auto period = column("period_s"), amplitude = column("amplitude_m"), cd = column("cd"), cm = column("cm"),
             rmse = column("rmse_N");
  const double short_runs = 2, long_runs = static_cast<double>(table.rows()) - short_runs;
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto f =
          fitted_as_the_source(cylinder, made({period[i], amplitude[i], cd[i], cm[i], rmse[i]}, 100 * i + seed));
      const auto holds = [](const ::fit::Interval& v, double truth) { return v.low <= truth && truth <= v.high; };
      if (period[i] < 1.2) {
        out.told_short += f.cd.value.has_value() / (short_runs * seeds);
        continue;
      }
      out.told_long += f.cd.value.has_value() / (long_runs * seeds);
      out.cd += holds(f.cd.interval, cd[i]) / (long_runs * seeds);
      out.cm += holds(f.inertia.interval, cm[i]) / (long_runs * seeds);
    }
  return out;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.reference("hendriksen_tableA3_waves.csv"));
  const auto &period = table.column("period_s"), &amplitude = table.column("amplitude_m");
  double worst_u = 0, worst_a = 0, kc_short = 0, roundest = 0;
  plot::Series kc{.name = "runs of table A.3", .x = {}, .y = {}, .line = false, .marks = true};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double T = period[i], a = amplitude[i], omega = two_pi / T, k = wavenumber_by_bisection(omega);
    const double profile = std::cosh(k * z + k * depth) / std::cosh(k * depth);
    const hw::HarmonicField field = wave(a, T);
    double largest_u = 0, largest_w = 0;
    for (int n = 0; n < 40; ++n) {
      const double t = T * n / 40;
      const hw::Kinematics at = field.at(t, {0.3, 0, z});
      const double u = a * g * k / omega * profile * std::cos(k * 0.3 - omega * t);  // 2.4
      const double rate = a * g * k * profile * std::sin(k * 0.3 - omega * t);       // 2.5
      worst_u = std::max(worst_u, std::abs(at.velocity.x() - u) / (a * g * k / omega * profile));
      worst_a = std::max(worst_a, std::abs(at.acceleration.x() - rate) / (a * g * k * profile));
      largest_u = std::max(largest_u, std::abs(at.velocity.x()));
      largest_w = std::max(largest_w, std::abs(at.velocity.z()));
    }
    kc.x.push_back(T);
    kc.y.push_back(a * g * k / omega * profile * T / diameter);
    if (T < 1.2) kc_short = kc.y.back();
    if (T > 2.7) roundest = std::max(roundest, largest_w / largest_u);
  }
  const Fits fits = fit_all(table);
  // Two waves of half the height that meet: at a node of the elevation the horizontal motions add up.
  const double standing = 2 * wave(0.0005, 50).at(0, {0, 0, z}).velocity.x();
  return {.numbers = {{"largest relative difference of velocity from the source's equation 2.4", worst_u, ""},
                      {"largest relative difference of acceleration from the source's equation 2.5", worst_a, ""},
                      {"Keulegan-Carpenter number at 1.19 s", kc_short, ""},
                      {"largest ratio of vertical to horizontal velocity in waves longer than 2.7 s", roundest, ""},
                      {"horizontal velocity of a standing wave of 1 mm and 50 s", standing, "m/s"},
                      {"share of sets whose interval holds cd, waves longer than 1.2 s", fits.cd, ""},
                      {"share of sets whose interval holds cm, waves longer than 1.2 s", fits.cm, ""},
                      {"share of sets at 1.19 s in which cd is given a value", fits.told_short, ""},
                      {"share of longer sets in which cd is given a value", fits.told_long, ""}},
          .pictures = {{"kc",
                        "Keulegan–Carpenter number of the ten wave runs at the model's depth.",
                        {.title = "Water motion at the model",
                         .panels = {{.x = {.label = "wave period", .unit = "s", .range = {{0, 6}}},
                                     .y = {.label = "KC", .range = {{0, 14}}},
                                     .series = {kc}}}}}}};
}

}  // namespace froude::validation::hendriksen_waves
