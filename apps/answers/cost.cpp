#include "answers/cost.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>

#include "answers/cost_components.hpp"
#include "answers/cost_error.hpp"
#include "answers/cost_interview.hpp"
#include "answers/cost_ladder.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// Which setting of each ladder.
using Choice = std::vector<const Rung*>;

/// Errors and times of one answer of a scene.
class Study {
 public:
  Study(const scene::Scene& scene, bool run, const CostOptions& options, const std::function<void(double)>& progress)
      : scene_(scene), run_(run), options_(options), progress_(progress), interview_(scene, run) {
    out_.ask = run ? "run" : "rao";
    out_.measure = run ? options.measure : ErrorMeasure::peak;
  }

  AnswerCost result() {
    begin();
    find_references();
    for (std::size_t k = 0; k < ladders_.size(); ++k) climb(k);
    combine();
    repeat();
    tell_times();
    mark_front();
    choose();
    if (run_)
      out_.components = cost_of_components(scene_, interview_, question(own_), options_.repeat_for_s, out_.notes);
    return std::move(out_);
  }
  /// Of the setting that was chosen.
  const std::vector<scene::TextEdit>& chosen_edits() const { return questions_[*chosen_].edits; }

 private:
  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  // The scene as it is, and its ladders.
  void begin() {
    const Answer& own = interview_.ask({});
    if (!own.is())
      throw hydro::InputError(fmt::format("the scene has no answer as it is: {}", own.refused),
                              {.file = scene_.file.string()}, fmt::format("`froude {}` tells where", out_.ask));
    Ladders found = run_ ? ladders_of_run(scene_, own.step) : ladders_of_rao(scene_);
    ladders_ = std::move(found.all);
    out_.notes = std::move(found.notes);
    if (ladders_.empty())
      throw hydro::InputError(fmt::format("the {} of this scene has no approximation that could be changed", out_.ask),
                              {.file = scene_.file.string()}, "its answer is exact as far as its data are");
    for (const Ladder& ladder : ladders_) own_.push_back(&ladder.rungs[ladder.own]);
    for (const Ladder& ladder : ladders_) planned_ += ladder.rungs.size() + 2;
  }

  Question question(const Choice& choice) const {
    Question out;
    for (std::size_t k = 0; k < choice.size(); ++k) {
      out.edits.insert(out.edits.end(), choice[k]->edits.begin(), choice[k]->edits.end());
      if (ladders_[k].makes_coefficients && choice[k] != own_[k]) out.coefficients += choice[k]->setting + "; ";
    }
    return out;
  }
  Choice own_but(std::size_t k, const Rung& rung) const {
    Choice out = own_;
    out[k] = &rung;
    return out;
  }
  const Answer& ask(const Choice& choice, double patience_s = no_limit) {
    const Answer& out = interview_.ask(question(choice), patience_s);
    if (progress_) progress_(std::min(0.8, 0.8 * ++asked_ / static_cast<double>(planned_)));
    return out;
  }
  /// A rung may take this long: many times what the scene takes, since some methods cut their steps without end.
  double patience_s() { return 2 + 20 * interview_.ask(question(own_)).answering_s; }
  CostErrors errors(const Answer& answer, const Answer& reference) const {
    return errors_of(answer.signals, reference.signals, !run_, unpredictable_);
  }
  WorstSignal error(const Answer& answer, const Answer& reference) const {
    return errors(answer, reference)[static_cast<std::size_t>(out_.measure)];
  }

  // References.
  void find_references() {
    Choice finest;
    for (std::size_t k = 0; k < ladders_.size(); ++k) {
      references_.push_back(reference_of(k));
      finest.push_back(&references_.back()->finest);
      note_unpredictable(ask(own_), ask(own_but(k, references_[k]->next)), ask(own_but(k, references_[k]->finest)));
    }
    tell_unpredictable();
    std::vector<std::string> settings;
    for (const Rung* rung : finest) settings.push_back(rung->approximation + " " + rung->setting);
    out_.reference = fmt::format("{}", fmt::join(settings, "; "));
    reference_ = &ask(finest);
    if (!reference_->is())
      throw hydro::NumericsError(
          fmt::format("no reference: with {} the scene has no answer: {}", out_.reference, reference_->refused));
  }
  const Ladder::Reference* reference_of(std::size_t k) {
    std::string why;
    for (const Ladder::Reference& r : ladders_[k].references) {
      const Answer& finest = ask(own_but(k, r.finest), patience_s());
      const Answer& next = finest.is() ? ask(own_but(k, r.next), patience_s()) : finest;
      if (next.is()) return &r;
      why = next.refused;
    }
    throw hydro::NumericsError(fmt::format("no reference for {}: {}", own_[k]->approximation, why));
  }

  /// Chaotic motions, and those that grow out of rounding, differ however fine two settings are: errors of a method
  /// fall with its step, sixfold from that of the scene to the finest where it is of first order.
  void note_unpredictable(const Answer& own, const Answer& next, const Answer& finest) {
    constexpr double nothing_alike = 0.3;  // of rms; answers that have nothing in common differ by √2
    constexpr double does_not_fall = 0.5, small = 0.01;
    if (!run_) return;
    const std::vector<double> left = rms_errors(next.signals, finest.signals),
                              first = rms_errors(own.signals, next.signals);
    for (std::size_t i = 0; i < left.size(); ++i)
      if (left[i] > nothing_alike || (left[i] > small && left[i] > does_not_fall * first[i]))
        unpredictable_.insert(finest.signals[i].name);
  }
  void tell_unpredictable() {
    if (unpredictable_.empty()) return;
    out_.notes.push_back(
        fmt::format("no setting predicts {} of {} signals at each instant, since even the finest two differ, and no "
                    "finer ones would by less; by rms they count with their standard deviations: {}",
                    unpredictable_.size(), ask(own_).signals.size(), fmt::join(unpredictable_, ", ")));
  }

  // Rungs, one approximation at a time.
  void climb(std::size_t k) {
    const Answer& exact = ask(own_but(k, references_[k]->finest));
    double least = 0;  // of the errors that are not zero
    for (const Rung& rung : ladders_[k].rungs) {
      const Choice choice = own_but(k, rung);
      const Answer& answer = ask(choice, patience_s());
      add(rung, choice, answer);
      if (!answer.is()) continue;
      const WorstSignal alone = error(answer, exact);
      out_.rungs.back().alone = alone;
      if (alone.error > 0 && (least == 0 || alone.error < least)) least = alone.error;
    }
    WorstSignal doubt = error(ask(own_but(k, references_[k]->next)), exact);
    // Finest settings that come to the same tell nothing of each other; the nearest other one does.
    if (doubt.error == 0) doubt.error = least;
    out_.uncertainty.error += doubt.error;
    if (doubt.error >= largest_doubt_) {
      largest_doubt_ = doubt.error;
      out_.uncertainty.signal = own_[k]->approximation;
    }
  }
  void add(const Rung& rung, const Choice& choice, const Answer& answer) {
    CostRung out{.approximation = rung.approximation, .setting = rung.setting};
    out.as_scene = choice == own_;
    out.refused = answer.refused;
    if (answer.is()) {
      out.error = errors(answer, *reference_);
      out.scene = interview_.text_of(question(choice));
    }
    out_.rungs.push_back(std::move(out));
    questions_.push_back(question(choice));
    choices_.push_back(choice);
  }
  double error_of(const CostRung& rung) const { return rung.error[static_cast<std::size_t>(out_.measure)].error; }

  // Several approximations together.
  struct Candidate {
    const Rung* rung;
    double error, once_and_preparing_s, answering_s;
  };
  std::vector<Candidate> candidates(std::size_t k) {
    std::vector<Candidate> out;
    const Answer& exact = ask(own_but(k, references_[k]->finest));
    for (const Rung& rung : ladders_[k].rungs)
      if (const Answer& a = ask(own_but(k, rung)); a.is())
        out.push_back({&rung, error(a, exact).error, a.once_s + a.preparing_s, a.answering_s});
    return out;
  }
  /// The one that should be cheapest where errors add up to no more than `most`, and times multiply; empty if none.
  Choice cheapest_within(double most) {
    const Answer& own = ask(own_);
    std::vector<std::vector<Candidate>> all;
    for (std::size_t k = 0; k < ladders_.size(); ++k) all.push_back(candidates(k));
    Choice best, now(ladders_.size());
    double least_s = no_limit;
    const std::function<void(std::size_t, double, double, double)> choose_from =
        [&](std::size_t k, double error, double preparing_s, double answering_s) {
          if (error > most) return;
          if (k == ladders_.size()) {
            if (preparing_s + answering_s < least_s) least_s = preparing_s + answering_s, best = now;
            return;
          }
          for (const Candidate& c : all[k]) {
            now[k] = c.rung;
            choose_from(k + 1, error + c.error, preparing_s + c.once_and_preparing_s - own.once_s - own.preparing_s,
                        answering_s * c.answering_s / own.answering_s);
          }
        };
    choose_from(0, 0, own.once_s + own.preparing_s, own.answering_s);
    return best;
  }
  void combine() {
    if (ladders_.size() < 2) return;
    std::vector<double> targets{1e-1, 1e-2, 1e-3};
    if (options_.tolerance) targets.push_back(*options_.tolerance);
    for (const double target : targets) certify(target);
  }
  /// Errors may also add up to more than their sum foretold: what was measured counts, and another try keeps a
  /// distance.
  void certify(double target) {
    constexpr int tries = 3;
    double most = target;
    for (int i = 0; i < tries; ++i) {
      const Choice choice = cheapest_within(most);
      if (choice.empty()) return;
      const Answer& answer = ask(choice, patience_s());
      if (std::find(choices_.begin(), choices_.end(), choice) == choices_.end())
        add({"together", setting_of(choice), {}}, choice, answer);
      const double reached = answer.is() ? error(answer, *reference_).error : no_limit;
      if (reached <= target) return;
      most *= std::clamp(target / reached, 0.1, 0.9);
    }
  }
  static std::string setting_of(const Choice& choice) {
    std::vector<std::string> settings;
    for (const Rung* rung : choice) settings.push_back(rung->setting);
    return fmt::format("{}", fmt::join(settings, "; "));
  }

  // Times.
  void repeat() {
    constexpr int most = 5;
    double left = options_.repeat_for_s;
    for (int round = 2; round <= most; ++round)
      for (std::size_t i = 0; i < questions_.size(); ++i) {
        if (!out_.rungs[i].refused.empty()) continue;
        const Answer& known = interview_.ask(questions_[i]);
        if (known.repeats >= round || known.preparing_s + known.answering_s > left) continue;
        const double begin = processor_s();
        interview_.repeat(questions_[i]);
        left -= processor_s() - begin;
        if (progress_) progress_(1 - 0.2 * std::max(0.0, left) / options_.repeat_for_s);
      }
  }
  void tell_times() {
    for (std::size_t i = 0; i < questions_.size(); ++i) {
      CostRung& rung = out_.rungs[i];
      if (!rung.refused.empty()) continue;
      const Answer& known = interview_.ask(questions_[i]);
      rung.preparing_s = known.once_s + known.preparing_s;
      rung.answering_s = known.answering_s;
      rung.repeats = known.repeats;
    }
  }
  std::vector<std::size_t> by_time() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < out_.rungs.size(); ++i)
      if (out_.rungs[i].refused.empty()) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return out_.rungs[a].time_s() < out_.rungs[b].time_s(); });
    return order;
  }
  void mark_front() {
    double least = no_limit;
    for (const std::size_t i : by_time())
      if (error_of(out_.rungs[i]) < least) {
        least = error_of(out_.rungs[i]);
        out_.rungs[i].on_front = true;
      }
  }
  void choose() {
    if (!options_.tolerance) return;
    for (const std::size_t i : by_time())
      if (error_of(out_.rungs[i]) <= *options_.tolerance) {
        chosen_ = out_.chosen = i;
        return;
      }
    choose_by_chance();
  }
  /// Where motions cannot be predicted, the reference is one of many, and what two of them differ by is chance: of
  /// settings that differ from it by no more, the cheapest is as good as any.
  void choose_by_chance() {
    if (unpredictable_.empty() || out_.uncertainty.error <= *options_.tolerance) return;
    for (const std::size_t i : by_time())
      if (error_of(out_.rungs[i]) <= out_.uncertainty.error) {
        chosen_ = out_.chosen = i;
        out_.by_chance = out_.uncertainty.error;
        return;
      }
  }

  const scene::Scene& scene_;
  bool run_;
  CostOptions options_;
  const std::function<void(double)>& progress_;
  Interview interview_;
  AnswerCost out_;
  std::vector<Ladder> ladders_;
  Choice own_;
  std::vector<const Ladder::Reference*> references_;  // one a ladder
  std::set<std::string> unpredictable_;
  const Answer* reference_ = nullptr;
  double largest_doubt_ = 0;
  std::vector<Question> questions_;  // one a rung
  std::vector<Choice> choices_;      // likewise
  std::optional<std::size_t> chosen_;
  std::size_t planned_ = 0;
  int asked_ = 0;
};

}  // namespace

std::string name_of(ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::rms:
      return "rms";
    case ErrorMeasure::deviation:
      return "deviation";
    case ErrorMeasure::extreme:
      return "extreme";
    case ErrorMeasure::range:
      return "range";
    case ErrorMeasure::peak:
      return "peak";
  }
  return "";
}

const CostRung& AnswerCost::most_accurate() const {
  const auto m = static_cast<std::size_t>(measure);
  return *std::min_element(rungs.begin(), rungs.end(), [&](const CostRung& a, const CostRung& b) {
    return a.refused.empty() != b.refused.empty() ? a.refused.empty() : a.error[m].error < b.error[m].error;
  });
}

Cost cost(const scene::Scene& scene, const CostOptions& options, const std::function<void(double)>& progress) {
  if (!scene.run && !scene.rao)
    throw hydro::InputError("the scene asks neither for a run nor for a RAO: there is nothing to price",
                            {.file = scene.file.string()},
                            "add to [ask]: run = { duration = \"600 s\", every = \"0.05 s\" }");
  Cost out;
  std::vector<scene::TextEdit> edits;
  bool chosen = true;
  for (const bool run : {true, false}) {
    if (run ? !scene.run : !scene.rao) continue;
    Study study(scene, run, options, progress);
    out.answers.push_back(study.result());
    chosen = chosen && out.answers.back().chosen;
    if (!chosen) continue;
    const auto& more = study.chosen_edits();
    edits.insert(edits.end(), more.begin(), more.end());
  }
  if (chosen) out.scene = scene::edited(scene.text, scene.file.string(), edits);
  if (out.scene) scene::parse(*out.scene, scene.file);
  return out;
}

}  // namespace froude
