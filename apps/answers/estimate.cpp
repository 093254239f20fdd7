#include "answers/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "answers/companions.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// Weight of all bodies, N.
double weight_of(const compile::Prepared& prepared) {
  double out = 0;
  for (const auto& body : prepared.bodies) out += body.mass() * prepared.water.gravity;
  return out;
}

/// What the step does to one signal.
struct Judged : Convergence {
  double until;  // s; until when the signal can be predicted
};

/// Looks for the level whose error is small enough.
class Refinement {
 public:
  Refinement(const scene::Scene& scene, const compile::Prepared& prepared, Companions& companions)
      : scene_(scene),
        companions_(companions),
        weight_(weight_of(prepared)),
        work_(work_of(scene, companions)),
        finest_(finest_level()) {}

  Run settled() {
    int level = 0;
    try {
      level = first_level();
      for (int finer = level;; level = finer) {
        companions_.foresee(level, 2);
        if (!companions_.completes(level)) {
          if (!may_end_later_with_half(level)) return without_estimate(level, "the run has stopped early");
          finer = level - 1;
          continue;
        }
        if (!judge(level)) {
          if (!may_refine() || level <= finest_)
            return without_estimate(level, "runs with other steps do not come to their end");
          finer = level - 1;
          continue;
        }
        look_at_water(level);
        look_at_cuts(level);
        if (const int times = times_as_many_pieces(level); times > 1) {
          begin_with_pieces(times);
          continue;
        }
        finer = finer_level(level);
        if (finer == level) return told(level);
      }
    } catch (const Interrupted&) {
      return companions_.interrupted(level);
    }
  }

 private:
  static constexpr int coarsest_limit = -6;  // level; what any scene is refined to
  static constexpr int most_at_once = 2;     // levels
  static constexpr double room = 0.8;        // of what is left for the step, which is aimed at
  static constexpr const char* twice_as_many = "a run with twice as many";
  static constexpr const char* own_pieces = "quadrature";
  static constexpr const char* less_accuracy = "ask for less accuracy";

  /// Steps of a body or a segment that the run of level 0 takes.
  static double work_of(const scene::Scene& scene, const Companions& companions) {
    double parts = static_cast<double>(scene.bodies.size());
    for (const auto& line : scene.lines) parts += static_cast<double>(line.segments.size());
    return std::max(1.0, parts) * scene.run->duration / companions.first_step();
  }
  /// That of a level is a matter of seconds.
  bool is_cheap(int level) const {
    constexpr double little = 1e6;
    return work_ * std::exp2(-level) <= little;
  }
  /// A 64th of the step that was chosen first, at a hundred times its cost; where that is little, further.
  int finest_level() const {
    constexpr int most = -12;
    int out = coarsest_limit;
    while (!companions_.by_tolerance() && out > most && is_cheap(out - 1)) --out;
    return out;
  }
  /// Half the step may bring a run to its end, unless the step before has ended it at the same time: then it is the
  /// motion that cannot go on.
  bool may_end_later_with_half(int level) {
    const Run& run = companions_.run(level);
    const double end = static_cast<double>(run.steps) * run.step;
    const bool later = !stopped_at_ || std::abs(end - *stopped_at_) > 2 * run.step;
    stopped_at_ = end;
    return later && !companions_.given() && level > finest_;
  }

  bool may_refuse() const { return !scene_.solve.accept_error; }
  bool may_refine() const { return !companions_.given() && may_refuse(); }
  double largest_ratio() const { return companions_.largest_ratio(); }

  /// Where errors of longer steps say that the first level will not do, a finer one at once. They hardly tell of much
  /// shorter steps, so what they foresee is not followed far.
  int first_level() {
    constexpr double farthest = 2;
    if (!may_refine()) return 0;
    companions_.foresee(1, 1);
    if (!companions_.is_longer(2)) return 0;
    const auto sizes = sizes_of(companions_.run(1), weight_);
    double worst = 0;  // at level 0
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (!is_residual(companions_.run(1).signals[i].name))
        worst = std::max(worst, difference(companions_.beside(1), companions_.beside(2), i, sizes[i]).most() /
                                    (largest_ratio() - 1) / largest_ratio());
    const double needed = std::ceil(std::log(worst / scene_.accuracy) / std::log(largest_ratio()));
    return -static_cast<int>(std::clamp(needed, 0.0, farthest));
  }

  /// Judges all signals of a level. \returns false where no other level can be compared
  bool judge(int level) {
    judged_.clear();
    const bool longer = companions_.is_longer(level + 1);
    if (!longer && !companions_.completes(level - 1)) return false;
    const Run& run = companions_.run(level);
    sizes_ = sizes_of(run, weight_);
    for (std::size_t i = 0; i < run.signals.size(); ++i) {
      const double end = run.time.back();
      if (known_until_.size() <= i) known_until_.push_back(end);
      if (is_residual(run.signals[i].name))
        judged_.push_back({{0, largest_ratio()}, end});
      else
        judged_.push_back(longer ? by_longer(level, i, end) : by_shorter(level, i, end));
    }
    return true;
  }
  Judged by_longer(int level, std::size_t signal, double end) {
    const Beside fine = companions_.beside(level), coarse = companions_.beside(level + 1);
    std::optional<Beside> coarsest;
    if (companions_.is_longer(level + 2)) coarsest = companions_.beside(level + 2);
    const Judged out{convergence(fine, coarse, coarsest, largest_ratio(), signal, sizes_[signal]), end};
    const bool settles = out.converges() && can_be_refined(level, out);
    if (out.error <= scene_.accuracy || settles || !parts_neighbours(signal)) return out;
    return while_predictable(fine, coarse, coarsest, signal);
  }
  /// Where longer steps do not come to the end of the run.
  Judged by_shorter(int level, std::size_t signal, double end) {
    const Beside fine = companions_.beside(level - 1), coarse = companions_.beside(level);
    constexpr double first_order = 2;  // taken without a third run: of d = e(2h) - e(h) the error e(2h) is 2 d
    const Judged out{{first_order * difference(fine, coarse, signal, sizes_[signal]).most(), 0}, end};
    if (out.error <= scene_.accuracy || !parts_neighbours(signal)) return out;
    return while_predictable(fine, coarse, {}, signal);
  }
  /// True where a finer level would do, as far as errors go on to fall as they have.
  bool can_be_refined(int level, const Judged& j) const {
    return !may_refine() || level - levels_needed(j, room * scene_.accuracy) >= finest_;
  }
  /// (E2)
  bool parts_neighbours(std::size_t signal) {
    return grows_much(companions_.run(0), companions_.neighbour(), signal) && part_with_much_shorter_steps(signal);
  }
  bool grows_much(const Run& run, const Run& neighbour, std::size_t signal) const {
    constexpr double much = 1e3;                  // what parts in proportion to time comes to some 200
    const double least = companions_.moved_by();  // of the signal: about as far as the start is moved
    return growth(run, neighbour, signal, least * sizes_[signal].rms) > much;
  }
  /// Steps that are too long part neighbours that the motion itself keeps together. Half as much again as the time in
  /// which neighbours come as far off as is asked shows that with short ones.
  bool part_with_much_shorter_steps(std::size_t signal) {
    constexpr double more = 1.5;
    const int much_shorter = much_shorter_level();
    if (much_shorter == 0) return true;
    const Beside run = companions_.beside(0), neighbour{&companions_.neighbour(), 1};
    const double parted = agrees_until(run, neighbour, signal, scene_.accuracy * sizes_[signal].rms);
    const double quarters = std::ceil(4 * more * parted / run.run->time.back());
    const auto& pair = companions_.pair(much_shorter, static_cast<int>(std::clamp(quarters, 1.0, 4.0)));
    return grows_much(pair.run, pair.neighbour, signal);
  }
  /// An eighth of the step that the program begins with, a 64th where that is cheap.
  int much_shorter_level() const {
    constexpr int more = 3;
    int out = companions_.much_shorter();
    for (int i = 0; i < more && !companions_.by_tolerance() && is_cheap(out - 1); ++i) --out;
    return out;
  }
  /// Up to where what runs with other steps differ by leaves the signal within the accuracy asked.
  Judged while_predictable(const Beside& fine, const Beside& coarse, const std::optional<Beside>& coarsest,
                           std::size_t signal) const {
    constexpr double least = 1e-3;  // of what would do were errors to fall as those of the method
    const double asked = scene_.accuracy, most = asked * (largest_ratio() - 1);
    for (double allowed = most;; allowed /= 2) {
      const double until =
          std::min(known_until_[signal], agrees_until(fine, coarse, signal, allowed * sizes_[signal].rms));
      const auto c = convergence(fine, coarse, coarsest, largest_ratio(), signal, sizes_[signal], until);
      if (c.error <= asked || allowed < least * most) return {c, until};
    }
  }

  /// What the memory of radiated waves and the spacing of coefficients do, which hardly depends on the step: seen once,
  /// at the longest step that there is.
  void look_at_water(int level) {
    if (looked_ || !companions_.completes(level + 1)) return;
    looked_ = true;
    const int at = companions_.completes(level + 2) ? level + 2 : level + 1;
    constexpr const char* how = "a run with the loads put back that are left out";
    const auto [memory, coefficients] = companions_.completed_by_water(at);
    compare(level, at, {.name = "memory", .how = how, .of_signal = {}}, memory);
    compare(level, at, {.name = "coefficients", .how = how, .of_signal = {}, .given = true}, coefficients);
  }
  /// `of_difference`: the error over what both runs differ by.
  void compare(int level, int at, ErrorEstimate::Source source, const std::optional<Run>& with,
               double of_difference = 1) {
    if (!with) return;
    const Beside without{&companions_.run(at), 1}, put_back{&*with, 1};
    others_.push_back(std::move(source));
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      Judged& j = judged_[i];
      if (j.until < companions_.run(level).time.back())
        j.until = known_until_[i] = parted(without, put_back, i, j.until);
      others_.back().of_signal.push_back(is_residual(with->signals[i].name)
                                             ? 0
                                             : of_difference *
                                                   difference(without, put_back, i, sizes_[i], j.until).most());
    }
  }
  /// What the pieces do into which lines and members are cut: seen once, at the longest step at which the run with
  /// twice as many comes to its end. (E4)
  void look_at_cuts(int level) {
    using enum Companions::Cut;
    if (looked_at_cuts_) return;
    looked_at_cuts_ = true;
    look_at(segments, {.name = "segments", .how = twice_as_many, .of_signal = {}, .given = true}, level);
    look_at(given_pieces, {.name = "pieces", .how = twice_as_many, .of_signal = {}, .given = true}, level);
    look_at(chosen_pieces, {.name = own_pieces, .how = twice_as_many, .of_signal = {}}, level);
  }
  void look_at(Companions::Cut what, const ErrorEstimate::Source& source, int level) {
    constexpr double first_order = 2;  // the lowest order that there is: of d = e(N) - e(2N) the error is 2 d
    if (!companions_.has(what)) return;
    std::string why;
    const int longest = companions_.is_longer(level + 1) ? level + 2 : level;
    for (int at = longest; at >= level; --at) {
      if (!companions_.completes(at)) continue;
      const Run finer = companions_.cut_finer(what, at);
      if (finer.stopped.empty()) return compare(level, at, source, finer, first_order);
      why = finer.stopped;
    }
    unseen_.push_back(fmt::format("{}: a run with twice as many does not come to its end: {}", source.name, why));
  }
  /// By how many times more pieces the members of the program's own want: half of the accuracy asked is theirs.
  int times_as_many_pieces(int level) const {
    constexpr double share = 0.5;
    constexpr int most = 64, most_more = 8;
    if (!may_refuse()) return 1;
    double worst = 0;
    std::size_t signal = 0;
    for (const auto& source : others_)
      for (std::size_t i = 0; source.name == own_pieces && i < source.of_signal.size(); ++i)
        if (source.of_signal[i] > worst) worst = source.of_signal[signal = i];
    if (worst <= share * scene_.accuracy) return 1;
    if (companions_.refined_pieces() >= most)
      refuse(level, signal, worst, share * scene_.accuracy,
             fmt::format("the pieces of members stand in the way: {} times as many do not do", most), less_accuracy);
    const double wanted = std::min(std::ceil(worst / (share * scene_.accuracy)), 1.0 * most_more);
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(wanted)));
  }
  void begin_with_pieces(int times) {
    companions_.refine_pieces(times);
    looked_ = looked_at_cuts_ = false;
    others_.clear();
    unseen_.clear();
    known_until_.clear();
  }
  /// From when on runs with other water have parted as neighbours do: they are farther apart than what is asked, and
  /// than the water itself has brought them in the first quarter of the time in which the step predicts the signal.
  double parted(const Beside& without, const Beside& put_back, std::size_t signal, double until) const {
    constexpr double more = 4;  // waves that have a ramp make as much of it
    const double first = difference(without, put_back, signal, sizes_[signal], until / 4).rms;
    const double allowed = std::max(scene_.accuracy.value, more * first);
    return std::min(until, agrees_until(without, put_back, signal, allowed * sizes_[signal].rms));
  }
  /// What of the accuracy is left for the step beside whatever else the program chooses, and beside what the scene
  /// gives, unless that leaves next to nothing: then no step could mend it.
  double left_for_step(std::size_t signal) const {
    constexpr double least = 0.1;
    double out = scene_.accuracy, given = 0;
    for (const auto& source : others_)
      if (source.given)
        given += source.of_signal[signal];
      else
        out -= source.of_signal[signal];
    return out - given >= least * scene_.accuracy ? out - given : out;
  }

  /// By how many levels, as far as errors fall as they have. Steps that are too long to converge foretell nothing: then
  /// another try is made, as long as there is room for one more.
  int levels_needed(const Judged& j, double allowed) const {
    if (!j.converges()) return most_at_once;
    if (j.error <= allowed) return 0;
    return static_cast<int>(std::ceil(std::log(j.error / allowed) / std::log(std::min(j.ratio, largest_ratio()))));
  }
  /// True if a level would do were errors to fall as those of the method: long steps saturate, and foretell less. Where
  /// runs take long, that is not waited for.
  bool may_do_at_best(int level, const Judged& j, double allowed) const {
    if (!is_cheap(coarsest_limit) || level == finest_ || !j.converges()) return false;
    return level - std::ceil(std::log(j.error / allowed) / std::log(largest_ratio())) >= finest_;
  }
  /// True if it is the step that leaves next to nothing of a signal to be predicted: a tenth of the time in which a
  /// neighbour a hundred-millionth beside comes as far off. Where steps do, each halving adds little to that time.
  bool is_lost_at_once(std::size_t signal) const {
    constexpr double share = 0.1;
    const double until = judged_[signal].until;
    if (!may_refine() || until >= known_until_[signal]) return false;
    const Beside run = companions_.beside(0), neighbour{&companions_.neighbour(), 1};
    return until < share * agrees_until(run, neighbour, signal, scene_.accuracy * sizes_[signal].rms);
  }
  /// The level to try next; the same where no finer one is needed, or may be tried.
  int finer_level(int level) const {
    int out = level;
    if (!may_refuse()) return out;
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      const Judged& j = judged_[i];
      const double left = left_for_step(i);
      if (level > finest_ && is_lost_at_once(i)) out = std::min(out, level - 1);
      if (j.error <= left) continue;
      if (left <= 0) refuse_memory(level, i);  // pieces are within half of what is asked
      if (!may_refine()) continue;
      const int needed = levels_needed(j, room * left);
      if (level - needed < finest_ && !may_do_at_best(level, j, room * left)) refuse_step(level, i);
      out = std::min(out, std::max(finest_, level - std::clamp(needed, 1, most_at_once)));
    }
    return out;
  }

  /// `allowed`: what of the accuracy is left for the source of the error.
  [[noreturn]] void refuse(int level, std::size_t signal, double error, double allowed, const std::string& why,
                           const std::string& remedy) const {
    const bool shared = allowed < scene_.accuracy;
    throw hydro::InputError(
        fmt::format("an accuracy of {:.2g} is asked for{}, but {} is off by an estimated {:.2g} of its rms, standard "
                    "deviation or extreme; {}",
                    scene_.accuracy.value,
                    shared ? fmt::format(", of which {:.2g} is left beside other errors", allowed) : "",
                    companions_.at(level).signals[signal].name, error, why),
        scene_.accuracy.place,
        remedy + ", leave that signal out of `of`, or take the error by name: [solve] accept_error = true");
  }
  [[noreturn]] void refuse_step(int level, std::size_t signal) const {
    const Judged& j = judged_[signal];
    const bool tolerance = companions_.by_tolerance();
    refuse(level, signal, j.error, left_for_step(signal),
           fmt::format("the {} stands in the way: errors {} from one run to the next with {}",
                       tolerance ? "tolerance" : "step",
                       j.ratio > 0 ? fmt::format("fall by {:.2g}", j.ratio) : "are not seen to fall",
                       tolerance ? "a tenth of it" : "half of it"),
           tolerance ? "give a smaller tolerance" : shorter_step(level, j));
  }
  /// Less accuracy is begun with a longer step, from which it is as far to one that would do. Runs that differ by about
  /// the signal itself have lost its phase: they cannot differ by more, and fall by less than the errors of steps that
  /// keep it, which fall by the method's order.
  std::string shorter_step(int level, const Judged& j) const {
    constexpr double lost = 0.3;
    const Judged seen = j.error < lost ? j : Judged{{j.error, largest_ratio()}, j.until};
    const double longest = companions_.at(level).step / std::exp2(levels_needed(seen, room * scene_.accuracy));
    return fmt::format("give a shorter step, [solve] step = \"{:.6g} s\"",
                       scene_.run->every / std::ceil(scene_.run->every / longest));
  }
  [[noreturn]] void refuse_memory(int level, std::size_t signal) const {
    refuse(level, signal, scene_.accuracy - left_for_step(signal), scene_.accuracy,
           "the memory of radiated waves stands in the way",
           fmt::format("give radiation a finer memory_tolerance, {}", less_accuracy));
  }

  Run told(int level) {
    ErrorEstimate error = unknown_error(scene_);
    error.sources.push_back({.name = companions_.by_tolerance() ? "tolerance" : "step",
                             .how = companions_.how(),
                             .of_signal = {},
                             .given = companions_.given()});
    for (std::size_t i = 0; i < judged_.size(); ++i) {
      error.sources.front().of_signal.push_back(judged_[i].error);
      if (judged_[i].until < companions_.at(level).time.back()) error.unpredictable.push_back(beyond(level, i));
    }
    error.sources.insert(error.sources.end(), others_.begin(), others_.end());
    error.unseen = unseen_;
    Run out = companions_.take(level);
    if (const int times = companions_.refined_pieces(); times > 1)
      out.notes.push_back(fmt::format("members are cut into {} times as many pieces as were chosen first", times));
    set_error(out, std::move(error));
    return out;
  }
  /// Standard deviation from where the signal cannot be predicted, by all runs there are: they have parted.
  ErrorEstimate::Unpredictable beyond(int level, std::size_t signal) {
    const double from = judged_[signal].until;
    std::vector<double> seen;
    for (const Run* run : companions_.completed()) seen.push_back(deviation(*run, signal, from));
    double mean = 0, squares = 0;
    for (const double s : seen) mean += s / static_cast<double>(seen.size());
    for (const double s : seen) squares += (s - mean) * (s - mean);
    const auto n = static_cast<double>(seen.size());
    return {signal, from, deviation(companions_.at(level), signal, from), std::sqrt(squares / (n - 1))};
  }
  Run without_estimate(int level, const char* why) {
    Run out = companions_.take(level);
    set_error(out, unknown_error(scene_, why));
    return out;
  }

  const scene::Scene& scene_;
  Companions& companions_;
  double weight_;  // N
  double work_;
  int finest_;  // level
  std::vector<Sizes> sizes_;
  std::vector<Judged> judged_;
  std::vector<double> known_until_;  // s, one a signal: what the water leaves of it
  bool looked_ = false, looked_at_cuts_ = false;
  std::optional<double> stopped_at_;  // s; where the last run did not come to its end
  std::vector<std::string> unseen_;
  std::vector<ErrorEstimate::Source> others_;
};

/// The shares of runs that come one after another, told as one that never goes back. How many come shows only as they
/// do, so each fills half of what is left: the first takes about as long as those that tell its error.
class OneAfterAnother {
 public:
  explicit OneAfterAnother(const std::function<void(double)>& told) : told_(told) {}
  void operator()(double share) {
    if (share <= of_run_) begun_ = all_;  // another run
    of_run_ = share;
    all_ = begun_ + (1 - begun_) * share / 2;
    told_(all_);
  }

 private:
  const std::function<void(double)>& told_;
  double begun_ = 0, all_ = 0, of_run_ = 0;
};

}  // namespace

ErrorEstimate unknown_error(const scene::Scene& scene, std::string missing) {
  return {.asked = scene.accuracy,
          .accepted = scene.solve.accept_error,
          .sources = {},
          .unpredictable = {},
          .unseen = {},
          .missing = std::move(missing)};
}

void set_error(Run& run, ErrorEstimate error) {
  error.unseen.insert(error.unseen.begin(), run.error.unseen.begin(), run.error.unseen.end());
  run.error = std::move(error);
}

Run run_to_accuracy(const scene::Scene& scene, const compile::Prepared& prepared,
                    const std::function<void(double)>& progress, int threads, Checkpoints* checkpoints,
                    const Interruption* interruption) {
  const auto begin = std::chrono::steady_clock::now();
  // Which fits the memories that the scene has.
  const auto told = progress ? std::function<void(double)>(OneAfterAnother(progress)) : nullptr;
  Companions companions(scene, prepared, told, threads, checkpoints, interruption);
  const std::chrono::duration<double> preparing = std::chrono::steady_clock::now() - begin;
  Run out = Refinement(scene, prepared, companions).settled();
  out.preparation_s += preparing.count();
  if (progress) progress(1);
  return out;
}

}  // namespace froude
