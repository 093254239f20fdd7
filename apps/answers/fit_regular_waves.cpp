/// \file  Fits of kind "regular waves": response and force amplitudes of runs in a tank.
#include <algorithm>
#include <limits>
#include <numbers>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_waves.hpp"
#include "fit/problem/regular_waves.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using ::fit::WaveTank;
using WaveProblem = ::fit::regular_waves::Problem;

/// Response amplitudes from runs in regular waves.
struct RegularWaveModel : ::fit::regular_waves::Options {
  std::vector<std::string> responses;  ///< columns
};

Binding<WaveTank> tank_with_end() {
  return wave_tank().optional(
      positive("end", dim::length,
               "of the beach or wall from the wavemaker: the window ends where waves come back from it"),
      &WaveTank::end);
}

Binding<RegularWaveModel> regular_wave_keys() {
  using M = RegularWaveModel;
  return Binding<M>("", "response amplitudes, force amplitudes and harmonics from runs in regular waves, one file each")
      .table("tank", tank_with_end(), static_cast<WaveTank M::*>(&M::tank))
      .needed()
      .optional(quantity("started", dim::time, "when the wavemaker starts, on the clock of the records; left out: 0 s"),
                &M::started)
      .optional(quantity("ramp", dim::time, "until it moves fully; left out: 0 s").within(Limit::not_negative),
                &M::ramp)
      .key(number("settle", "periods given to the body's own motion to die out")
               .within(Limit::not_negative)
               .or_default("5", "a motion damped by 10 % of critical keeps 4 % of its start"),
           &M::settle_periods)
      .key(integer("harmonics", "that are fitted, 1 to 20").or_default("3", "forces of second order, and drag"),
           [](const Value& v, M& out) {
             if (v.integer < 1 || v.integer > 20) throw v.wrong("must lie between 1 and 20");
             out.harmonics = static_cast<int>(v.integer);
           })
      .key(number("band_low", "lower edge of the band before peaks are taken, times the frequency of the waves")
               .within(Limit::open_fraction)
               .or_default("0.5", "slow drift is below it"),
           &M::band_low)
      .key(number("band_high", "upper edge of that band").positive().or_default("3.5", "holds three harmonics"),
           [](const Value& v, M& out) {
             if (!(v.number > 1)) throw v.wrong("must be larger than 1: the band holds the waves' own frequency");
             out.band_high = v.number;
           });
}

class RegularWaveFits final : public FitKindOf<RegularWaveModel, WaveProblem> {
 public:
  RegularWaveFits()
      : FitKindOf({.word = "regular waves",
                   .model = regular_wave_keys(),
                   .channels = {text("time", "time"), text("elevation", "the surface at the gauge"),
                                texts("response", "motions or forces, each a column with its unit")}}) {}
  bool has_table() const override { return true; }

 private:
  bool finds_the_waves() const override { return true; }

  void finish(const FitTables& t, const FitScene& scene, RegularWaveModel& model) const override {
    model.confidence = scene.confidence;
    if (model.tank.body >= model.tank.end || model.tank.gauge >= model.tank.end)
      throw t.model().table("tank").wrong("end", "lies before the gauge or the body",
                                          "give its distance from the wavemaker");
    model.responses = responses_of(t);
    only_prepares(t, steps_of_waves, "leave it out: it acts on forces and motions of a cylinder",
                  "for the window is whole periods in any case");
  }

  WaveProblem problem(const FitScene& scene, const RegularWaveModel& model) const override {
    WaveProblem out{.runs = {}, .units = {}, .options = model};
    read_wave_runs(scene, model.responses, out);
    return out;
  }

  std::string table(const WaveProblem& problem, const Solution& solution) const override {
    std::string out =
        "file,period [s],wave_amplitude [m],cycles,response,unit,amplitude,rao,rao_low,rao_high,rao_by_peaks,"
        "phase [deg],second,third\n";
    for (std::size_t i = 0; i < solution.runs.size(); ++i) {
      const auto& fit = solution.runs[i].fit;
      for (std::size_t c = 0; c < fit.responses.size(); ++c) {
        const auto& r = fit.responses[c];
        const auto harmonic = [&](std::size_t k) {
          return r.motion.harmonics.size() > k ? fmt::format("{:.6g}", std::abs(r.motion.harmonics[k])) : std::string();
        };
        out += fmt::format(
            "{},{:.6g},{:.6g},{},{},{},{},{},{:.6g},{:.6g},{},{:.4f},{},{}\n", problem.runs[i].source.name(),
            2 * std::numbers::pi / fit.omega, std::abs(fit.wave.harmonics[0]), fit.cycles, r.name, problem.units[c],
            harmonic(0), r.rao.value ? fmt::format("{:.6g}", *r.rao.value) : "", r.rao.interval.low,
            r.rao.interval.high, std::isfinite(r.rao_by_peaks) ? fmt::format("{:.6g}", r.rao_by_peaks) : "",
            r.phase * 180 / std::numbers::pi, harmonic(1), harmonic(2));
      }
    }
    return out;
  }

  /// Of one run its records with what was fitted, of several the response amplitudes over the period.
  Panels panels(const WaveProblem& problem, const Solution& solution) const override {
    if (solution.runs.size() == 1) return records_of(problem, solution.runs[0]);
    std::vector<double> periods;
    for (const auto& run : solution.runs) periods.push_back(2 * std::numbers::pi / run.fit.omega);
    const auto [low, high] = std::minmax_element(periods.begin(), periods.end());
    const double beside = std::max(0.05 * (*high - *low), 0.01 * *high);
    const plot::Axis x{.label = "period", .unit = "s", .range = std::pair{*low - beside, *high + beside}};
    Panels out;
    for (std::size_t c = 0; c < problem.units.size(); ++c) {
      plot::Series values{"by harmonics", periods, {}, false, true}, bars{"", {}, {}},
          peaks{"by peaks", periods, {}, false, true}, phases{"phase before the wave", periods, {}, false, true};
      bars.name = fmt::format("{:g} % interval", 100 * problem.options.confidence);
      for (std::size_t i = 0; i < periods.size(); ++i) {
        const auto& r = solution.runs[i].fit.responses[c];
        const auto& [from, to] = r.rao.interval;
        peaks.y.push_back(r.rao_by_peaks);
        values.y.push_back((from + to) / 2);
        phases.y.push_back(r.phase * 180 / std::numbers::pi);
        for (const double end : {from, to, std::numeric_limits<double>::quiet_NaN()}) {
          bars.x.push_back(periods[i]);
          bars.y.push_back(end);
        }
      }
      const std::string& name = problem.runs[0].responses[c].name;
      out.push_back({.x = x,
                     .y = {name + " RAO", problem.units[c] + "/m"},
                     .series = {std::move(peaks), std::move(values), std::move(bars)}});
      out.push_back({.x = x, .y = {name + " phase", "deg"}, .series = {std::move(phases)}});
    }
    return out;
  }

  static Panels records_of(const WaveProblem& problem, const ::fit::regular_waves::FittedRun& run) {
    Panels out;
    const auto add = [&](const std::string& name, const std::string& unit, const std::vector<double>& values,
                         const ::fit::Oscillation& o) {
      const std::vector<double> window(run.time.begin() + static_cast<std::ptrdiff_t>(run.fit.from),
                                       run.time.begin() + static_cast<std::ptrdiff_t>(run.fit.to));
      out.push_back(
          {.x = {"time", "s"},
           .y = {name, unit},
           .series = {thinned("measured", run.time, values), {"fitted", window, o.fitted, true, false, true}}});
    };
    add("elevation", "m", run.elevation, run.fit.wave);
    for (std::size_t c = 0; c < run.responses.size(); ++c)
      add(run.fit.responses[c].name, problem.units[c], run.responses[c], run.fit.responses[c].motion);
    return out;
  }
};

}  // namespace

Binding<::fit::WaveTank> wave_tank() {
  using T = ::fit::WaveTank;
  return Binding<T>("[model.tank]", "where waves are made, measured and sent back")
      .key(quantity("depth", dim::length, "of the water").one_of({"infinite"}).positive(), &T::water,
           &hydro::Water::depth)
      .key(quantity("gauge", dim::length, "of the gauge from the wavemaker").within(Limit::not_negative), &T::gauge)
      .key(quantity("body", dim::length, "of the body from the wavemaker").within(Limit::not_negative), &T::body)
      .key(positive("gravity", dim::acceleration, "acceleration of free fall")
               .or_default("9.81 m/s^2", "what hydrodynamic data are mostly computed with"),
           &T::water, &hydro::Water::gravity);
}

std::vector<std::string> responses_of(const FitTables& t) {
  std::vector<std::string> out;
  for (const auto& one : t.channels()["response"].texts) {
    if (std::find(out.begin(), out.end(), one.value) != out.end())
      throw t.channels().wrong("response", fmt::format("holds \"{}\" twice", one.value));
    out.push_back(one.value);
  }
  if (out.empty()) throw t.channels().wrong("response", "is empty", "write the name of a column");
  return out;
}

std::unique_ptr<const FitKind> regular_waves_fit() { return std::make_unique<RegularWaveFits>(); }

}  // namespace froude::scene
