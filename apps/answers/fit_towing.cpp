/// \file  Fits of kind "towing": drag of a cylinder at steady speed.
#include <algorithm>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

class TowingFits final : public FitKindOf<TowingModel, ::fit::towing::Problem> {
 public:
  TowingFits()
      : FitKindOf(
            {.word = "towing",
             .model = Binding<TowingModel>("", "drag at steady speed").part(cylinder_keys(), &TowingModel::cylinder),
             .channels = {text("speed", "speed of the carriage"), text("force", "measured force"),
                          text("speed_sd", "standard deviation of the speed").optional(),
                          text("force_sd", "standard deviation of the force").optional()},
             .ask = Binding<TowingModel>("", "")
                        .optional(texts("coefficients", "drag cd, all that it tells").one_of({"cd"}))
                        .key(accept_key("\"residuals\" larger than the stated deviations allow do not keep the value "
                                        "back; its interval is then as wide as they make it"),
                             &TowingModel::accept_residuals)}) {}

 private:
  void finish(const FitTables& t, const FitScene& scene, TowingModel& towing) const override {
    towing.confidence = scene.confidence;
    for (const auto& c : wanted(t, {"cd", "cm", "ca"}, "[\"cd\"]", "ask for cd, cm or ca"))
      if (c.value != "cd")
        throw hydro::InputError(
            fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value), c.place,
            "ask for \"cd\" alone");
  }

  ::fit::towing::Problem problem(const FitScene& scene, const TowingModel& model) const override {
    ::fit::towing::Problem out{model.cylinder, {}, model};
    for (const auto& file : scene.files) {
      const Measurements measured(scene, file.value);
      const auto column = [&](const char* role, const hydro::Dimension& dimension) {
        const std::vector<double> values = measured.of_role(role, dimension);
        return values.empty() ? std::vector<double>(measured.table.rows()) : values;  // a deviation that is not known
      };
      const auto speed = column("speed", dim::velocity), speed_sd = column("speed_sd", dim::velocity);
      const auto force = measured.load(), force_sd = column("force_sd", dim::force);
      for (std::size_t i = 0; i < force.size(); ++i) out.runs.push_back({speed[i], speed_sd[i], force[i], force_sd[i]});
    }
    return out;
  }

  Remedy remedy(const FitScene& scene, const ::fit::towing::Problem&, const Solution&) const override {
    return {
        scene.model_place,
        "cd may depend on speed: fit fewer runs, or state the deviations that they have; to have their mean all the "
        "same: [ask] accept = [\"residuals\"]"};
  }

  Panels panels(const ::fit::towing::Problem& problem, const Solution& solution) const override {
    if (solution.report.refused) return {};
    const auto& fit = solution.fit;
    plot::Series points{"runs", {}, {}, false, true};
    for (std::size_t i = 0; i < problem.runs.size(); ++i) {
      points.x.push_back(problem.runs[i].speed);
      points.y.push_back(fit.points[i].cd);
    }
    const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
    const std::vector<double> ends{*low, *high};
    return {{.x = {"speed", "m/s"},
             .y = {"C_D"},
             .series = {points, {"together", ends, {*fit.cd.value, *fit.cd.value}}},
             .bands = {{fmt::format("{:g} %", 100 * fit.confidence),
                        ends,
                        {fit.cd.interval.low, fit.cd.interval.low},
                        {fit.cd.interval.high, fit.cd.interval.high}}}}};
  }
};

}  // namespace

Binding<::fit::Cylinder> cylinder_keys() {
  using ::fit::Cylinder;
  const auto water =
      Binding<Cylinder>("[model.water]", "the water of the experiment")
          .key(positive("density", dim::density, "of the water"), &Cylinder::density)
          .optional(positive("viscosity", dim::kinematic_viscosity, "kinematic; gives the Reynolds number"),
                    &Cylinder::viscosity);
  return Binding<Cylinder>("", "")
      .key(positive("diameter", dim::length, "of the cylinder"), &Cylinder::diameter)
      .key(positive("length", dim::length, "of the cylinder in the water"), &Cylinder::length)
      .table("water", water)
      .needed();
}

std::unique_ptr<const FitKind> towing_fit() { return std::make_unique<TowingFits>(); }

}  // namespace froude::scene
