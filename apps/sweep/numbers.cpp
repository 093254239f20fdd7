#include "sweep/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "answers/answers.hpp"
#include "answers/fit_kind.hpp"
#include "answers/statistics.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/zero_crossings.hpp"
#include "scene/scene.hpp"

namespace froude::sweep {
namespace {

using hydro::InputError;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A word of `statistic`, its unit where that is not the signal's, and how it comes of x.
template <class Of>
struct Statistic {
  const char* word;
  const char* unit;  ///< null: that of the signal
  double (*value)(const Of&);
};

/// Samples of a signal.
struct Record {
  std::span<const double> time, values;
  Statistics all = statistics(values);
};
constexpr std::size_t least_waves = 3;  // fewer have no highest third
auto waves_of(const Record& r) { return hydro::signal::single_waves(r.time, r.values); }
double significant(const Record& r) {
  const auto waves = waves_of(r);
  return waves.size() < least_waves ? none : hydro::signal::wave_statistics(waves).h13;
}
const std::vector<Statistic<Record>>& of_records() {
  static const std::vector<Statistic<Record>> all{
      {"mean", nullptr, [](const Record& r) { return r.all.mean; }},
      {"deviation", nullptr, [](const Record& r) { return r.all.deviation; }},
      {"minimum", nullptr, [](const Record& r) { return r.all.lowest; }},
      {"maximum", nullptr, [](const Record& r) { return r.all.highest; }},
      {"extreme", nullptr, [](const Record& r) { return r.all.extreme(); }},
      {"range", nullptr, [](const Record& r) { return r.all.highest - r.all.lowest; }},
      {"significant", nullptr, significant}};
  return all;
}

/// Amplitudes over frequencies, of all headings.
struct Amplitudes {
  const Responses& of;
  const ComplexSignal& signal;

  std::size_t largest() const {
    const auto smaller = [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); };
    return static_cast<std::size_t>(std::max_element(signal.values.begin(), signal.values.end(), smaller) -
                                    signal.values.begin());
  }
};
const std::vector<Statistic<Amplitudes>>& of_responses() {
  static const std::vector<Statistic<Amplitudes>> all{
      {"peak", nullptr, [](const Amplitudes& a) { return std::abs(a.signal.values[a.largest()]); }},
      {"peak_period", "s",
       [](const Amplitudes& a) { return 2 * std::numbers::pi / a.of.omega[a.largest() % a.of.omega.size()]; }},
      {"amplitude", nullptr, [](const Amplitudes& a) { return std::abs(a.signal.values.front()); }}};
  return all;
}

struct Mode {
  const Modes& of;
  std::size_t index;
};
const std::vector<Statistic<Mode>>& of_modes() {
  static const std::vector<Statistic<Mode>> all{
      {"period", "s", [](const Mode& m) { return m.of.period(m.index); }},
      {"damped_period", "s", [](const Mode& m) { return m.of.damped_period(m.index).value_or(none); }},
      {"damping_ratio", "", [](const Mode& m) { return m.of.damping_ratio(m.index).value_or(none); }}};
  return all;
}

const std::vector<Statistic<::fit::Coefficient>>& of_coefficients() {
  static const std::vector<Statistic<::fit::Coefficient>> all{
      {"value", nullptr, [](const ::fit::Coefficient& c) { return c.value.value_or(none); }},
      {"low", nullptr, [](const ::fit::Coefficient& c) { return c.interval.low; }},
      {"high", nullptr, [](const ::fit::Coefficient& c) { return c.interval.high; }}};
  return all;
}

template <class Of>
std::vector<std::string> words_of(const std::vector<Statistic<Of>>& all) {
  std::vector<std::string> out;
  for (const auto& s : all) out.emplace_back(s.word);
  return out;
}

/// Why an answer has no such number.
template <class Of>
std::string why_none(const Of& /*of*/) {
  return "the answer has none";
}
std::string why_none(const Record& r) {
  const std::size_t waves = waves_of(r).size();
  return fmt::format("the signal has {} {}, fewer than the {} that have a highest third", waves,
                     waves == 1 ? "wave" : "waves", least_waves);
}

/// The statistics of `output` in its order.
template <class Of>
void tell(const Output& output, const std::vector<Statistic<Of>>& all, const Of& of, const std::string& name,
          const std::string& unit, std::vector<Number>& out) {
  for (const std::string& word : output.statistics) {
    const auto& s = *std::find_if(all.begin(), all.end(), [&](const auto& known) { return known.word == word; });
    out.push_back({fmt::format("{}.{}", name, word), s.unit == nullptr ? unit : s.unit, s.value(of)});
    if (!std::isfinite(out.back().value)) out.back().why = why_none(of);
  }
}

/// Indices of the things that fit a pattern, by name. \throws hydro::InputError where none does
template <class Thing>
std::vector<std::size_t> fitting(const std::vector<Thing>& things, const Located<std::string>& pattern) {
  std::vector<std::size_t> out;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < things.size(); ++i) {
    known.push_back(things[i].name);
    if (scene::matches(pattern.value, things[i].name)) out.push_back(i);
  }
  if (!out.empty()) return out;
  const std::string near = hydro::nearest(pattern.value, known);
  throw InputError(
      fmt::format("[[output]] of = \"{}\" is nothing that the scene gives", pattern.value), pattern.place,
      near.empty() ? fmt::format("it gives {}", fmt::join(known, ", ")) : fmt::format("did you mean \"{}\"?", near));
}

/// A scene of motion, each answer computed once, when an output first needs it.
class Answers {
 public:
  Answers(scene::Scene scene, const std::shared_ptr<compile::Kept>& kept, const std::function<void(double)>& progress)
      : scene_(std::move(scene)), kept_(kept), progress_(progress) {}

  const Run& run() {
    if (run_) return *run_;
    require_asked(scene_.run.has_value(), "run", "run = { duration = \"600 s\", every = \"0.1 s\" }");
    run_ = simulate(scene_, progress_, {}, kept_);
    if (!run_->stopped.empty()) throw hydro::NumericsError(run_->stopped);
    take(run_->warnings());
    return *run_;
  }
  const Responses& rao() {
    if (rao_) return *rao_;
    require_asked(scene_.rao.has_value(), "rao", "rao = { periods = \"2 s .. 8 s, 61 values\" }");
    rao_ = respond(scene_, compile::prepare(scene_, kept_), {.threads = 1});  // cases share the processors
    take(rao_->warnings());
    return *rao_;
  }
  const Modes& modes() {
    if (modes_) return *modes_;
    require_asked(scene_.ask_modes.has_value(), "modes", "modes = { longest = \"60 s\" }");
    return modes_.emplace(free_modes(scene_, kept_));
  }

  std::vector<std::string> warnings;
  std::optional<Run> take_run() { return std::move(run_); }

 private:
  void require_asked(bool asked, const std::string& what, const std::string& example) const {
    if (!asked)
      throw InputError(fmt::format("an output needs the answer \"{}\", which the scene does not ask for", what),
                       {.file = scene_.file.string()}, "add to [ask]: " + example);
  }
  void take(const std::vector<std::string>& more) { warnings.insert(warnings.end(), more.begin(), more.end()); }

  scene::Scene scene_;
  const std::shared_ptr<compile::Kept>& kept_;
  const std::function<void(double)>& progress_;
  std::optional<Run> run_;
  std::optional<Responses> rao_;
  std::optional<Modes> modes_;
};

void tell_run(const Output& output, const Run& run, std::vector<Number>& out) {
  const auto first = static_cast<std::size_t>(
      std::lower_bound(run.time.begin(), run.time.end(), output.from - 1e-9 * run.step) - run.time.begin());
  if (run.time.size() - first < 2)
    throw InputError("[[output]] from leaves nothing of the run", output.place, "begin earlier, or run longer");
  for (const auto& pattern : output.of)
    for (const std::size_t i : fitting(run.signals, pattern)) {
      const Signal& s = run.signals[i];
      tell(output, of_records(), {std::span(run.time).subspan(first), std::span(s.values).subspan(first)}, s.name,
           s.units, out);
    }
}

void tell_rao(const Output& output, const Responses& rao, std::vector<Number>& out) {
  const auto& asked = output.statistics;
  if (std::find(asked.begin(), asked.end(), "amplitude") != asked.end() && rao.omega.size() * rao.heading.size() > 1)
    throw InputError(fmt::format("[[output]] statistic \"amplitude\" is of one wave, and the scene asks for {}",
                                 rao.omega.size() * rao.heading.size()),
                     output.place, "write period = \"5 s\" and one heading in [ask.rao], or ask for the \"peak\"");
  for (const auto& pattern : output.of)
    for (const std::size_t i : fitting(rao.signals, pattern))
      tell(output, of_responses(), {rao, rao.signals[i]}, rao.signals[i].name, rao.signals[i].units, out);
}

void tell_modes(const Output& output, const Modes& modes, std::vector<Number>& out) {
  const auto count = static_cast<std::size_t>(output.count);
  if (modes.count() < count)
    throw hydro::NumericsError(fmt::format("there are {} modes of the {} that are asked for", modes.count(), count));
  for (std::size_t i = 0; i < count; ++i) tell(output, of_modes(), {modes, i}, fmt::format("mode{}", i + 1), "", out);
}

void tell_fit(const Output& output, const ::fit::Report& report, std::vector<Number>& out) {
  for (const auto& name : output.of) {
    const ::fit::Estimate* estimate = report.find(name.value);
    if (estimate == nullptr)
      throw InputError(fmt::format("[[output]] of = \"{}\" is no coefficient of the fit", name.value), name.place,
                       "name one that `froude fit` tells");
    tell(output, of_coefficients(), estimate->coefficient, name.value, estimate->unit, out);
  }
}

Answered answer_fit(const Study& study, std::string_view text) {
  const scene::FitScene scene = scene::parse_fit(text, study.scene.value);
  const ::fit::Report report = scene.of->answer(scene).report;
  if (report.refused) throw hydro::NumericsError(report.refused->why);
  Answered out;
  for (const Output& output : study.outputs) tell_fit(output, report, out.numbers);
  out.warnings = report.cautions;
  return out;
}

Answered answer_motion(const Study& study, std::string_view text, const std::shared_ptr<compile::Kept>& kept,
                       const std::function<void(double)>& progress) {
  Answers answers(scene::parse(text, study.scene.value), kept, progress);
  Answered out;
  for (const Output& output : study.outputs) {
    if (output.kind == Output::Kind::run) tell_run(output, answers.run(), out.numbers);
    if (output.kind == Output::Kind::rao) tell_rao(output, answers.rao(), out.numbers);
    if (output.kind == Output::Kind::modes) tell_modes(output, answers.modes(), out.numbers);
  }
  out.warnings = std::move(answers.warnings);
  if (study.series) out.run = answers.take_run();
  return out;
}

}  // namespace

std::vector<std::string> statistics_of(Output::Kind kind) {
  using enum Output::Kind;
  switch (kind) {
    case run:
      return words_of(of_records());
    case rao:
      return words_of(of_responses());
    case modes:
      return words_of(of_modes());
    case fit:
      return words_of(of_coefficients());
  }
  return {};
}

Answered answer(const Study& study, std::string_view scene_text, const std::shared_ptr<compile::Kept>& kept,
                const std::function<void(double)>& progress) {
  const auto fits = [](const Output& o) { return o.kind == Output::Kind::fit; };
  const auto count = std::count_if(study.outputs.begin(), study.outputs.end(), fits);
  if (count == 0) return answer_motion(study, scene_text, kept, progress);
  if (count == std::ssize(study.outputs)) return answer_fit(study, scene_text);
  throw InputError(
      "a scene is one of motion or one that fits: outputs of kind \"fit\" and of others cannot stand together",
      std::find_if(study.outputs.begin(), study.outputs.end(), fits)->place, "make two studies");
}

}  // namespace froude::sweep
