/// \file  Fits of kind "radiation": added mass and damping from forced oscillations.
#include <array>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"
#include "fit/problem/radiation.hpp"

namespace froude::scene {
namespace {

/// Points with their intervals, and the curve of the poles.
plot::Panel panel_of(const ::fit::radiation::Solution& solution, bool damping, const char* unit, double confidence) {
  std::vector<double> omega;
  std::vector<const ::fit::Coefficient*> told;
  for (const auto& [source, point] : solution.points) {
    omega.push_back(point.omega);
    told.push_back(damping ? &point.damping : &point.added_mass);
  }
  plot::Panel panel{.x = {"frequency", "rad/s"},
                    .y = {damping ? "damping" : "added mass", unit},
                    .series = with_bars("measured", confidence, omega, told)};
  const auto& memory = solution.memory;
  if (!memory || !memory->refused.empty()) return panel;
  plot::Series curve{"poles", {}, {}, true, false, true};
  for (int k = 1; k <= 200; ++k) {
    const double at = 1.2 * omega.back() * k / 200;  // points are in the order of their frequencies
    const auto value = memory->poles.model.transform(at)(0, 0);
    curve.x.push_back(at);
    curve.y.push_back(damping ? value.real() : memory->poles.A_inf(0, 0) + value.imag() / at);
  }
  panel.series.push_back(curve);
  return panel;
}

class RadiationFits final : public FitKindOf<RadiationModel, ::fit::radiation::Problem> {
 public:
  RadiationFits()
      : FitKindOf({.word = "radiation",
                   .model = Binding<RadiationModel>(
                                "",
                                "added mass and damping from forced oscillations in still water, one file each, and "
                                "the poles of the memory that belongs to them")
                                .table("body", restored_body(), &RadiationModel::body),
                   .channels = {text("time", "time"), text("position", "the motion").optional(),
                                text("angle", "the motion, in place of a position").optional(),
                                text("force", "what moved the body, with a position").optional(),
                                text("torque", "what moved the body, with an angle").optional()}}) {}
  bool has_table() const override { return true; }

 private:
  void finish(const FitTables& t, const FitScene&, RadiationModel&) const override {
    const Record& channels = t.channels();
    if (channels.has("angle") == channels.has("position"))
      throw channels.refused("needs either position or angle for a fit of kind \"radiation\"",
                             "name the column of the motion");
    if (channels.has("position") != channels.has("force") || channels.has("angle") != channels.has("torque"))
      throw channels.refused("needs force beside a position, torque beside an angle", "name what moved the body");
    check_restored(t);
  }

  ::fit::radiation::Problem problem(const FitScene& scene, const RadiationModel& model) const override {
    ::fit::radiation::Problem out{
        .turns = scene.turns(), .runs = {}, .body = model.body, .options = {.confidence = scene.confidence}};
    out.force_slope = load_slope(scene);
    out.motion_slope = motion_slope(scene);
    for (const auto& [source, row] : runs_of(scene)) {
      const Measurements measured(scene, source.file);
      out.runs.push_back({source, measured.time(), measured.motion(), measured.load()});
    }
    return out;
  }

  std::string table(const ::fit::radiation::Problem& problem, const Solution& solution) const override {
    const auto unit = ::fit::radiation::units_of(problem.turns);
    std::string out = fmt::format(
        "file,omega [rad/s],amplitude [{0}],added_mass [{1}],added_mass_low [{1}],added_mass_high [{1}],damping "
        "[{2}],damping_low [{2}],damping_high [{2}]\n",
        unit.motion, unit.added_mass, unit.damping);
    for (const auto& [source, p] : solution.points)
      out += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", source.name(), p.omega,
                         p.amplitude, *p.added_mass.value, p.added_mass.interval.low, p.added_mass.interval.high,
                         *p.damping.value, p.damping.interval.low, p.damping.interval.high);
    return out;
  }

  Panels panels(const ::fit::radiation::Problem& problem, const Solution& solution) const override {
    const auto unit = ::fit::radiation::units_of(problem.turns);
    return {panel_of(solution, false, unit.added_mass, problem.options.confidence),
            panel_of(solution, true, unit.damping, problem.options.confidence)};
  }
};

}  // namespace

Binding<::fit::RestoredBody> restored_body() {
  using R = ::fit::RestoredBody;
  namespace dim = hydro::dim;
  return Binding<R>("[model.body]", "decay, radiation: what is known of the body, so that the water's part can be told")
      .optional(quantity("mass", dim::mass, "of the body, for a position").within(Limit::not_negative), &R::mass)
      .optional(
          quantity("inertia", dim::inertia, "of the body about its axis, for an angle").within(Limit::not_negative),
          &R::mass)
      .optional(
          quantity("stiffness", dim::stiffness, "of water and springs, for a position").within(Limit::not_negative),
          &R::stiffness)
      .optional(quantity("rotational_stiffness", dim::rotational_stiffness, "of water and springs, for an angle")
                    .within(Limit::not_negative),
                &R::stiffness)
      .optional(number("mass_error", "standard uncertainty of mass or inertia, relative").within(Limit::open_fraction),
                &R::mass_error)
      .optional(
          number("stiffness_error", "standard uncertainty of the stiffness, relative").within(Limit::open_fraction),
          &R::stiffness_error)
      .exactly_one_of({"mass", "inertia"})
      .exactly_one_of({"stiffness", "rotational_stiffness"});
}

void check_restored(const FitTables& t) {
  const Record& body = t.model().table("body");
  const bool turns = t.channels().has("angle");
  for (const char* other : turns ? std::array{"mass", "stiffness"} : std::array{"inertia", "rotational_stiffness"})
    if (body.has(other))
      throw body.wrong(other, fmt::format("does not go with the channel {}", turns ? "angle" : "position"),
                       turns ? "give inertia and rotational_stiffness" : "give mass and stiffness");
}

std::unique_ptr<const FitKind> radiation_fit() { return std::make_unique<RadiationFits>(); }

}  // namespace froude::scene
