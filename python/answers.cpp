// What else a scene is asked: responses, free motions, the water, plans, prices, fits.
#include <sstream>

#include "bindings.hpp"
#include "compile/hulls.hpp"
#include "computing.hpp"
#include "fit/report.hpp"
#include "fit/search_watch.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"

namespace froude::python {
namespace {

/// While one lives, systems of equations that are solved for meshes tell how far they are.
class ToldHulls {
 public:
  explicit ToldHulls(Computing& computing) : set_(computing.tells()) {
    if (set_) compile::watch_hulls([&](int done, int all) { computing.done(static_cast<double>(done) / all); });
  }
  ~ToldHulls() {
    if (set_) compile::watch_hulls({});
  }
  ToldHulls(const ToldHulls&) = delete;
  ToldHulls& operator=(const ToldHulls&) = delete;

 private:
  bool set_;
};

/// A call of a scene's own by that name, which tells its progress only while it solves for hulls.
template <class Answer>
auto asking(const char* name, Answer (Scene::*ask)() const) {
  return [name, ask](const HeldScene& held, const py::object& progress) {
    Computing computing(name, progress);
    const ToldHulls hulls(computing);
    return computing.of(held, [&](const Scene& scene) { return (scene.*ask)(); });
  };
}

// ---- plan ----

std::string text_of(const Plan& plan) {
  std::string out;
  for (const Plan::Section& section : plan.sections) {
    out += section.title + '\n';
    for (const PlanLine& line : section.lines)
      out += fmt::format("  {} {:<18} {}{}\n", line.runs ? "+" : "-", line.effect, line.method,
                         line.size.empty() ? "" : "; " + line.size);
  }
  for (const std::string& note : plan.notes) out += "note: " + note + '\n';
  return out;
}

void add_plan(py::module_& m) {
  py::class_<PlanLine>(m, "PlanLine", "An effect, how it is computed and how large it is; or why it is left out.")
      .def_readonly("effect", &PlanLine::effect, "Its name.")
      .def_readonly("method", &PlanLine::method, "How it is computed, or why it is left out.")
      .def_readonly("size", &PlanLine::size, "How large it is, in words; \"\" where that is not known.")
      .def_readonly("runs", &PlanLine::runs, "False where it is left out.");
  py::class_<Plan>(m, "Plan", "What the answers to a scene will take; str(plan) is what the program prints.")
      .def_property_readonly(
          "sections",
          [](const Plan& plan) {
            std::vector<std::pair<std::string, std::vector<PlanLine>>> out;
            for (const Plan::Section& section : plan.sections) out.emplace_back(section.title, section.lines);
            return out;
          },
          "Pairs of a title and its lines.")
      .def_readonly("notes", &Plan::notes, "What is not to be trusted, or was decided; a sentence each.")
      .def("__str__", &text_of);
}

// ---- cost ----

/// By the name of the measure; those that do not apply have no signal and are left out.
py::dict errors_of(const CostErrors& errors) {
  py::dict out;
  for (std::size_t i = 0; i < error_measures; ++i)
    if (!errors[i].signal.empty())
      out[py::str(name_of(static_cast<ErrorMeasure>(i)))] = std::pair(errors[i].error, errors[i].signal);
  return out;
}

ErrorMeasure measure_called(const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < error_measures; ++i) {
    names.push_back(name_of(static_cast<ErrorMeasure>(i)));
    if (names.back() == name) return static_cast<ErrorMeasure>(i);
  }
  throw hydro::InputError(fmt::format("there is no measure \"{}\"", name), {},
                          fmt::format("measures are: {}", fmt::join(names, ", ")));
}

void add_cost(py::module_& m) {
  py::class_<CostRung>(m, "CostRung", "One setting of an approximation, and what it costs.")
      .def_readonly("approximation", &CostRung::approximation, "\"step\", \"memory\", ...; \"together\": several.")
      .def_readonly("setting", &CostRung::setting, "\"0.05 s\", ...")
      .def_property_readonly(
          "error", [](const CostRung& r) { return errors_of(r.error); },
          "By measure the error against the reference, relative, and the signal that is worst.")
      .def_readonly("preparing_s", &CostRung::preparing_s, "Processor time of making the model, s.")
      .def_readonly("answering_s", &CostRung::answering_s, "Processor time of stepping it or solving, s.")
      .def_readonly("as_scene", &CostRung::as_scene, "True for what the scene does by itself.")
      .def_readonly("on_front", &CostRung::on_front, "True where nothing cheaper is as accurate.")
      .def_readonly("refused", &CostRung::refused, "Why there is no answer with it; \"\" where there is.")
      .def_readonly("scene", &CostRung::scene, "The text of the scene with this setting.");
  py::class_<AnswerCost>(m, "AnswerCost", "What the answer to one ask costs.")
      .def_readonly("ask", &AnswerCost::ask, "\"run\" or \"rao\".")
      .def_property_readonly(
          "measure", [](const AnswerCost& a) { return name_of(a.measure); }, "By which the choice goes.")
      .def_readonly("reference", &AnswerCost::reference, "Settings of the reference.")
      .def_readonly("rungs", &AnswerCost::rungs, "CostRung, one for each setting.")
      .def_readonly("chosen", &AnswerCost::chosen, "Index of the cheapest rung within the tolerance; None without.")
      .def_readonly("notes", &AnswerCost::notes, "What was left as it is and why.");
  py::class_<Cost>(m, "Cost",
                   "What accuracy costs: the settings of a scene's approximations, each with error and time.")
      .def_readonly("answers", &Cost::answers, "AnswerCost, one for each ask.")
      .def_readonly("notes", &Cost::notes, "A sentence each.")
      .def_readonly("scene", &Cost::scene, "Text of the scene with the settings chosen; None where one has none.");
  m.def(
      "cost",
      [](const HeldScene& held, std::optional<double> tolerance, const std::string& measure, double repeat_for,
         const py::object& progress) {
        Computing computing("cost", progress);
        const CostOptions options{tolerance, measure_called(measure), repeat_for};
        return computing.of(held, [&](const Scene& scene) {
          return scene.cost(options, [&](double share) { computing.done(share); });
        });
      },
      py::arg("scene"), py::arg("tolerance"), py::arg("measure"), py::arg("repeat_for"), py::arg("progress"),
      "froude.cost");
}

// ---- fit ----

py::object object_of(const ::fit::FactValue& value);

py::dict facts_of(const ::fit::Facts& facts) {
  py::dict out;
  for (const ::fit::Fact& fact : facts) out[py::str(fact.name)] = object_of(fact.value);
  return out;
}

py::object object_of(const ::fit::FactValue& value) {
  const auto pair = [](const ::fit::Interval& interval) { return std::pair(interval.low, interval.high); };
  return std::visit(
      [&](const auto& v) -> py::object {
        using V = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<V, ::fit::Facts>) {
          return facts_of(v);
        } else if constexpr (std::is_same_v<V, std::vector<::fit::Facts>>) {
          py::list out;
          for (const ::fit::Facts& one : v) out.append(facts_of(one));
          return out;
        } else if constexpr (std::is_same_v<V, ::fit::Interval>) {
          return py::cast(pair(v));
        } else if constexpr (std::is_same_v<V, std::vector<::fit::Interval>>) {
          py::list out;
          for (const ::fit::Interval& one : v) out.append(pair(one));
          return out;
        } else {
          return py::cast(v);
        }
      },
      value);
}

/// \throws hydro::NumericsError where values may not be told
::fit::Report told(::fit::Report report) {
  if (report.refused)
    throw hydro::NumericsError(report.refused->best_point.empty()
                                   ? report.refused->why
                                   : fmt::format("{}; the best point, no value to take: {}", report.refused->why,
                                                 fmt::join(report.refused->best_point, ", ")));
  return report;
}

void add_fit(py::module_& m) {
  using ::fit::Estimate, ::fit::Report;
  py::class_<Estimate>(m, "Estimate", "A fitted coefficient: with an interval, or with the reason why it has no value.")
      .def_property_readonly(
          "name", [](const Estimate& e) { return e.coefficient.name; }, "Of the coefficient.")
      .def_property_readonly(
          "value", [](const Estimate& e) { return e.coefficient.value; },
          "In `unit`; None where the data do not tell it, see `why_not`.")
      .def_readonly("unit", &Estimate::unit, "\"\" for a number.")
      .def_property_readonly(
          "standard_error", [](const Estimate& e) { return e.coefficient.standard_error; },
          "From the scatter of the data, in `unit`.")
      .def_property_readonly(
          "systematic_error", [](const Estimate& e) { return e.coefficient.systematic_error; },
          "From what is the same throughout: calibration, geometry, delay; in `unit`.")
      .def_property_readonly(
          "interval",
          [](const Estimate& e) { return std::pair(e.coefficient.interval.low, e.coefficient.interval.high); },
          "At the confidence of the scene, in `unit`.")
      .def_property_readonly(
          "why_not", [](const Estimate& e) { return e.coefficient.why_not; }, "Why there is no value; \"\" with one.")
      .def("__repr__", [](const Estimate& e) {
        const auto& c = e.coefficient;
        if (!c.value) return fmt::format("<froude.Estimate {}: {}>", c.name, c.why_not);
        return fmt::format("<froude.Estimate {} = {:.6g} {}[{:.6g}, {:.6g}]>", c.name, *c.value,
                           e.unit.empty() ? "" : e.unit + " ", c.interval.low, c.interval.high);
      });
  py::class_<Report>(m, "Fit", "What measurements tell: fit[\"cd\"] is the first estimate of that name.")
      .def(
          "__getitem__",
          [](const Report& report, const std::string& name) -> const Estimate& {
            if (const Estimate* found = report.find(name)) return *found;
            throw py::key_error(fmt::format("no coefficient \"{}\" was fitted", name));
          },
          py::arg("coefficient"), py::return_value_policy::reference_internal,
          "The first estimate of a name, here or in the parts. Raises KeyError if there is none.")
      .def_readonly("estimates", &Report::estimates, "Estimates of the whole.")
      .def_readonly("parts", &Report::parts, "Fit of each run, or of runs together, where there are several.")
      .def_readonly("heading", &Report::heading, "Of a part.")
      .def_property_readonly(
          "facts", [](const Report& r) { return facts_of(r.facts); },
          "Numbers beside the estimates, SI, unless the name ends in a unit.")
      .def_readonly("remarks", &Report::remarks, "Correlations, residuals, the search; a sentence each.")
      .def_readonly("cautions", &Report::cautions, "What is not to be trusted; a sentence each.");
  m.def(
      "fit",
      [](const HeldScene& held, const py::object& progress) {
        Computing computing("fit", progress);
        return told(computing.of(held, [&](const Scene& scene) {
          const ::fit::SearchWatch searches([&](double share) { computing.done(share); });
          return scene.fit();
        }));
      },
      py::arg("scene"), py::arg("progress"), "froude.fit");
}

/// What `froude export --json` tells.
std::string export_results_as(const ExportArguments& arguments) {
  std::ostringstream told, nowhere;
  Computing computing("export", py::none());
  computing.of([&] {
    export_results(arguments, Console{.out = told, .err = nowhere, .json = true});
    return 0;
  });
  return told.str();
}

void add_export(py::module_& m) {
  m.def(
      "export",
      [](const std::vector<std::filesystem::path>& results, const std::filesystem::path& output,
         const std::string& form, const std::vector<std::string>& signals, const std::optional<std::string>& start,
         const std::optional<std::string>& end, const std::optional<std::string>& every,
         const std::optional<std::filesystem::path>& scene_folder) {
        return export_results_as({.results = results,
                                  .output = output,
                                  .format = form,
                                  .signals = signals,
                                  .from = start,
                                  .to = end,
                                  .every = every,
                                  .scene_folder = scene_folder});
      },
      py::arg("results"), py::arg("output"), py::arg("form"), py::arg("signals"), py::arg("start"), py::arg("end"),
      py::arg("every"), py::arg("scene_folder"), "froude.export");
}

}  // namespace

void add_answers(py::module_& m) {
  add_plan(m);
  add_export(m);
  add_cost(m);
  add_fit(m);
  const py::arg scene("scene"), progress("progress");
  m.def("rao", asking("rao", &Scene::rao), scene, progress, "froude.rao");
  m.def("field", asking("field", &Scene::field), scene, progress, "froude.field");
  m.def("modes", asking("modes", &Scene::modes), scene, progress, "froude.modes");
  m.def("plan", asking("plan", &Scene::plan), scene, progress, "froude.plan");
  m.def(
      "waves",
      [](const HeldScene& held, const py::object& told) {
        Computing computing("waves", told);
        return computing.of(
            held, [&](const Scene& read) { return read.waves([&](double share) { computing.done(share); }); });
      },
      scene, progress, "froude.waves");
}

}  // namespace froude::python
