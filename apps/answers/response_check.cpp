#include "answers/response_check.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <span>
#include <utility>

#include "answers/checked_run.hpp"
#include "answers/simulate.hpp"
#include "answers/statistics.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/signal/zero_crossings.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;

constexpr int periods_of_ramp = 10, periods_to_settle = 40;  // peak periods of the sea
constexpr int samples_of_shortest = 20;  // of the shortest waves: crests are low by 1.2 % at most, (S11)

double sea_peak_period(const ResponseSpectra& linear) { return hs::peak(linear.sea, hs::whole(linear.sea)).period_s(); }

/// The scene in a sea of another seed, asked for the run of which numbers are taken.
scene::Scene in_sea_of_seed(scene::Scene scene, const ResponseSpectra& linear, double duration, int later) {
  const double every = 1 / (samples_of_shortest * linear.sea.frequency_hz.back());
  const double all = periods_to_settle * sea_peak_period(linear) + duration;
  auto& sea = std::get<scene::RandomSea>(scene.waves->kind);
  sea.seed += static_cast<std::uint64_t>(later);
  sea.lowest = 2 * std::numbers::pi * linear.sea.frequency_hz.front();  // what lies outside has no part in the spectra
  sea.highest = 2 * std::numbers::pi * linear.sea.frequency_hz.back();
  if (auto* grid = std::get_if<hydro::waves::FftGrid>(&sea.bins))
    grid->repetition_s = std::max(grid->repetition_s, all + every);
  scene.waves->ramp = periods_of_ramp * sea_peak_period(linear);
  return asked_to_run(std::move(scene), std::ceil(all / every) * every, every);
}

/// Of one run.
struct Counted {
  double mean, deviation, tz, largest;
};

Counted counted_in(std::span<const double> time, std::span<const double> values, const std::string& signal) {
  const Statistics all = statistics(values);
  const std::vector<hs::SingleWave> waves = hs::single_waves(time, values);
  constexpr std::size_t enough = 3;
  if (waves.size() < enough)
    throw hydro::NumericsError(fmt::format(
        "{} swings {} times in a run: too seldom for a mean period; take a longer --duration", signal, waves.size()));
  return {all.mean, all.deviation, hs::wave_statistics(waves).mean_period, all.highest - all.mean};
}

OfRuns of_runs(const std::vector<std::vector<Counted>>& runs, std::size_t signal, double Counted::*number) {
  const double n = static_cast<double>(runs.size());
  double mean = 0, squares = 0;
  for (const auto& run : runs) mean += run[signal].*number / n;
  for (const auto& run : runs) squares += std::pow(run[signal].*number - mean, 2);
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

bool responds(const ResponseSpectrum& s) {
  return std::ranges::any_of(s.spectrum.density, [](double d) { return d > 0; });
}

}  // namespace

std::vector<CheckedStatistics> check_by_runs(const scene::Scene& scene, const ResponseSpectra& linear, double duration,
                                             int runs, int threads, const std::shared_ptr<compile::Kept>& kept,
                                             const std::function<void(double)>& done) {
  std::vector<const ResponseSpectrum*> signals;
  for (const ResponseSpectrum& s : linear.signals)
    if (responds(s)) signals.push_back(&s);
  std::vector<std::vector<Counted>> all(static_cast<std::size_t>(runs));
  std::mutex one_at_a_time;
  double completed = 0;
  hydro::in_parallel(all.size(), threads, [&](std::size_t i) {
    const scene::Scene sea = in_sea_of_seed(scene, linear, duration, static_cast<int>(i));
    const Run run = simulate(sea, {}, {}, kept);
    if (!run.stopped.empty())
      throw hydro::NumericsError(
          fmt::format("the run of seed {} stopped: {}", std::get<scene::RandomSea>(sea.waves->kind).seed, run.stopped));
    const auto begin =
        static_cast<std::size_t>(std::ranges::lower_bound(run.time, run.time.back() - duration) - run.time.begin());
    for (const ResponseSpectrum* s : signals)
      all[i].push_back(
          counted_in(std::span(run.time).subspan(begin), std::span(run.signal(s->name)).subspan(begin), s->name));
    const std::scoped_lock lock(one_at_a_time);
    if (completed += 1; done) done(completed / runs);
  });
  std::vector<CheckedStatistics> out;
  for (std::size_t s = 0; s < signals.size(); ++s)
    out.push_back({signals[s]->name, signals[s]->units, of_runs(all, s, &Counted::mean),
                   of_runs(all, s, &Counted::deviation), of_runs(all, s, &Counted::tz),
                   of_runs(all, s, &Counted::largest)});
  return out;
}

}  // namespace froude
