/// \file  Fits of kind "decay": period and damping of a body let go.
#include <cmath>
#include <limits>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"

namespace froude::scene {
namespace {

void check_channels(const FitTables& t, const DecayModel& decay) {
  const Record& channels = t.channels();
  if (decay.motion.pendulum && channels.has("position"))
    throw t.model().wrong("restoring", "is by the sine of an angle, and the channel position is a length",
                          "name the channel angle, or take restoring = \"linear\"");
  if (channels.has("angle") == channels.has("position"))
    throw channels.refused("needs either position or angle for a fit of kind \"decay\"",
                           "name the column of the motion");
}

/// The terms that are asked for; true if a memory is among them.
bool read_terms(const FitTables& t, ::fit::DampingTerms& terms) {
  terms = {.linear = false};
  bool memory = false;
  const std::pair<std::string_view, bool*> known[] = {{"linear", &terms.linear},
                                                      {"quadratic", &terms.quadratic},
                                                      {"cubic", &terms.cubic},
                                                      {"coulomb", &terms.coulomb},
                                                      {"memory", &memory}};
  for (const auto& c : wanted(t, {"linear", "quadratic", "cubic", "coulomb", "memory"}, "[\"linear\", \"quadratic\"]",
                              "a decay knows linear, quadratic, cubic, coulomb and memory"))
    for (const auto& [name, asked] : known)
      if (c.value == name) *asked = true;
  return memory;
}

::fit::DecayMemoryOptions memory_of(const FitTables& t, const ::fit::DecayOptions& options) {
  const Record& model = t.model();
  if (!model.has("start"))
    throw model.refused("needs \"start\" for a memory: what does the radiation memory hold at the first sample?",
                        "add start = \"let go from rest\" if the record begins there, or start = \"in motion\"");
  if (options.terms.coulomb)
    throw t.ask().wrong("coefficients",
                        "may not hold coulomb beside memory: a body at rest would not be at rest for good",
                        "leave one of them out");
  if (options.pendulum)
    throw model.wrong("restoring", "must be linear with a memory: radiation is known for small motions",
                      "leave it out");
  return {.terms = options.terms,
          .starts_empty = model.text("start") == "let go from rest",
          .confidence = options.confidence};
}

using ::fit::Coefficient;
using DecayRun = ::fit::decay::FittedRun;

std::vector<double> column_of(const Eigen::MatrixXd& band) {
  return std::vector<double>(band.data(), band.data() + band.rows());
}

/// A coefficient over frequency with its interval; the swing's frequency is marked.
plot::Panel panel_over_frequency(const DecayRun& run, bool damping, const char* unit, double confidence) {
  plot::Series value{"by the memory", {}, {}}, low{fmt::format("{:g} % interval", 100 * confidence), {}, {}, true},
      swing{"at the swing", {}, {}, false, true};
  const auto part = [&](const ::fit::DecayRadiation& r) { return damping ? r.damping : r.added_mass; };
  for (const auto& r : run.curve) {
    value.x.push_back(r.omega);
    value.y.push_back(*part(r).value);
    low.x.push_back(r.omega);
    low.y.push_back(part(r).interval.low);
  }
  low.x.push_back(low.x.back());
  low.y.push_back(std::numeric_limits<double>::quiet_NaN());
  for (const auto& r : run.curve) {
    low.x.push_back(r.omega);
    low.y.push_back(part(r).interval.high);
  }
  swing.x = {run.swing->omega};
  swing.y = {*part(*run.swing).value};
  return {.x = {"frequency", "rad/s"},
          .y = {run.name() + ": " + (damping ? "damping" : "added mass"), unit},
          .series = {value, low, swing}};
}

/// One record, what was fitted to it and what is left of it, by the memory too.
void add_record(const ::fit::decay::Problem& problem, const DecayRun& run, std::size_t w, Panels& panels) {
  const auto& m = run.fit.motion;
  const ::fit::decay::Record& r = run.records[w];
  const auto band = [&](const auto& of) { return of.empty() ? std::vector<double>() : column_of(of[w]); };
  Panels both = panels_of(FittedRecord{.legend = r.name + ": measured",
                                       .axis = {problem.turns ? "angle" : "position", problem.turns ? "rad" : "m"},
                                       .confidence = problem.options.motion.confidence,
                                       .time = r.time,
                                       .measured = r.values,
                                       .fitted = column_of(m.motion[w]),
                                       .sample_band = band(m.sample_band),
                                       .fit_band = band(m.fit_band)});
  if (run.memory) {
    std::vector<double> by_memory = column_of(run.memory->motion.motion[w]);
    for (std::size_t i = 0; i < by_memory.size(); ++i) by_memory[i] = r.values[i] - by_memory[i];
    both[1].series.push_back({"measured − fitted with a memory", r.time, by_memory});
  }
  panels.insert(panels.end(), both.begin(), both.end());
}

std::vector<Coefficient> in_table(const DecayRun& run) {
  std::vector<Coefficient> all{run.fit.period};
  all.insert(all.end(), run.fit.damping.begin(), run.fit.damping.end());
  if (run.memory) all.insert(all.end(), run.memory->memory.begin(), run.memory->memory.end());
  return all;
}

Binding<DecayModel> decay_keys() {
  return Binding<DecayModel>(
             "", "period and damping of a body let go: x'' + b1 x' + b2 |x'| x' + b3 x'^3 + c sgn x' + w0^2 x = 0")
      .key(text("restoring", "by x, or by sin x for a pendulum")
               .one_of({"linear", "sine"})
               .or_default("linear", "small angles, and all that floats"),
           [](const Value& v, DecayModel& decay) { decay.motion.pendulum = v.text == "sine"; })
      .optional(
          text("start",
               "with memory among the coefficients: the record begins where the body was let go from rest in calm "
               "water, with an empty radiation memory; or in motion, and what that memory holds is fitted")
              .one_of({"let go from rest", "in motion"}))
      .table("body", restored_body(), &DecayModel::body);
}

Binding<DecayModel> asked_of_decays() {
  return Binding<DecayModel>("", "")
      .optional(texts("coefficients",
                      "the damping terms that act, linear, quadratic, cubic, coulomb, and memory: a pair of poles of "
                      "the water's")
                    .one_of({"linear", "quadratic", "cubic", "coulomb", "memory"}))
      .key(accept_key("\"residuals\" larger than half of the variance do not keep values back; the report says by how "
                      "much"),
           &DecayModel::accept_residuals)
      .key(effect("profile", "intervals of damping from the likelihood itself, which need not be symmetric"),
           &DecayModel::profile)
      .key(effect("together",
                  "one set of coefficients for all runs, with a start and a rest position for each, beside the fit of "
                  "each run alone"),
           &DecayModel::together)
      .key(effect("sensitivity", "the fit repeated with each half of the record"), &DecayModel::sensitivity);
}

class DecayFits final : public FitKindOf<DecayModel, ::fit::decay::Problem> {
 public:
  DecayFits()
      : FitKindOf(
            {.word = "decay",
             .model = decay_keys(),
             .channels = {text("time", "time"), text("position", "the motion").optional(),
                          text("angle", "the motion, in place of a position").optional()},
             .data = Binding<DecayModel>("", "").optional(text(
                 "runs", "CSV with one row for each run: the column file; other columns are carried into the results")),
             .ask = asked_of_decays()}) {}
  bool has_table() const override { return true; }

 private:
  void finish(const FitTables& t, const FitScene& scene, DecayModel& decay) const override {
    only_prepares(t, {"longest_gap", "outliers", "window"},
                  "leave it out: what is fitted is the motion as it was recorded",
                  "which has no cycles of full amplitude");
    check_channels(t, decay);
    if (decay.body) check_restored(t);
    if (decay.body && !(decay.body->stiffness > 0))
      throw t.model().table("body").refused("needs a stiffness: without one there is no natural period",
                                            "give what brings the body back");
    decay.motion.confidence = scene.confidence;
    if (read_terms(t, decay.motion.terms))
      decay.memory = memory_of(t, decay.motion);
    else if (t.model().has("start"))
      throw t.model().wrong("start", "does not act without a memory",
                            "add \"memory\" to [ask] coefficients, or leave it out");
    if (decay.together && t.data().has("files") && scene.files.size() < 2)
      throw t.ask().wrong("together", "needs two files at least", "name more files, or leave it out");
  }

  ::fit::decay::Problem problem(const FitScene& scene, const DecayModel& model) const override {
    ::fit::decay::Problem out{.turns = scene.turns(), .runs = {}, .body = model.body, .options = model};
    out.motion_slope = motion_slope(scene);
    for (const auto& [source, row] : runs_of(scene, {"file"})) {
      const Measurements measured(scene, source.file);
      out.runs.push_back({source, measured.time(), measured.motion()});
    }
    return out;
  }

  Remedy remedy(const FitScene& scene, const ::fit::decay::Problem&, const Solution& solution) const override {
    using enum ::fit::Refusal::Reason;
    if (solution.report.refused->reason == halves_differ)
      return {
          scene.model_place,
          "take other terms, or the part of the record in which one set of them holds (window of [prepare]); to have "
          "values all the same: [ask] accept = [\"residuals\"]"};
    if (solution.report.refused->reason == search_without_end)
      return {.text = "Take the part of the record that swings (window of [prepare]), or other terms"};
    return {
        scene.model_place,
        "take the part of the record that swings (window of [prepare]), or other terms; to have values all the same: "
        "[ask] accept = [\"residuals\"]"};
  }

  std::string table(const ::fit::decay::Problem& problem, const Solution& solution) const override {
    const auto& runs = solution.runs;
    std::string out = "file";
    for (const auto& [name, value] : runs[0].source.labels) out += "," + name;
    out += fmt::format(",first_amplitude [{}]", problem.turns ? "rad" : "m");
    for (const Coefficient& c : in_table(runs[0]))
      out +=
          fmt::format(",{0} [{1}],{0}_low [{1}],{0}_high [{1}]", c.name, ::fit::decay::unit_of(c.name, problem.turns));
    out += '\n';
    for (const DecayRun& run : runs) {
      out += run.name();
      for (const auto& [name, value] : run.source.labels) out += "," + value;
      out += fmt::format(",{:.6g}", run.decrement.amplitude.front());
      for (const Coefficient& c : in_table(run)) {
        out += c.value ? fmt::format(",{:.6g}", *c.value) : ",";
        // An interval is told for what cannot be told from zero, and is none where a direction is not seen.
        out += std::isfinite(c.interval.low) && std::isfinite(c.interval.high)
                   ? fmt::format(",{:.6g},{:.6g}", c.interval.low, c.interval.high)
                   : ",,";
      }
      out += '\n';
    }
    return out;
  }

  Panels panels(const ::fit::decay::Problem& problem, const Solution& solution) const override {
    const double confidence = problem.options.motion.confidence;
    Panels out;
    for (const DecayRun& run : solution.together ? std::vector{*solution.together} : solution.runs) {
      for (std::size_t w = 0; w < run.records.size(); ++w) add_record(problem, run, w, out);
      if (!run.swing || !run.swing->damping.value) continue;
      const auto unit = [&](const char* of) { return ::fit::decay::unit_with_mass(of, problem.turns); };
      out.push_back(panel_over_frequency(run, false, unit("added_mass"), confidence));
      out.push_back(panel_over_frequency(run, true, unit("damping"), confidence));
    }
    return out;
  }
};

}  // namespace

std::unique_ptr<const FitKind> decay_fit() { return std::make_unique<DecayFits>(); }

}  // namespace froude::scene
