/// \file  Fits of kind "restoring": stiffness from loads that were held.
#include <algorithm>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "fit/problem/restoring.hpp"

namespace froude::scene {
namespace {

using RestoringOptions = ::fit::restoring::Options;

class RestoringFits final : public FitKindOf<RestoringOptions, ::fit::restoring::Problem> {
 public:
  RestoringFits()
      : FitKindOf({.word = "restoring",
                   .model = Binding<RestoringOptions>(
                       "",
                       "stiffness of a mooring, a spring or what floats, from loads that were held, one test each "
                       "file"),
                   .channels = {text("position", "where the load brought the body").optional(),
                                text("angle", "where the moment brought the body").optional(),
                                text("force", "the load that holds a position, positive along it").optional(),
                                text("torque", "the moment that holds an angle, positive along it").optional()},
                   .ask = Binding<RestoringOptions>("", "").optional(
                       texts("coefficients", "stiffness, and cubic, load per motion cubed beside it")
                           .one_of({"stiffness", "cubic"}))}) {}

 private:
  void finish(const FitTables& t, const FitScene& scene, RestoringOptions& options) const override {
    const Record& channels = t.channels();
    if (channels.has("angle") == channels.has("position"))
      throw channels.refused("needs either position or angle for a fit of kind \"restoring\"",
                             "name the column of the motion");
    if (channels.has("position") != channels.has("force") || channels.has("angle") != channels.has("torque"))
      throw channels.refused("needs force beside a position, torque beside an angle", "name what held the body");
    options.confidence = scene.confidence;
    const auto& asked =
        wanted(t, {"stiffness", "cubic"}, "[\"stiffness\"]", "ask for stiffness, or stiffness and cubic");
    const auto asks = [&](const char* word) {
      return std::any_of(asked.begin(), asked.end(), [&](const auto& one) { return one.value == word; });
    };
    if (!asks("stiffness"))
      throw t.ask().wrong("coefficients", "leaves the stiffness out, beside which a cubic term stands",
                          "ask for [\"stiffness\", \"cubic\"]");
    options.cubic = asks("cubic");
  }

  ::fit::restoring::Problem problem(const FitScene& scene, const RestoringOptions& options) const override {
    ::fit::restoring::Problem out{.turns = scene.turns(), .runs = {}, .options = options};
    out.load_slope = load_slope(scene);
    out.motion_slope = motion_slope(scene);
    for (const auto& [source, row] : runs_of(scene)) {
      const Measurements measured(scene, source.file);
      out.runs.push_back({source, measured.motion(), measured.load()});
    }
    return out;
  }

  /// Loads less their preloads over the motion, and the curve.
  Panels panels(const ::fit::restoring::Problem& problem, const Solution& solution) const override {
    plot::Panel out{.x = {problem.turns ? "angle" : "position", problem.turns ? "rad" : "m"},
                    .y = {problem.turns ? "moment" : "force", problem.turns ? "N m" : "N"},
                    .series = {}};
    double low = 0, high = 0;
    for (std::size_t r = 0; r < problem.runs.size(); ++r) {
      const auto& [source, motion, load] = problem.runs[r];
      plot::Series points{source.name(), motion, load, false, true};
      for (double& y : points.y) y -= solution.preload[static_cast<Eigen::Index>(r)];
      for (const double x : motion) low = std::min(low, x), high = std::max(high, x);
      out.series.push_back(std::move(points));
    }
    plot::Series curve{"fitted", {}, {}};
    constexpr int steps = 100;
    for (int k = 0; k <= steps; ++k) {
      const double x = low + (high - low) * k / steps;
      curve.x.push_back(x);
      curve.y.push_back((solution.stiffness + solution.cubic * x * x) * x);
    }
    out.series.push_back(std::move(curve));
    return {out};
  }
};

}  // namespace

std::unique_ptr<const FitKind> restoring_fit() { return std::make_unique<RestoringFits>(); }

}  // namespace froude::scene
