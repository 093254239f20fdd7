#include <algorithm>

#include "fit/friction_ramp.hpp"
#include "fit/runs.hpp"
#include "froude/fit_summary.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;
using ::fit::Coefficient;

struct FrictionTest {
  std::string name;
  std::vector<double> time, load;  ///< torque on a hinge, force on a slider
  ::fit::FrictionRamp fit;
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

FitSummary summary_of(const FrictionTest& test, const std::string& unit) {
  const auto& f = test.fit;
  FitSummary summary{.key = "run", .one_of_many = true};
  summary.heading = fmt::format("{}: slips at {:.4g} s, after growing by {:.3g} {} a second; residual {:.3g} {} rms",
                                test.name, f.slip_s, f.rate, unit, f.residual_rms, unit);
  summary.facts = {{"file", test.name},
                   {"slip_s", f.slip_s},
                   {"rate", f.rate},
                   {"slide_rate", f.slide_rate},
                   {"residual_rms", f.residual_rms}};
  for (const Coefficient* c : {&f.static_level, &f.dynamic_level, &f.drop}) summary.estimates.push_back({*c, unit});
  summary.say("dynamic over static {:.3g}; while it slides the load changes by {:.2g} {} a second",
              *f.dynamic_level.value / *f.static_level.value, f.slide_rate, unit);
  summary.warn(f.caution);
  return summary;
}

/// Each level of all tests together, which may differ by more than their own errors. A brake that slips to either side
/// has two signs and one level.
FitSummary summary_of(const scene::FitScene& scene, const std::vector<FrictionTest>& tests) {
  FitSummary summary = begin_summary(scene), together{.key = "together"};
  const std::string unit = load_unit(scene);
  for (const FrictionTest& test : tests) summary.parts.push_back(summary_of(test, unit));
  for (const auto level : {&::fit::FrictionRamp::static_level, &::fit::FrictionRamp::dynamic_level}) {
    const std::string name = (tests[0].fit.*level).name;
    const auto include = [&](double value) {
      summary.facts["coefficients"][name] = fmt::format("{:.10g} {}", value, unit);
    };
    if (tests.size() == 1) include(std::abs(*(tests[0].fit.*level).value));
    if (tests.size() < 3) continue;
    std::vector<::fit::RunEstimate> runs;
    for (const FrictionTest& test : tests)
      runs.push_back({std::abs(*(test.fit.*level).value), (test.fit.*level).standard_error, 0, 0, 0});
    const auto law = ::fit::fit_runs(runs, ::fit::Law::constant, scene.confidence);
    include(law.coefficients[0]);
    together.parts.push_back(over_runs(name, unit, law, "test", tests.size(), scene.confidence));
  }
  if (!together.parts.empty()) summary.parts.push_back(std::move(together));
  return summary;
}

plot::Figure figure(const scene::FitScene& scene, const std::vector<FrictionTest>& tests) {
  plot::Figure f{.title = title_of(scene), .panels = {}};
  for (const FrictionTest& test : tests)
    f.panels.push_back({.x = {"time", "s"},
                        .y = {slides(scene) ? "force" : "torque", load_unit(scene)},
                        .series = {{test.name + ": measured", test.time, test.load},
                                   {"growing", test.fit.line_time, test.fit.line, true, false, true},
                                   {"sliding", test.fit.slide_time, test.fit.slide, true, false, true}}});
  return f;
}

}  // namespace

FitOutcome fit_model(const scene::FitScene& scene, const scene::FrictionRampModel& model) {
  std::vector<FrictionTest> tests;
  for (const auto& file : scene.files) tests.push_back(fit_test(scene, model, file.value));
  return {summary_of(scene, tests), figure(scene, tests)};
}

}  // namespace froude
