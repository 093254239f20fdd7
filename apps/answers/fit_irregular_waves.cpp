/// \file  Fits of kind "irregular waves": transfer functions of several runs together.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "answers/fit_kind.hpp"
#include "answers/fit_waves.hpp"
#include "fit/problem/irregular_waves.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using IrregularProblem = ::fit::irregular_waves::Problem;
using ::fit::irregular_waves::Response;

struct IrregularWaveModel : ::fit::irregular_waves::Options {
  std::vector<std::string> responses;  ///< columns
};

Binding<IrregularWaveModel> irregular_wave_keys() {
  using M = IrregularWaveModel;
  return Binding<M>("",
                    "transfer functions from runs in irregular waves, one file each, by the segments of all of them")
      .optional(positive("segment", dim::time,
                         "length of a segment: longer ones resolve more, shorter ones scatter less; left out: so that "
                         "the shortest run holds eight side by side"),
                &M::segment_s)
      .table("tank", wave_tank(), static_cast<std::optional<::fit::WaveTank> M::*>(&M::tank));
}

/// The frequencies of waves as high as a hundredth of the highest density, and one more on each side.
std::pair<double, double> waves_between(const hydro::signal::SpectrumPerHz& waves) {
  const auto& s = waves.density;
  const double least = 0.01 * *std::max_element(s.begin() + 1, s.end());
  const auto high = [&](double density) { return density >= least; };
  const auto low = std::find_if(s.begin() + 1, s.end(), high) - s.begin() - 1,
             top = s.rend() - std::find_if(s.rbegin(), s.rend(), high);
  return {waves.frequency_hz[static_cast<std::size_t>(low)],
          waves.frequency_hz[std::min(static_cast<std::size_t>(top), s.size() - 1)]};
}

class IrregularWaveFits final : public FitKindOf<IrregularWaveModel, IrregularProblem> {
 public:
  IrregularWaveFits()
      : FitKindOf({.word = "irregular waves",
                   .model = irregular_wave_keys(),
                   .channels = {text("time", "time"), text("elevation", "the surface at the gauge"),
                                texts("response", "motions or forces, each a column with its unit")}}) {}
  bool has_table() const override { return true; }

 private:
  void finish(const FitTables& t, const FitScene& scene, IrregularWaveModel& model) const override {
    model.confidence = scene.confidence;
    model.responses = responses_of(t);
    only_prepares(t, steps_of_waves, "leave it out: it acts on forces and motions of a cylinder",
                  "which has no cycles");
  }

  IrregularProblem problem(const FitScene& scene, const IrregularWaveModel& model) const override {
    IrregularProblem out{.runs = {}, .units = {}, .options = model};
    read_wave_runs(scene, model.responses, out);
    return out;
  }

  /// Gains where channels may be unrelated are left empty.
  std::string table(const IrregularProblem& problem, const Solution& solution) const override {
    std::string out =
        "response,unit,frequency [Hz],wave_density [m^2/Hz],gain_h1,gain_h1_low,gain_h1_high,gain_h2,phase [deg],"
        "coherence\n";
    for (std::size_t i = 0; i < solution.responses.size(); ++i) {
      const Response& r = solution.responses[i];
      for (std::size_t k = 1; k < r.gain.size(); ++k) {
        out += fmt::format("{},{}/m,{:.6g},{:.6g}", r.name, problem.units[i], r.transfer.frequency_hz[k],
                           solution.waves.density[k]);
        out += r.gain[k].value
                   ? fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g},{:.4f}", *r.gain[k].value, r.gain[k].interval.low,
                                 r.gain[k].interval.high, std::abs(r.transfer.h2[k]),
                                 std::arg(r.transfer.h1[k]) * 180 / std::numbers::pi)
                   : std::string(",,,,,");
        out += fmt::format(",{:.6g}\n", r.transfer.coherence[k]);
      }
    }
    return out;
  }

  Panels panels(const IrregularProblem& problem, const Solution& solution) const override {
    const plot::Axis x{.label = "frequency", .unit = "Hz", .range = waves_between(solution.waves)};
    const auto& f = solution.waves.frequency_hz;
    Panels out{{.x = x, .y = {"waves", "m^2/Hz"}, .series = {{"", f, solution.waves.density}}}};
    plot::Panel coherence{.x = x, .y = {.label = "coherence", .range = std::pair{0.0, 1.0}}, .series = {}};
    for (std::size_t i = 0; i < solution.responses.size(); ++i) {
      const Response& r = solution.responses[i];
      auto [gain, phase] = panels_of_response(r, problem.units[i], problem.options.confidence, x);
      out.push_back(std::move(gain));
      out.push_back(std::move(phase));
      coherence.series.push_back({r.name, f, r.transfer.coherence});
    }
    coherence.series.push_back(
        {"unrelated channels stay below",
         {f.front(), f.back()},
         {solution.responses[0].transfer.coherence_threshold, solution.responses[0].transfer.coherence_threshold},
         true,
         false,
         true});
    out.push_back(std::move(coherence));
    return out;
  }

  /// Where the channels are coherent.
  static std::pair<plot::Panel, plot::Panel> panels_of_response(const Response& r, const std::string& unit,
                                                                double confidence, const plot::Axis& x) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    plot::Series h1{"H1", r.transfer.frequency_hz, {}}, h2{"H2", h1.x, {}, true, false, true}, phase{"", h1.x, {}};
    plot::Band band{fmt::format("{:g} %", 100 * confidence), {}, {}, {}};
    for (std::size_t k = 0; k < r.gain.size(); ++k) {
      const bool told = r.gain[k].value && h1.x[k] >= x.range->first && h1.x[k] <= x.range->second;
      h1.y.push_back(told ? *r.gain[k].value : none);
      h2.y.push_back(told ? std::abs(r.transfer.h2[k]) : none);
      phase.y.push_back(told ? std::arg(r.transfer.h1[k]) * 180 / std::numbers::pi : none);
      if (!told) continue;
      band.x.push_back(h1.x[k]);
      band.low.push_back(r.gain[k].interval.low);
      band.high.push_back(r.gain[k].interval.high);
    }
    return {{.x = x,
             .y = {r.name + " gain", unit + "/m"},
             .series = {std::move(h1), std::move(h2)},
             .bands = {std::move(band)}},
            {.x = x, .y = {r.name + " phase", "deg"}, .series = {std::move(phase)}}};
  }
};

}  // namespace

std::unique_ptr<const FitKind> irregular_waves_fit() { return std::make_unique<IrregularWaveFits>(); }

}  // namespace froude::scene
