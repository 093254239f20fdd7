#include "answers/stability_check.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "answers/cost_interview.hpp"
#include "answers/periodic_scene.hpp"
#include "answers/simulate.hpp"

namespace froude {
namespace {

constexpr int samples_a_period = 32;

/// The scene in waves of a cell, asked for the run from rest that shows where it goes.
scene::Scene to_step(const scene::Scene& scene, double period, double height, double duration) {
  scene::Scene out = with_waves(scene, period, height);
  out.run = {.duration = std::ceil(duration / period) * period,
             .every = period / samples_a_period,
             .from_equilibrium = scene.stability->about.equilibrium,
             .of = scene.stability->of,
             .of_places = scene.stability->of_places,
             .place = scene.stability->place};
  for (auto& body : out.bodies) {
    body.initial.clear();
    body.initial_velocity.clear();
  }
  return out;
}

/// Rms of the last fifth of a run less the periodic motion, over the standard deviations of both, in the worst signal.
double apart(const Run& run, PeriodicScene& system, const std::vector<dynamics::Signal>& signals,
             const dynamics::frequency::PeriodicMotion& motion) {
  const auto first = static_cast<std::ptrdiff_t>(run.time.size() * 4 / 5);
  const std::vector<double> times(run.time.begin() + first, run.time.end());
  const Eigen::MatrixXd expected = system.values(signals, motion, times);
  double out = 0;
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const Eigen::VectorXd column = expected.col(static_cast<Eigen::Index>(s));
    const Eigen::Map<const Eigen::VectorXd> found(run.signal(signals[s].name).data() + first, column.size());
    const double both = standard_deviation(column) + standard_deviation(found);
    if (both > 0) out = std::max(out, std::sqrt((found - column).array().square().mean()) / both);
  }
  return out;
}

SteppedCell stepped(const scene::Scene& scene, const compile::Prepared& prepared, const StabilityMap& map,
                    std::size_t c, double duration) {
  const double period = map.period_of(c), height = map.height_of(c);
  const scene::Scene in_time = to_step(scene, period, height, duration);
  const Run run = run_model(in_time, compile::time_model(in_time, prepared));
  SteppedCell out{.cell = c, .stopped = run.stopped};
  const double periods = 0.8 * in_time.run->duration / period;  // before the fifth that is looked at
  out.decided = !run.stopped.empty() || std::abs(std::log(map.cells[c].multiplier)) * periods > std::log(1e3);
  if (!run.stopped.empty()) return out;
  PeriodicScene system(in_waves(scene, period, height), prepared, period);
  out.apart = apart(run, system, signals_of_map(*scene.stability, system.model()), map.cells[c].motion);
  return out;
}

}  // namespace

std::vector<std::size_t> cells_to_step(const StabilityMap& map, std::size_t count) {
  std::vector<std::size_t> found, out;
  for (std::size_t c = 0; c < map.cells.size(); ++c)
    if (map.cells[c].fate) found.push_back(c);
  count = std::min(count, found.size());
  const std::size_t columns = map.period.size(), rows = map.height.size();
  // A lattice by the golden ratio: rows come in turn, and columns never fall into step with them.
  for (std::size_t i = 0; i < count; ++i) {
    const double row = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double turns = 0.25 + static_cast<double>(i) * (std::numbers::phi - 1), column = turns - std::floor(turns);
    const auto away = [&](std::size_t c) {
      return std::hypot((static_cast<double>(c % columns) + 0.5) / static_cast<double>(columns) - column,
                        (static_cast<double>(c / columns) + 0.5) / static_cast<double>(rows) - row);
    };
    const auto nearest =
        std::min_element(found.rbegin(), found.rend(), [&](auto a, auto b) { return away(a) < away(b); });
    out.push_back(*nearest);
    found.erase(std::next(nearest).base());
  }
  std::sort(out.begin(), out.end());
  return out;
}

MapCheck check_in_time(const scene::Scene& scene, const StabilityMap& map, std::size_t count, double duration,
                       const std::function<void(double)>& done) {
  const compile::Prepared prepared = prepare_periodic(scene);
  const std::vector<std::size_t> cells = cells_to_step(map, count);
  MapCheck out;
  const double begin = processor_s();
  for (const std::size_t c : cells) {
    out.cells.push_back(stepped(scene, prepared, map, c, duration));
    if (done) done(static_cast<double>(out.cells.size()) / static_cast<double>(cells.size()));
  }
  out.processor_s = processor_s() - begin;
  return out;
}

}  // namespace froude
