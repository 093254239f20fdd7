/// \file  Fits of kind "towing": drag of a cylinder at steady speed.
#include <algorithm>
#include <limits>
#include <optional>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

std::vector<Key> towing_channels() {
  return {text("time", "time of a record; left out: each row is the mean of a run").optional(),
          text("speed", "speed of the carriage"),
          texts("force",
                "measured force, positive where it resists a positive speed; of a record several columns are added up, "
                "and \"-F2\" is F2 turned round"),
          text("speed_sd", "standard deviation of the speed, of means").optional(),
          text("force_sd", "standard deviation of the force, of means").optional()};
}

Binding<TowingModel> towing_keys() {
  using M = TowingModel;
  return Binding<M>("", "drag at steady speed, from means of runs or, with the channel time, from their records")
      .part(cylinder_keys(), &M::cylinder)
      .optional(number("tolerance",
                       "of records: means over a 500th of the record that stay so close to their median, relative, are "
                       "one speed; left out: 0.02, which is 4 % of the force")
                    .within(Limit::open_fraction),
                &M::tolerance)
      .key(effect("zero_at_rest", "of records: the force before the carriage starts is taken off"), &M::zero_at_rest)
      .table("uncertainty", cylinder_errors(), static_cast<::fit::CylinderErrors M::*>(&M::errors))
      .optional();
}

class TowingFits final : public FitKindOf<TowingModel, ::fit::towing::Problem> {
 public:
  TowingFits()
      : FitKindOf(
            {.word = "towing",
             .model = towing_keys(),
             .channels = towing_channels(),
             .data =
                 Binding<TowingModel>("", "").optional(calibration_key()).optional(zero_key(), &TowingModel::zero_run),
             .ask = Binding<TowingModel>("", "")
                        .optional(texts("coefficients", "drag cd, all that it tells").one_of({"cd"}))
                        .key(accept_key("\"residuals\" larger than the stated deviations allow do not keep the "
                                        "value back; its interval is then as wide as they make it"),
                             &TowingModel::accept_residuals)}) {}
  bool has_table() const override { return true; }

 private:
  void finish(const FitTables& t, const FitScene& scene, TowingModel& towing) const override {
    towing.confidence = scene.confidence;
    check_errors(t.model(), towing.cylinder, towing.errors);
    for (const auto& c : wanted(t, {"cd", "cm", "ca"}, "[\"cd\"]", "ask for cd, cm or ca"))
      if (c.value != "cd")
        throw hydro::InputError(
            fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value), c.place,
            "ask for \"cd\" alone");
    towing.recorded = t.channels().has("time");
    if (towing.recorded)
      check_of_records(t, towing);
    else
      check_of_means(t);
  }

  static void check_of_records(const FitTables& t, const TowingModel& towing) {
    for (const char* role : {"speed_sd", "force_sd"})
      if (t.channels().has(role))
        throw t.channels().wrong(role, "does not act beside the time: a record tells its deviation itself",
                                 "leave it out");
    if (t.ask().has("accept"))
      throw t.ask().wrong("accept", "does not act on records: runs may differ, and by how much is told",
                          "leave it out");
    if (towing.zero_at_rest && t.data().has("zero"))
      throw t.model().wrong("zero_at_rest", "does not act beside a run at rest, [data] zero", "keep one of the two");
    only_prepares(t, {"longest_gap", "outliers", "resample", "low_pass", "notch", "moving_average", "window"},
                  "leave it out: a steady part has neither a period nor a delay", "which has no cycles");
  }

  /// What only records have.
  static void check_of_means(const FitTables& t) {
    const std::string why = "acts on records over time, and there is no channel time",
                      remedy = "leave it out, or name the column of the time";
    if (t.root.has("prepare")) throw prepares_nothing(t);
    for (const char* key : {"calibration", "zero"})
      if (t.data().has(key)) throw t.data().wrong(key, why, remedy);
    for (const char* key : {"tolerance", "zero_at_rest", "uncertainty"})
      if (t.model().has(key)) throw t.model().wrong(key, why, remedy);
    if (t.channels()["force"].texts.size() > 1)
      throw t.channels().wrong("force", "may hold one column only where each row is the mean of a run");
  }

  ::fit::towing::Problem problem(const FitScene& scene, const TowingModel& model) const override {
    ::fit::towing::Problem out{model.cylinder, {}, {}, model};
    out.options.speed_slope = slope_error_of(scene, {"speed"});
    if (!model.recorded) out.options.force_slope = load_slope(scene);
    for (const auto& file : scene.files) {
      const Measurements measured(scene, file.value);
      if (model.recorded)
        out.records.push_back(
            {{file.value},
             {measured.time(), measured.of_role("speed", dim::velocity), measured.force_channels(model.zero_run)}});
      else
        add_means(measured, out);
    }
    return out;
  }

  static void add_means(const Measurements& measured, ::fit::towing::Problem& out) {
    const auto column = [&](const char* role, const hydro::Dimension& dimension) {
      const std::vector<double> values = measured.of_role(role, dimension);
      return values.empty() ? std::vector<double>(measured.table.rows()) : values;  // a deviation that is not known
    };
    const auto speed = column("speed", dim::velocity), speed_sd = column("speed_sd", dim::velocity);
    const auto force = measured.load(), force_sd = column("force_sd", dim::force);
    for (std::size_t i = 0; i < force.size(); ++i) {
      out.runs.push_back({speed[i], speed_sd[i], force[i], force_sd[i]});
      check_mean(measured, i, out.runs.back(), out.runs.front());
    }
  }

  /// \throws hydro::InputError at the cell that is wrong
  static void check_mean(const Measurements& measured, std::size_t row, const ::fit::TowingRun& run,
                         const ::fit::TowingRun& first) {
    const auto at = [&](const char* role, const auto& check) {
      const auto cell = [&] {
        const auto column = measured.scene.channels.find(role);
        const bool named = column != measured.scene.channels.end();
        return measured.table.place_of(named ? column->second : measured.scene.force[0].column, row);
      };
      placed(cell, check);
    };
    at("speed", [&] { ::fit::require_towing_speed(run.speed); });
    at("force", [&] { ::fit::require_resistance(run.force, run.speed); });
    at("speed_sd", [&] { ::fit::require_deviation("speed", run.speed_deviation, run.speed); });
    at("force_sd", [&] { ::fit::require_deviation("force", run.force_deviation, run.force); });
    at("force_sd", [&] { ::fit::require_stated_alike(run, first); });
  }

  Remedy remedy(const FitScene& scene, const ::fit::towing::Problem&, const Solution&) const override {
    return {
        scene.model_place,
        "cd may depend on speed: fit fewer runs, or state the deviations that they have; to have their mean all the "
        "same: [ask] accept = [\"residuals\"]"};
  }

  Panels panels(const ::fit::towing::Problem& problem, const Solution& solution) const override {
    if (!problem.records.empty()) return panels_of_records(problem, solution);
    if (solution.report.refused) return {};
    const auto& fit = solution.fit;
    plot::Series points{"runs", {}, {}, false, true};
    for (std::size_t i = 0; i < problem.runs.size(); ++i) {
      points.x.push_back(problem.runs[i].speed);
      points.y.push_back(fit.points[i].cd);
    }
    Panels out{over_speed({points}, *fit.cd.value, fit.cd.interval, fit.confidence)};
    std::vector<std::optional<double>> re;
    for (const auto& point : fit.points) re.push_back(point.re);
    add_over_reynolds(points, re, out);
    return out;
  }

  /// The same runs over their Reynolds number, as other experiments are told, where the viscosity is known.
  static void add_over_reynolds(plot::Series runs, const std::vector<std::optional<double>>& re, Panels& out) {
    if (std::any_of(re.begin(), re.end(), [](const auto& known) { return !known; })) return;
    for (std::size_t i = 0; i < re.size(); ++i) runs.x[i] = *re[i];
    out.push_back({.x = {.label = "Re", .unit = {}, .scale = plot::Scale::logarithmic},
                   .y = {"C_D"},
                   .series = {std::move(runs)}});
  }

  /// C_D of runs with that of all together.
  static plot::Panel over_speed(std::vector<plot::Series> runs, double mean, const ::fit::Interval& interval,
                                double confidence) {
    const auto [low, high] = std::minmax_element(runs[0].x.begin(), runs[0].x.end());
    const double beside = 0.05 * (*high - *low);
    const std::vector<double> ends{*low - beside, *high + beside};
    runs.push_back({"together", ends, {mean, mean}});
    return {.x = {"speed", "m/s"},
            .y = {"C_D"},
            .series = std::move(runs),
            .bands = {{fmt::format("{:g} %", 100 * confidence),
                       ends,
                       {interval.low, interval.low},
                       {interval.high, interval.high}}}};
  }

  /// C_D of single samples of each run over its speed: a box from quartile to quartile with the median across it,
  /// whiskers, and outliers as marks. Boxes have the width of a third of the least distance of two speeds.
  static plot::Panel boxes(const std::vector<::fit::towing::RecordedTow>& records) {
    std::vector<double> speeds;
    for (const auto& r : records) speeds.push_back(r.speed.value);
    std::sort(speeds.begin(), speeds.end());
    double least = speeds.back() - speeds.front();
    for (std::size_t i = 1; i < speeds.size(); ++i)
      if (speeds[i] - speeds[i - 1] > 0.01 * speeds[i]) least = std::min(least, speeds[i] - speeds[i - 1]);
    const double half = least / 6, none = std::numeric_limits<double>::quiet_NaN();
    plot::Series box{.name = "quartiles, whiskers", .x = {}, .y = {}}, median{.name = "median", .x = {}, .y = {}},
        outliers{.name = "outliers", .x = {}, .y = {}, .line = false, .marks = true};
    for (const auto& r : records) {
      const double u = r.speed.value, a = u - half, b = u + half;
      const ::fit::Box& of = r.box;
      for (const auto& [x, y] : {std::pair{a, of.lower_quartile},
                                 {b, of.lower_quartile},
                                 {b, of.upper_quartile},
                                 {a, of.upper_quartile},
                                 {a, of.lower_quartile},
                                 {none, none},
                                 {u, of.lower_quartile},
                                 {u, of.low},
                                 {none, none},
                                 {u, of.upper_quartile},
                                 {u, of.high},
                                 {none, none}})
        box.x.push_back(x), box.y.push_back(y);
      for (const auto& [x, y] : {std::pair{a, of.median}, {b, of.median}, {none, none}})
        median.x.push_back(x), median.y.push_back(y);
      for (const double value : of.outliers) outliers.x.push_back(u), outliers.y.push_back(value);
    }
    return {.x = {"speed", "m/s"},
            .y = {"C_D of single samples"},
            .series = {std::move(box), std::move(median), std::move(outliers)}};
  }

  /// Speed and force of each record, thin enough to draw, with the steady parts dashed over them, and C_D of all runs.
  static Panels panels_of_records(const ::fit::towing::Problem& problem, const Solution& solution) {
    plot::Panel speed{.x = {"time", "s"}, .y = {"speed", "m/s"}, .series = {}},
        force{.x = {"time", "s"}, .y = {"force", "N"}, .series = {}};
    std::vector<double> speeds;
    std::vector<const ::fit::Coefficient*> cds;
    plot::Series steady_speed{"steady part", {}, {}, true, false, true}, steady_force = steady_speed;
    for (std::size_t i = 0; i < solution.records.size(); ++i) {
      const auto& r = solution.records[i];
      const auto& p = r.prepared;
      const std::string name = problem.records[i].source.name();
      speed.series.push_back(thinned(name, p.time, p.speed));
      force.series.push_back(thinned(name, p.time, p.force));
      for (const double end :
           {p.time[r.steady.from], p.time[r.steady.to - 1], std::numeric_limits<double>::quiet_NaN()})
        for (auto [line, level] : {std::pair{&steady_speed, r.speed.value}, {&steady_force, r.force.value}}) {
          line->x.push_back(end);
          line->y.push_back(level);
        }
      speeds.push_back(r.speed.value);
      cds.push_back(&r.cd);
    }
    speed.series.push_back(std::move(steady_speed));
    force.series.push_back(std::move(steady_force));
    Panels out{std::move(speed), std::move(force)};
    if (solution.records.size() == 1) return out;
    out.push_back(boxes(solution.records));
    auto runs = with_bars("runs", problem.options.confidence, speeds, cds);
    const plot::Series points = runs.front();
    std::vector<std::optional<double>> re;
    for (const auto& r : solution.records) re.push_back(r.re);
    if (const auto& law = solution.law)
      out.push_back(over_speed(std::move(runs), law->coefficients[0], law->intervals[0], problem.options.confidence));
    else
      out.push_back({.x = {"speed", "m/s"}, .y = {"C_D"}, .series = std::move(runs)});
    add_over_reynolds(points, re, out);
    return out;
  }

  std::string table(const ::fit::towing::Problem& problem, const Solution& solution) const override {
    if (problem.records.empty()) return table_of_means(problem, solution);
    std::string out =
        "file,from [s],to [s],re,speed [m/s],speed_deviation [m/s],speed_cov,force [N],force_deviation "
        "[N],force_cov,cd,"
        "cd_deviation,cd_cov,cd_lower_quartile,cd_median,cd_upper_quartile,cd_standard_error,cd_low,cd_high\n";
    for (std::size_t i = 0; i < solution.records.size(); ++i) {
      const auto& r = solution.records[i];
      const auto& time = r.prepared.time;
      out += fmt::format("{},{:.6g},{:.6g},{}", problem.records[i].source.name(), time[r.steady.from],
                         time[r.steady.to - 1], r.re ? fmt::format("{:.6g}", *r.re) : "");
      for (const ::fit::SteadyMean* m : {&r.speed, &r.force})
        out += fmt::format(",{:.6g},{:.6g},{:.6g}", m->value, m->deviation, m->coefficient_of_variation());
      out +=
          fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", *r.cd.value, r.samples.deviation,
                      r.samples.coefficient_of_variation(), r.box.lower_quartile, r.box.median, r.box.upper_quartile);
      out += fmt::format(",{:.6g},{:.6g},{:.6g}\n", r.cd.standard_error, r.cd.interval.low, r.cd.interval.high);
    }
    return out;
  }

  static std::string table_of_means(const ::fit::towing::Problem& problem, const Solution& solution) {
    std::string out = "re,speed [m/s],force [N],cd,cd_standard_error\n";
    for (std::size_t i = 0; i < problem.runs.size(); ++i) {
      const auto& [cd, deviation, re] = solution.fit.points[i];
      out += fmt::format("{},{:.6g},{:.6g},{:.6g},{}\n", re ? fmt::format("{:.6g}", *re) : "", problem.runs[i].speed,
                         problem.runs[i].force, cd, deviation > 0 ? fmt::format("{:.6g}", deviation) : "");
    }
    return out;
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

Binding<::fit::CylinderErrors> cylinder_errors() {
  using ::fit::CylinderErrors;
  return Binding<CylinderErrors>("[model.uncertainty]", "standard uncertainties of what the cylinder is taken for")
      .optional(positive("diameter", dim::length, "of the diameter"), &CylinderErrors::diameter)
      .optional(positive("length", dim::length, "of the length"), &CylinderErrors::length)
      .optional(positive("density", dim::density, "of the water's density"), &CylinderErrors::density);
}

std::optional<TooUncertain> too_uncertain(const ::fit::Cylinder& c, const ::fit::CylinderErrors& e) {
  for (const TooUncertain& one :
       {TooUncertain{"diameter", "diameter", e.diameter, c.diameter},
        TooUncertain{"length", "length", e.length, c.length}, TooUncertain{"density", "density", e.density, c.density},
        TooUncertain{"mass", "mass_beyond_load_cells", e.mass, c.mass_beyond_load_cells}})
    if (one.error > 0 && one.size > 0 && one.error >= one.size) return one;
  return std::nullopt;
}

void check_errors(const Record& model, const ::fit::Cylinder& cylinder, const ::fit::CylinderErrors& errors) {
  if (const auto found = too_uncertain(cylinder, errors))
    throw model.table("uncertainty")
        .wrong(found->name, fmt::format("is no smaller than what it is the error of, {:g} in SI", found->size),
               "write one standard deviation with its unit: a diameter of 0.12 m may be known to \"0.5 mm\"");
}

std::unique_ptr<const FitKind> towing_fit() { return std::make_unique<TowingFits>(); }

}  // namespace froude::scene
