#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "answers/answers.hpp"
#include "answers/periodic_scene.hpp"
#include "answers/provenance.hpp"
#include "dynamics/frequency/hill_equation.hpp"
#include "dynamics/frequency/modes.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

using namespace dynamics::frequency;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Signals of the model by the names asked for; those of energies, waves and lines are not the model's.
std::vector<dynamics::Signal> chosen_signals(const scene::AskStability& ask, const dynamics::Model& model) {
  std::vector<dynamics::Signal> out = model.signals();
  std::vector<std::string> names;
  for (const auto& s : out) names.push_back(s.name);
  scene::check_patterns(ask.of, ask.of_places, names);
  std::erase_if(out, [&](const auto& s) { return !compile::is_chosen(s.name, ask.of); });
  return out;
}

double deviation(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

/// The map as it is made, period by period.
class Mapping {
 public:
  explicit Mapping(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept)
      : scene_(scene), ask_(*scene.stability), prepared_(prepare_periodic(scene, kept)) {
    map_.period = ask_.periods, map_.height = ask_.heights;
    map_.cells.resize(map_.period.size() * map_.height.size());
    found_.resize(map_.cells.size());
    map_.notes = prepared_.notes;
    map_.provenance = provenance_of(scene);
    options_.accuracy = scene.accuracy / 10;  // of the motion: harmonics above the last go on falling
    const dynamics::Model model = compile::frequency_model(prepared_, ask_.about);
    const SmallMotions about = compile::small_motions(model, ask_.about, map_.notes);
    for (Mode& m : free_motions(about, prepared_.groups).modes) modes_.push_back(std::move(m));
    for (int m = 0; m < model.modes(); ++m) motions_.push_back(model.mode_name(m));
    const auto first = at(map_.period.front(), map_.height.front());
    for (const auto& s : chosen_signals(ask_, first->model().model))
      map_.signals.push_back(
          {s.name, s.unit, "standard deviation of " + s.meaning, std::vector<double>(map_.cells.size(), std::nan(""))});
  }

  StabilityMap made(const std::function<void(double)>& done) {
    const auto begin = Clock::now();
    for (std::size_t p = 0; p < map_.period.size(); ++p) {
      climb(p);
      reduce(p);
      if (done) done(static_cast<double>(p + 1) / static_cast<double>(map_.period.size()));
    }
    map_.balance_s = seconds_since(begin);
    if (ask_.check) check();
    return std::move(map_);
  }

 private:
  std::size_t index(std::size_t p, std::size_t h) const { return h * map_.period.size() + p; }
  std::unique_ptr<PeriodicScene> at(double period, double height) const {
    return std::make_unique<PeriodicScene>(in_waves(scene_, period, height), prepared_, ask_.about, period);
  }
  Family by_height(double period) const {
    return [this, period](double height) { return at(period, height); };
  }

  /// From rest up through the heights of a period, each from the motion before it.
  void climb(std::size_t p) {
    std::optional<PeriodicMotion> below;
    double height_below = 0;
    for (std::size_t h = 0; h < map_.height.size(); ++h) {
      const double height = map_.height[h];
      const auto system = at(map_.period[p], height);
      PeriodicMotion near = below ? *below : at_rest(*system);
      if (below) near.coefficients *= height / height_below;
      Balance found = balance(*system, std::move(near), options_);
      StabilityMap::Cell& cell = map_.cells[index(p, h)];
      if (!found.found && below) found = round_folds(p, height_below, *below, height, cell);
      if (!found.found) {
        map_.notes.push_back(
            fmt::format("{:.4g} s, {:.4g} m: no periodic motion is found: {}", map_.period[p], height, found.why));
        continue;
      }
      below = found.motion, height_below = height;
      tell(*system, found.motion, index(p, h));
    }
  }

  /// Where motions grow no further they turn back; what comes after is where a run goes.
  Balance round_folds(std::size_t p, double from, const PeriodicMotion& motion, double to, StabilityMap::Cell& cell) {
    Balance out;
    try {
      auto branch = follow(by_height(map_.period[p]), from, to, motion, {.balance = options_});
      out.found = branch.back().parameter == to;
      if (out.found)
        out.motion = std::move(branch.back().motion);
      else
        out.why = "the branch does not come there";
      cell.beyond_fold = std::any_of(branch.begin(), branch.end(), [](const BranchPoint& b) { return !b.forwards; });
    } catch (const hydro::NumericsError& error) {
      out.why = error.what();
    }
    return out;
  }

  void tell(PeriodicScene& system, const PeriodicMotion& motion, std::size_t c) {
    const Eigen::VectorXcd mu = floquet_multipliers(system, motion);
    StabilityMap::Cell& cell = map_.cells[c];
    cell.fate = fate_of(mu), cell.multiplier = std::abs(mu[0]);
    cell.harmonics = static_cast<int>(motion.harmonics());
    found_[c] = motion;
    std::vector<double> times;
    for (int i = 0; i < 32; ++i) times.push_back(i / 32.0 * 2 * std::numbers::pi / motion.omega);
    const Eigen::MatrixXd values = system.values(chosen_signals(ask_, system.model().model), motion, times);
    for (std::size_t s = 0; s < map_.signals.size(); ++s)
      map_.signals[s].values[c] = deviation(values.col(static_cast<Eigen::Index>(s)));
  }

  /// The least height from which any one motion grows by its own equation.
  void reduce(std::size_t p) {
    map_.mathieu.push_back(std::nan(""));
    map_.motion.emplace_back();
    const Family family = by_height(map_.period[p]);
    const auto system = at(map_.period[p], map_.height.front());
    for (const Mode& mode : modes_) {
      const HillEquation equation =
          hill_equation(family, 1e-2 * map_.height.back(), system->coordinates(mode.shape), mode.omega);
      const auto least = equation.least_growing(map_.height.back());
      if (!least || *least >= map_.mathieu.back()) continue;
      map_.mathieu.back() = *least;
      map_.motion.back() = largest_motions(motions_, {mode.shape.data(), static_cast<std::size_t>(mode.shape.size())});
    }
  }

  void check() {
    const auto begin = Clock::now();
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(ask_.check->cells), map_.cells.size());
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t c = (2 * i + 1) * map_.cells.size() / (2 * count);
      if (map_.cells[c].fate) map_.checks.push_back(stepped(c));
    }
    map_.checks_s = seconds_since(begin);
  }

  StabilityMap::Check stepped(std::size_t c) const {
    const double period = map_.period[c % map_.period.size()], height = map_.height[c / map_.period.size()];
    const double periods = std::ceil(ask_.check->duration / period);
    scene::Scene scene = scene_;
    auto& wave = std::get<scene::RegularWave>(scene.waves->kind);
    wave.amplitude = height / 2, wave.period = period;
    scene.run = scene::AskRun{.duration = periods * period, .every = period / 32};
    scene.run->from_equilibrium = ask_.about.equilibrium;
    const auto system = at(period, height);
    const auto signals = chosen_signals(ask_, system->model().model);
    for (const auto& s : signals) scene.run->of.push_back(s.name), scene.run->of_places.emplace_back();
    const Run run = run_model(scene, compile::time_model(scene, prepared_));
    StabilityMap::Check out{.cell = c, .apart = 0, .decided = false, .left = !run.stopped.empty()};
    // A disturbance of a thousandth comes to the size of the motion, or what a start leaves dies to that.
    out.decided = std::abs(std::log(map_.cells[c].multiplier)) * periods * 0.8 > std::log(1e3);
    if (out.left) return out;
    out.apart = apart(run, *system, signals, c);
    out.left = out.apart > 0.1;  // runs of this accuracy are some per cent off
    return out;
  }

  /// Rms of the last fifth of a run less the periodic motion, over the rms of both, in the worst signal.
  double apart(const Run& run, PeriodicScene& system, const std::vector<dynamics::Signal>& signals,
               std::size_t c) const {
    const auto first = static_cast<std::ptrdiff_t>(run.time.size() * 4 / 5);
    const std::vector<double> times(run.time.begin() + first, run.time.end());
    const Eigen::MatrixXd expected = system.values(signals, found_[c], times);
    double out = 0;
    for (std::size_t s = 0; s < signals.size(); ++s) {
      const Eigen::VectorXd column = expected.col(static_cast<Eigen::Index>(s));
      const Eigen::Map<const Eigen::VectorXd> found(run.signal(signals[s].name).data() + first, column.size());
      const double both = deviation(column) + deviation(found);
      if (both > 0)
        out = std::max(out, std::sqrt((found - column).squaredNorm() / static_cast<double>(column.size())) / both);
    }
    return out;
  }

  const scene::Scene& scene_;
  const scene::AskStability& ask_;
  compile::Prepared prepared_;
  BalanceOptions options_;
  std::vector<Mode> modes_;
  std::vector<std::string> motions_;
  std::vector<PeriodicMotion> found_;  // one a cell
  StabilityMap map_;
};

}  // namespace

StabilityMap stability(const scene::Scene& scene, const std::function<void(double)>& done,
                       const std::shared_ptr<compile::Kept>& kept) {
  return Mapping(scene, kept).made(done);
}

std::string StabilityMap::agreement() const {
  int decided = 0, agree = 0;
  for (const Check& c : checks) {
    decided += c.decided ? 1 : 0;
    agree += c.decided && c.agrees(cells[c.cell]) ? 1 : 0;
  }
  return fmt::format("{} of {} cells stepped in time agree{}", agree, decided,
                     std::ssize(checks) > decided ? fmt::format(", {} more are too near the boundary to be decided",
                                                                std::ssize(checks) - decided)
                                                  : "");
}

}  // namespace froude
