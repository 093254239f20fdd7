#include <algorithm>

#include "fit/friction_ramp.hpp"
#include "fit/runs.hpp"
#include "froude/fit_report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;
using Json = FitJson;

struct FrictionTest {
  std::string name;
  std::vector<double> time, load;  ///< torque on a hinge, force on a slider
  ::fit::FrictionRamp fit;
};

/// One level over all tests, which may differ by more than their own errors.
struct FrictionLevel {
  std::string name;
  std::optional<::fit::RandomEffects> together;  ///< of three tests and more
};

/// A slider has a force, a hinge a torque.
bool slides(const scene::FitScene& scene) { return !scene.force.empty(); }
const char* load_unit(const scene::FitScene& scene) { return slides(scene) ? "N" : "N m"; }

FrictionTest fit_test(const scene::FitScene& scene, const scene::FrictionRampModel& model,
                      const std::filesystem::path& file) try {
  const auto table = hydro::io::CsvTable::read(file);
  FrictionTest test{.name = file.filename().string(),
                    .time = table.column(scene.channels.at("time"), dim::time),
                    .load = slides(scene) ? table.column(scene.force[0].column, dim::force)
                                          : table.column(scene.channels.at("torque"), dim::moment),
                    .fit = {}};
  if (slides(scene) && scene.force[0].turned)
    for (double& f : test.load) f = -f;
  test.fit = ::fit::fit_friction_ramp(test.time, test.load, model.options);
  return test;
} catch (const hydro::InputError& e) {
  throw e.at({.file = file.string()});
}

const Coefficient& level_of(const FrictionTest& test, const std::string& name) {
  return name == "static" ? test.fit.static_level : test.fit.dynamic_level;
}

/// A brake that slips to either side has two signs and one level.
std::vector<FrictionLevel> levels_of(const std::vector<FrictionTest>& tests, double confidence) {
  std::vector<FrictionLevel> out{{"static", {}}, {"dynamic", {}}};
  if (tests.size() < 3) return out;
  for (FrictionLevel& level : out) {
    std::vector<::fit::RunEstimate> runs;
    for (const FrictionTest& test : tests) {
      const Coefficient& c = level_of(test, level.name);
      runs.push_back({std::abs(*c.value), c.standard_error, 0, 0, 0});
    }
    level.together = ::fit::fit_runs(runs, ::fit::Law::constant, confidence);
  }
  return out;
}

void tell(const FrictionTest& test, const Console& console, double confidence, const char* unit) {
  const auto& f = test.fit;
  console.out << fmt::format("{}: slips at {:.4g} s, after growing by {:.3g} {} a second; residual {:.3g} {} rms\n",
                             test.name, f.slip_s, f.rate, unit, f.residual_rms, unit);
  for (const Coefficient* c : {&f.static_level, &f.dynamic_level, &f.drop})
    console.out << fmt::format("  {:<8} {:.4g} {}, {:g} % interval {:.4g} to {:.4g}\n", c->name, *c->value, unit,
                               100 * confidence, c->interval.low, c->interval.high);
  console.out << fmt::format("  dynamic over static {:.3g}; while it slides the load changes by {:.2g} {} a second\n",
                             *f.dynamic_level.value / *f.static_level.value, f.slide_rate, unit);
  if (!f.caution.empty()) console.out << "  caution: " << f.caution << '\n';
}

void tell(const FrictionLevel& level, std::size_t tests, const Console& console, double confidence, const char* unit) {
  if (!level.together) return;
  const auto& r = *level.together;
  console.out << fmt::format(
      "{} over {} tests: {:.4g} {}, {:g} % interval {:.4g} to {:.4g}; from test to test ±{:.2g}; the next between "
      "{:.4g} and {:.4g}\n",
      level.name, tests, r.coefficients[0], unit, 100 * confidence, r.intervals[0].low, r.intervals[0].high, r.between,
      r.prediction.low, r.prediction.high);
}

Json as_json_of(const FrictionTest& test) {
  const auto& f = test.fit;
  Json j{{"file", test.name},
         {"slip_s", f.slip_s},
         {"rate", f.rate},
         {"slide_rate", f.slide_rate},
         {"residual_rms", f.residual_rms}};
  if (!f.caution.empty()) j["caution"] = f.caution;
  for (const Coefficient* c : {&f.static_level, &f.dynamic_level, &f.drop}) {
    j[c->name] = as_json(*c);
    j[c->name].erase("shift_per_degree");
  }
  return j;
}

Json all_as_json(const scene::FitScene& scene, const std::vector<FrictionTest>& tests,
                 const std::vector<FrictionLevel>& levels) {
  Json j{{"scene", scene.file.filename().string()}, {"kind", scene.kind()}, {"confidence", scene.confidence}};
  for (const FrictionLevel& level : levels) {
    if (level.together || tests.size() == 1)
      j["coefficients"][level.name] = fmt::format(
          "{:.10g} {}",
          level.together ? level.together->coefficients[0] : std::abs(*level_of(tests[0], level.name).value),
          load_unit(scene));
    if (!level.together) continue;
    const auto& r = *level.together;
    j["together"][level.name] = {{"value", r.coefficients[0]},
                                 {"interval", {r.intervals[0].low, r.intervals[0].high}},
                                 {"between_tests", r.between},
                                 {"prediction", {r.prediction.low, r.prediction.high}}};
  }
  for (const FrictionTest& test : tests) j["run"].push_back(as_json_of(test));
  return j;
}

plot::Figure figure(const scene::FitScene& scene, const std::vector<FrictionTest>& tests) {
  plot::Figure f{.title = scene.title.empty() ? scene.file.filename().string() : scene.title, .panels = {}};
  for (const FrictionTest& test : tests)
    f.panels.push_back({.x = {"time", "s"},
                        .y = {slides(scene) ? "force" : "torque", load_unit(scene)},
                        .series = {{test.name + ": measured", test.time, test.load},
                                   {"growing", test.fit.line_time, test.fit.line, true, false, true},
                                   {"sliding", test.fit.slide_time, test.fit.slide, true, false, true}}});
  return f;
}

}  // namespace

void fit_model(const scene::FitScene& scene, const scene::FrictionRampModel& model, const FitArguments& arguments,
               const Console& console) {
  std::vector<FrictionTest> tests;
  for (const auto& file : scene.files) tests.push_back(fit_test(scene, model, file.value));
  const auto levels = levels_of(tests, scene.confidence);
  if (!console.json) {
    for (const FrictionTest& test : tests) tell(test, console, scene.confidence, load_unit(scene));
    for (const FrictionLevel& level : levels) tell(level, tests.size(), console, scene.confidence, load_unit(scene));
  }
  deliver(arguments, console, all_as_json(scene, tests, levels), figure(scene, tests));
}

}  // namespace froude
