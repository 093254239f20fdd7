/// \file  Fits of kind "friction ramp": friction of a joint whose load grows until it slips.
#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "fit/problem/friction.hpp"

namespace froude::scene {
namespace {

using RampOptions = ::fit::FrictionRampOptions;

Binding<RampOptions> ramp_keys() {
  namespace dim = hydro::dim;
  return Binding<RampOptions>("",
                              "static and dynamic friction from a torque, or a force on a slider, that grows until the "
                              "joint slips, one test each file")
      .key(positive("ramp", dim::time, "before the slip: there the torque is taken as a straight line"),
           &RampOptions::ramp_s)
      .key(positive("slide", dim::time, "after it: there the torque is taken as constant"), &RampOptions::slide_s)
      .key(quantity("drop", dim::time, "that the fall between them may take, filters counted")
               .within(Limit::not_negative)
               .or_default("0 s", "a record that was not filtered"),
           &RampOptions::drop_s);
}

class FrictionRampFits final : public FitKindOf<RampOptions, ::fit::friction::Problem> {
 public:
  FrictionRampFits()
      : FitKindOf({.word = "friction ramp",
                   .model = ramp_keys(),
                   .channels = {text("time", "time"), text("torque", "of a hinge: the measured torque").optional(),
                                text("force", "of a slider: the measured force").optional()}}) {}

 private:
  void finish(const FitTables& t, const FitScene& scene, RampOptions& options) const override {
    const Record& channels = t.channels();
    if (channels.has("torque") == channels.has("force"))
      throw channels.refused("needs either torque or force for a fit of kind \"friction ramp\"",
                             "name the torque on a hinge, or the force on a slider");
    options.confidence = scene.confidence;
  }

  ::fit::friction::Problem problem(const FitScene& scene, const RampOptions& options) const override {
    ::fit::friction::Problem out{.slides = !scene.turns(), .runs = {}, .options = options};
    out.load_slope = load_slope(scene);
    for (const auto& [source, row] : runs_of(scene)) {
      const Measurements measured(scene, source.file);
      out.runs.push_back({source, measured.time(), measured.load()});
    }
    return out;
  }

  Panels panels(const ::fit::friction::Problem& problem, const Solution& solution) const override {
    Panels out;
    for (std::size_t i = 0; i < problem.runs.size(); ++i) {
      const auto& [source, time, load] = problem.runs[i];
      const ::fit::FrictionRamp& fit = solution.fits[i];
      out.push_back({.x = {"time", "s"},
                     .y = {problem.slides ? "force" : "torque", unit_of_load(problem)},
                     .series = {{source.name() + ": measured", time, load},
                                {"growing", fit.line_time, fit.line, true, false, true},
                                {"sliding", fit.slide_time, fit.slide, true, false, true}}});
    }
    return out;
  }
};

}  // namespace

std::unique_ptr<const FitKind> friction_ramp_fit() { return std::make_unique<FrictionRampFits>(); }

}  // namespace froude::scene
