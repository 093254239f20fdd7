/// \file  Fits of kind "delay": how late one channel is behind another.
#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "fit/problem/delay.hpp"

namespace froude::scene {
namespace {

using DelayProblem = ::fit::delay::Problem;

struct DelayModel : ::fit::delay::Options {
  std::optional<Located<std::filesystem::path>> second_file;
  ::fit::PrepareOptions prepare = {};
};

Binding<DelayModel> delay_keys() {
  using enum ::fit::OffsetOptions::Sign;
  return Binding<DelayModel>("",
                             "how late one channel is behind another that shows the same, whatever its unit and zero")
      .optional(
          positive("longest", hydro::dim::time,
                   "the delay is looked for so far either way; left out: wherever half of the shorter record lies "
                   "within the other"),
          [](const Value& v, DelayModel& out) { out.search.longest = v.number; })
      .optional(quantity("around", hydro::dim::time,
                         "what the delay is known to be nearly, about which it is looked for; left out: 0 s")
                    .only_beside("longest"),
                [](const Value& v, DelayModel& out) { out.search.around = v.number; })
      .optional(text("sign", "of the second channel against the first; left out: whichever is more alike")
                    .one_of({"same", "opposite"}),
                [](const Value& v, DelayModel& out) { out.search.sign = v.text == "same" ? same : opposite; })
      .optional(effect("one_source",
                       "both channels are known to be of one source, a sea or a motor: that unrelated ones may be as "
                       "alike by chance is no reason to refuse"),
                [](const Value&, DelayModel& out) { out.one_source = true; });
}

class DelayFits final : public FitKindOf<DelayModel, DelayProblem> {
 public:
  DelayFits()
      : FitKindOf(
            {.word = "delay",
             .model = delay_keys(),
             .channels =
                 {text("time", "time"), text("first", "the channel that is early, if the delay is positive"),
                  text("second", "the channel whose delay behind the first is told"),
                  text("second_time", "of a second file, where its column is not called as the first's").optional()},
             .data = Binding<DelayModel>("", "").optional(
                 text("second_file",
                      "CSV that holds the second channel, on a clock of its own; left out: the "
                      "file of the first"),
                 &DelayModel::second_file)}) {}

  std::string said_of_line(const FitScene&, const std::string&) const override {
    return ", and a delay does not depend on it";
  }

 private:
  void finish(const FitTables& t, const FitScene& scene, DelayModel& model) const override {
    only_prepares(t, {"window"}, "leave it out: both channels are compared as they were recorded",
                  "which has no cycles of full amplitude");
    if (const auto& w = model.prepare.window; w.kind == ::fit::WindowChoice::Kind::span) model.window = {w.from, w.to};
    const std::string &first = scene.channels.at("first"), &second = scene.channels.at("second");
    if (model.second_file && scene.files.size() != 1)
      throw t.data().wrong("second_file", "goes with one file of the first channel",
                           "write one scene for each pair of records");
    if (!model.second_file && t.channels().has("second_time"))
      throw t.channels().wrong("second_time", "does not act without a second_file: a record has one clock",
                               "leave it out, or name [data] second_file");
    if (!model.second_file && first == second)
      throw t.channels().wrong("second", "names the same column as first", "name another column, or a second_file");
    model.search.confidence = scene.confidence;
    model.search.first = first;
    model.search.second = second;
    model.search.remedy =
        "take a record with a beginning or a change in it; or bound the delay by less than half of that, "
        "[model] longest and around, and say which sign the second channel has, [model] sign";
  }

  DelayProblem problem(const FitScene& scene, const DelayModel& model) const override {
    DelayProblem out{.runs = {}, .options = model};
    for (const auto& [source, row] : runs_of(scene)) {
      const Measurements one(scene, source.file), two(scene, model.second_file ? model.second_file->value : source.file,
                                                      model.second_file ? model.second_file->place : hydro::Place{});
      const char* clock = scene.channels.count("second_time") > 0 ? "second_time" : "time";
      out.options.unit = one.unit(scene.channels.at("first"));
      out.runs.push_back({source, one.time(), one.column(scene.channels.at("first")),
                          two.of_role(clock, hydro::dim::time), two.column(scene.channels.at("second"))});
    }
    return out;
  }

  /// The first channel, and the second as it would be had it come in time, in the unit of the first.
  Panels panels(const DelayProblem& problem, const Solution& solution) const override {
    Panels out;
    for (std::size_t i = 0; i < solution.runs.size(); ++i) {
      const auto& [time, first, offset] = solution.runs[i];
      const auto& run = problem.runs[i];
      std::vector<double> moved, scaled;
      for (std::size_t k = 0; k < run.second.size(); ++k) {
        const double at = run.second_time[k] - offset.lag;
        if (at < time.front() || at > time.back()) continue;
        moved.push_back(at);
        scaled.push_back(offset.level + offset.scale * run.second[k]);
      }
      const auto& names = problem.options.search;
      plot::Series second =
          thinned(fmt::format("{}, {:.4g} s earlier and scaled", names.second, offset.lag), moved, scaled);
      second.dashed = true;
      out.push_back({.x = {"time", "s"},
                     .y = {fmt::format("{} of {}", names.first, run.source.name()), problem.options.unit},
                     .series = {thinned(names.first, time, first), std::move(second)}});
    }
    return out;
  }
};

}  // namespace

std::unique_ptr<const FitKind> delay_fit() { return std::make_unique<DelayFits>(); }

}  // namespace froude::scene
