#include "answers/companions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <future>
#include <numeric>
#include <random>

#include "answers/estimate.hpp"
#include "answers/simulate.hpp"
#include "compile/integrator.hpp"
#include "compile/radiation.hpp"
#include "compile/restart.hpp"
#include "compile/step.hpp"
#include "dynamics/force/contact_law.hpp"
#include "dynamics/integrate/newton_integrator.hpp"
#include "hydro/base/error.hpp"
#include "scene/finer.hpp"

namespace froude {
namespace {

constexpr int twice = 2;

/// Steps `factor` times as long: as many fewer a sample as may be, and then samples that are farther apart. Where that
/// would leave fewer than `few`, the steps of a sample are as many as come nearest.
void lengthen(std::size_t factor, std::size_t few, std::size_t& per_sample, std::size_t& stride, scene::AskRun& run) {
  const auto samples = static_cast<std::size_t>(std::llround(run.duration / run.every));
  const std::size_t common = std::gcd(per_sample, factor);
  if (samples < few * factor / common) {
    per_sample = std::max<std::size_t>(1, (per_sample + factor / 2) / factor);
    return;
  }
  per_sample /= common;
  stride = factor / common;
  run.every *= static_cast<double>(stride);
  run.duration = static_cast<double>(samples / stride) * run.every;
}

/// Runs are compared by their samples, and a Lyapunov exponent wants hundreds.
std::size_t enough_samples(const scene::Scene& scene) {
  const bool exponent =
      std::any_of(scene.lines.begin(), scene.lines.end(), [](const auto& line) { return line.lyapunov.has_value(); });
  return exponent ? 400 : 8;
}

/// The loads that are put back have energies of their own: signals that only this run has.
void keep_signals_of(const Run& other, Run& run) {
  std::vector<Signal> kept;
  for (const Signal& s : other.signals) kept.push_back({s.name, s.units, s.long_name, run.signal(s.name)});
  run.signals = std::move(kept);
}

/// The signals of another run as they are where lines are cut into `times` as many segments: of nodes at the same
/// place, of links the mean of those that one was cut into.
void take_signals_of(const Run& other, const scene::Scene& scene, int times, Run& run) {
  std::vector<Signal> taken;
  for (const Signal& s : other.signals) {
    const auto names = scene::names_where_finer(scene, times, s.name);
    taken.push_back({s.name, s.units, s.long_name, std::vector<double>(run.time.size(), 0.0)});
    for (const std::string& name : names)
      std::transform(taken.back().values.begin(), taken.back().values.end(), run.signal(name).begin(),
                     taken.back().values.begin(),
                     [n = static_cast<double>(names.size())](double sum, double value) { return sum + value / n; });
  }
  run.signals = std::move(taken);
}

/// Asks a run for the signals of another one, as they are named there, alone: a fine line has many.
void ask_for_signals_of(const Run& other, const scene::Scene& scene, int times, scene::AskRun& ask) {
  ask.of.clear();
  for (const Signal& s : other.signals)
    for (std::string& name : scene::names_where_finer(scene, times, s.name)) ask.of.push_back(std::move(name));
  ask.of_places.assign(ask.of.size(), ask.place);
}

bool overlaps(const dynamics::Model& model, const dynamics::State& state) {
  for (const auto& kind : model.forces())
    if (const dynamics::ContactLaw* law = kind->contact())
      for (std::size_t i = 0; i < law->elements(); ++i)
        if (law->gap(i, state) < 0) return true;
  return false;
}

/// A start that lies beside that of the model, in directions that any run of this scene takes alike. Where bodies rest
/// against each other they would be moved into each other: there velocities alone are moved.
void disturb(double by, compile::TimeModel& model) {
  const compile::StateChart chart(model, compile::start_of(model));
  std::mt19937 random(1);
  Eigen::VectorXd coordinates(chart.coordinates());
  for (double& c : coordinates) c = (random() & 1U) != 0U ? by : -by;
  compile::MovingState beside = chart.at(model, coordinates);
  if (overlaps(model.model, beside.bodies)) {
    coordinates.head(chart.places_of_bodies()).setZero();
    beside = chart.at(model, coordinates);
  }
  compile::start_from(beside, model);
}

}  // namespace

Companions::Companions(const scene::Scene& scene, compile::Prepared prepared,
                       const std::function<void(double)>& progress, int threads, Checkpoints* checkpoints,
                       const Interruption* interruption)
    : scene_(scene),
      prepared_(std::move(prepared)),
      progress_(progress),
      threads_(threads),
      checkpoints_(checkpoints),
      interruption_(interruption) {
  const scene::Solve& solve = scene.solve;
  by_tolerance_ = compile::has_steps_by_tolerance(solve);
  given_ = by_tolerance_ ? solve.tolerance.has_value() : solve.step.has_value();
  tolerance_ = solve.tolerance.value_or(compile::tolerance_of_pair);
  step_ = compile::choose_step(scene, prepared_).value;
  compile::hold_memories(prepared_, step_);
}

double Companions::largest_ratio() const {
  if (scene_.solve.integrator == "explicit_pair") return 32;
  if (by_tolerance_) return 10;
  const bool first_order = scene_.solve.integrator.ends_with("implicit_euler");
  return first_order ? 2 : 4;
}

std::string Companions::how() const {
  return by_tolerance_ ? "runs at 10 and 100 times the tolerance, and 2 and 4 times the step"
                       : "runs at 2 and 4 times the step";
}

scene::Scene Companions::scene_of(int level, std::size_t& stride, compile::PieceTimes pieces) const {
  scene::Scene out = scene_;
  compile::cut_members_finer(pieces, out);
  stride = 1;
  // Parts are no longer than a step: where the tolerance cuts none, it is the step that makes the error.
  if (by_tolerance_) out.solve.tolerance = tolerance_ * std::pow(10, level);
  // The same of lines whose steps are cut by their own error: as if it fell with the square of the step, as others'
  // does.
  out.solve.line_tolerance = scene::line_tolerance(scene_) * std::pow(4, level);
  // So is what Newton leaves in each step: runs that all leave the same would agree in what it does to the motion.
  out.solve.newton_tolerance = std::max(dynamics::NewtonIntegrator::least_residual_tolerance,
                                        scene::newton_tolerance(scene_) * std::pow(4, level));
  auto per_sample = static_cast<std::size_t>(std::llround(scene_.run->every / step_));
  if (level < 0)
    per_sample <<= -level;
  else
    lengthen(std::size_t{1} << level, enough_samples(scene_), per_sample, stride, *out.run);
  out.solve.step = scene::Located<double>{out.run->every / static_cast<double>(per_sample), scene_.run->place};
  return out;
}

/// It is the longest steps whose motion is asked for, if any's; where it is large, the level is rather run once more.
bool Companions::keeps_motion(int level, const compile::TimeModel& model) const {
  constexpr std::size_t most = std::size_t{1} << 21U;  // numbers, of 16 MiB
  return level > 0 && !prepared_.groups.empty() && model.steps * static_cast<std::size_t>(model.model.modes()) < most;
}

const char* Companions::name_of(Cut what) {
  constexpr std::array<const char*, 3> names{"segments", "given", "chosen"};
  return names[static_cast<std::size_t>(what)];
}

KeptRun Companions::kept(const std::string& name, int level) const {
  return {checkpoints_, fmt::format("{}-of-level{}-pieces{}", name, level, refined_pieces_), interruption_};
}

void Companions::require_uninterrupted() const {
  if (asks_to_end(interruption_)) throw Interrupted{};
}

/// Longer steps that a scene may not have, such as those that miss a ramp, tell nothing of its error.
Companions::Made Companions::made(int level, const std::function<void(double)>& progress) const {
  try {
    return stepped(level, progress);
  } catch (const hydro::InputError& e) {
    if (level <= 0) throw;
    Made out;
    out.run.stopped = e.rule();
    return out;
  }
}

Companions::Made Companions::stepped(int level, const std::function<void(double)>& progress) const {
  Made out;
  const scene::Scene scene = scene_of(level, out.stride);
  const auto begin = std::chrono::steady_clock::now();
  const compile::TimeModel model = compile::time_model(scene, prepared_);
  const double preparation = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (keeps_motion(level, model)) out.motion.emplace();
  out.run = run_model(scene, model, progress, nullptr, out.motion ? &*out.motion : nullptr, kept("run", level));
  out.run.preparation_s = preparation;
  return out;
}

const Run& Companions::run(int level) { return *beside(level).run; }

Beside Companions::beside(int level) {
  auto at = runs_.find(level);
  if (at == runs_.end()) {
    auto known = foreseen_.extract(level);
    at = runs_.emplace(level, known ? std::move(known.mapped()) : made(level, progress_)).first;
    require_uninterrupted();
  }
  return {&at->second.run, at->second.stride};
}

/// The one of the level, with the shortest steps, takes as long as all above it.
void Companions::foresee(int level, int above) {
  if (threads_ < 2 || runs_.contains(level) || foreseen_.contains(level)) return;
  auto longer = std::async(std::launch::async, [&] {
    std::map<int, Made> out;
    try {
      for (int other = level + 1; other <= level + above; ++other)
        if (!runs_.contains(other) && !foreseen_.contains(other)) out.emplace(other, made(other, {}));
    } catch (const std::exception&) {  // thrown again where the run is asked for, if ever
    }
    return out;
  });
  Made one = made(level, progress_);
  foreseen_.merge(longer.get());
  foreseen_.emplace(level, std::move(one));
  require_uninterrupted();
}

/// The level is run once more for it, unless it has kept them: velocities at each step of all levels would take much
/// memory.
const Companions::Followed& Companions::followed(int level) {
  const auto known = followed_.find(level);
  if (known != followed_.end()) return known->second;
  std::size_t stride = 1;
  scene::Scene scene = scene_of(level, stride);
  compile::TimeModel model = compile::time_model(scene, prepared_);
  std::optional<compile::VelocityRecord> motion = std::move(runs_.at(level).motion);
  if (!motion) run_model(scene, model, progress_, nullptr, &motion.emplace(), kept("motion", level));
  require_uninterrupted();
  return followed_.emplace(level, Followed{std::move(scene), std::move(model), std::move(*motion)}).first->second;
}

std::optional<Run> Companions::with_load(int level, const std::optional<compile::LoadRecord>& load,
                                         const std::string& name, const std::function<void(double)>& progress) {
  if (!load) return std::nullopt;
  const auto& [scene, model, motion] = followed(level);
  Run out =
      run_model(scene, compile::time_model(scene, prepared_, {*load}), progress, nullptr, nullptr, kept(name, level));
  require_uninterrupted();
  keep_signals_of(at(level), out);
  return out;
}

Companions::WithWater Companions::completed_by_water(int level) {
  if (prepared_.groups.empty()) return {};
  const auto& [scene, model, motion] = followed(level);
  const auto coefficients = [&](const std::function<void(double)>& progress) {
    return with_load(level, compile::data_defect(scene, prepared_, model, motion), "coefficients", progress);
  };
  std::future<std::optional<Run>> beside;
  if (threads_ > 1) beside = std::async(std::launch::async, coefficients, std::function<void(double)>());
  WithWater out;
  out.memory = with_load(level, compile::memory_defect(model, motion), "memory", progress_);
  out.coefficients = beside.valid() ? beside.get() : coefficients(progress_);
  return out;
}

bool Companions::has(Cut what) const {
  using compile::CutBy;
  if (what == Cut::segments) return scene::approximates_lines(scene_);
  return compile::any_member_cut(scene_, what == Cut::given_pieces ? CutBy::scene : CutBy::program);
}

scene::Scene Companions::cut_scene(Cut what, int level) const {
  std::size_t stride = 1;
  if (what == Cut::given_pieces) return scene_of(level, stride, {twice, refined_pieces_});
  if (what == Cut::chosen_pieces) return scene_of(level, stride, {1, twice * refined_pieces_});
  scene::Scene out = scene::with_finer_lines(scene_of(level, stride), twice);
  ask_for_signals_of(runs_.at(level).run, scene_, twice, *out.run);
  return out;
}

/// Lines on bodies, and what watches nodes, are prepared; pieces of members are not.
compile::Prepared Companions::prepared_for(Cut what, const scene::Scene& scene) const {
  if (what != Cut::segments) return prepared_;
  compile::Prepared out = compile::prepare(scene, prepared_.kept);
  out.memory = prepared_.memory;
  return out;
}

Run Companions::cut_finer(Cut what, int level) {
  const Run& whole = run(level);
  const scene::Scene scene = cut_scene(what, level);
  Run out;
  try {
    out = run_model(scene, compile::time_model(scene, prepared_for(what, scene)), progress_, nullptr, nullptr,
                    kept(name_of(what), level));
  } catch (const hydro::InputError& e) {
    out.stopped = e.rule();
  } catch (const hydro::NumericsError& e) {
    out.stopped = e.what();
  }
  require_uninterrupted();
  if (out.stopped.empty()) take_signals_of(whole, scene_, what == Cut::segments ? twice : 1, out);
  return out;
}

void Companions::refine_pieces(int times) {
  refined_pieces_ *= times;
  runs_.clear();
  foreseen_.clear();
  followed_.clear();
  neighbour_.reset();
  pairs_.clear();
}

double Companions::moved_by() const { return std::max(1e-9, 10 * scene::newton_tolerance(scene_)); }

const Run& Companions::neighbour() {
  if (!neighbour_) {
    std::size_t stride = 1;
    const scene::Scene scene = scene_of(0, stride);
    compile::TimeModel model = compile::time_model(scene, prepared_);
    disturb(moved_by(), model);
    neighbour_ = run_model(scene, model, progress_, nullptr, nullptr, kept("neighbour", 0));
    require_uninterrupted();
  }
  return *neighbour_;
}

Run Companions::quarters_of(int level, int quarters, bool disturbed,
                            const std::function<void(double)>& progress) const {
  std::size_t stride = 1;
  scene::Scene scene = scene_of(level, stride);
  scene.run->duration = std::ceil(scene.run->duration / scene.run->every * quarters / 4 - 1e-9) * scene.run->every;
  compile::TimeModel model = compile::time_model(scene, prepared_);
  if (disturbed) disturb(moved_by(), model);
  const std::string name = fmt::format("{}-quarters{}", disturbed ? "disturbed" : "undisturbed", quarters);
  return run_model(scene, model, progress, nullptr, nullptr, kept(name, level));
}

/// Both take the same time, and are made beside each other where there is a thread for it.
const Companions::Pair& Companions::pair(int level, int quarters) {
  const auto known = pairs_.find(level);
  if (known != pairs_.end() && known->second.quarters >= quarters) return known->second;
  const auto disturbed = [&](const std::function<void(double)>& progress) {
    return quarters_of(level, quarters, true, progress);
  };
  std::future<Run> beside;
  if (threads_ > 1) beside = std::async(std::launch::async, disturbed, std::function<void(double)>());
  Pair out{quarters_of(level, quarters, false, progress_), {}, quarters};
  out.neighbour = beside.valid() ? beside.get() : disturbed(progress_);
  require_uninterrupted();
  return pairs_.insert_or_assign(level, std::move(out)).first->second;
}

int Companions::much_shorter() const {
  constexpr int eighth = 3, most = 7;
  if (!given_ || by_tolerance_) return -eighth;
  scene::Scene own = scene_;
  own.solve.step.reset();
  own.run->duration = own.run->every;  // how many steps the whole run would take is not asked
  const double levels = std::log2(step_ / compile::choose_step(own, prepared_).value) + eighth;
  return -static_cast<int>(std::clamp(std::ceil(levels - 1e-9), 0.0, 1.0 * most));
}

std::vector<const Run*> Companions::completed() const {
  std::vector<const Run*> out;
  for (const auto& [level, made] : runs_)
    if (made.run.stopped.empty()) out.push_back(&made.run);
  if (neighbour_ && neighbour_->stopped.empty()) out.push_back(&*neighbour_);
  return out;
}

Run Companions::take(int level) {
  Run out = std::move(runs_.at(level).run);
  runs_.erase(level);
  return out;
}

Run Companions::interrupted(int level) {
  runs_.merge(foreseen_);
  if (!runs_.contains(level)) runs_.emplace(level, made(level, {}));  // which ends after a step
  Run out = take(level);
  if (out.stopped.empty()) out.stopped = sentence(*interruption_) + " before the error was estimated";
  set_error(out, unknown_error(scene_, sentence(*interruption_)));
  return out;
}

}  // namespace froude
