#include "froude/psd/report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "froude/density_unit.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/resolution.hpp"

namespace froude::spectra {
namespace {

/// A number of what may be absent.
template <class Whole, class Number>
std::optional<double> number_of(const std::optional<Whole>& whole, Number number) {
  if (!whole) return std::nullopt;
  return std::invoke(number, *whole);
}

Fact<std::string> fact_or_dash(const char* key, const std::optional<double>& value, bool dash = false) {
  return fact(key, value, value && !dash ? fmt::format("{:.4g}", *value) : std::string("-"));
}

/// The response to the input over frequency, for programs alone.
Report transfer_of(const hs::TransferEstimate& transfer, const std::string& input) {
  std::vector<double> gain, phase;
  for (const auto& h : transfer.h1) {
    gain.push_back(std::abs(h));
    phase.push_back(std::arg(h));
  }
  Report out;
  std::vector<double> total;
  for (std::size_t k = 0; k < gain.size(); ++k) total.push_back(hs::total_gain(transfer, k));
  out.keep("input", input)
      .keep("gain", gain)
      .keep("gain_hv", total)
      .keep("phase_rad", phase)
      .keep("coherence", transfer.coherence);
  out.keep("gain_relative_error", transfer.gain_relative_error);
  return out.keep("coherence_threshold", transfer.coherence_threshold);
}

Report report_of(const Estimate& e, const std::string& input) {
  using hs::Moments, hs::WaveStatistics;
  Report out;
  out.say("{:<24} {:<8} {:>10.4g} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6}", e.signal.name,
          fact("unit", e.signal.units, e.signal.units.empty() ? "-" : e.signal.units), fact("mean", e.welch.mean),
          fact_or_dash("hs", number_of(e.moments, &Moments::hs)),
          fact_or_dash("tp_s", number_of(e.peak, &hs::Peak::period_s), e.peak && e.peak->at_edge),
          fact_or_dash("te_s", number_of(e.moments, &Moments::te)),
          fact_or_dash("tm02_s", number_of(e.moments, &Moments::tm02)),
          fact_or_dash("tz_s", number_of(e.statistics, &WaveStatistics::mean_period)),
          fact_or_dash("h13", number_of(e.statistics, &WaveStatistics::h13)), fact("waves", e.waves));
  out.keep("variance", e.welch.variance).keep("density_per_hz", e.welch.spectrum.density);
  if (e.moments) {
    out.keep("moments", std::vector{e.moments->m_minus1, e.moments->m0, e.moments->m1, e.moments->m2, e.moments->m4});
    out.keep("tm01_s", e.moments->tm01()).keep("epsilon", e.moments->epsilon()).keep("nu", e.moments->nu());
    out.keep("peak_at_edge", e.peak->at_edge);
  }
  if (!e.drift.empty()) out.keep("drift", e.drift);
  if (e.statistics) out.keep("h_max", e.statistics->highest).keep("t13_s", e.statistics->t13);
  if (e.transfer) out.part("transfer", transfer_of(*e.transfer, input));
  return out;
}

/// Where gaps let much of a density come from other frequencies; empty where they do not.
std::string leakage_of(const Estimate& e) {
  constexpr double much = 0.2;  // half of the width of a band of some sixty degrees of freedom
  const auto is_much = [&](double share) { return share > much; };
  const auto count = std::count_if(e.leaked.begin(), e.leaked.end(), is_much);
  if (count == 0) return "";
  const auto first = std::find_if(e.leaked.begin(), e.leaked.end(), is_much) - e.leaked.begin();
  return fmt::format(
      "gaps let other frequencies leak into the density of {}: more than a fifth of it at {} of {} frequencies, the "
      "first of them {:.4g} Hz, and up to {:.0f} %; densities there are as much too high, and bands do not hold them: "
      "take the longest part without a gap (--from, --to)",
      e.signal.name, count, e.leaked.size(), e.welch.spectrum.frequency_hz[static_cast<std::size_t>(first)],
      100 * *std::max_element(e.leaked.begin(), e.leaked.end()));
}

std::vector<std::string> notes_of(const Estimate& e, bool uneven) {
  std::vector<std::string> out;
  if (!e.moments) out.push_back(e.signal.name + " never changes");
  if (e.moments && e.peak->at_edge)
    out.push_back(fmt::format(
        "{} is strongest at an end of its spectrum, {:.4g} Hz: no peak, or one that needs longer segments (--segment)",
        e.signal.name, e.peak->frequency_hz));
  constexpr double much = 1.05;  // of the variance: 2.5 % of a height
  if (uneven && e.moments && e.moments->m0 > much * e.welch.variance)
    out.push_back(fmt::format(
        "the spectrum of {} holds {:.3g} times its variance: what is missing aliases, and raises densities, "
        "heights and the higher moments",
        e.signal.name, e.moments->m0 / e.welch.variance));
  if (std::string leaked = leakage_of(e); !leaked.empty()) out.push_back(std::move(leaked));
  if (!e.drift.empty()) out.push_back(e.signal.name + " " + e.drift);
  if (e.moments && !e.statistics)
    out.push_back(fmt::format("{} has {} complete waves: too few for H1/3", e.signal.name, e.waves));
  return out;
}

/// Half of the band of H1 at this confidence, over H1. Of n_d complex pairs one complex coefficient is taken: Student's
/// t with 2(n_d − 1) degrees of freedom. (S9)
double half_band(const hs::TransferEstimate& transfer, std::size_t k, double confidence) {
  return hs::student_t_quantile((1 + confidence) / 2, 2 * (transfer.averages - 1)) * transfer.gain_relative_error[k];
}

/// Half of the bands of |H1|; NaN where the two may be unrelated.
std::vector<double> told_half_bands(const Estimate& e, double confidence) {
  std::vector<double> out;
  for (std::size_t k = 0; k < e.transfer->h1.size(); ++k)
    out.push_back(e.transfer->coherence[k] < e.transfer->coherence_threshold
                      ? std::numeric_limits<double>::quiet_NaN()
                      : half_band(*e.transfer, k, confidence) * std::abs(e.transfer->h1[k]));
  return out;
}

/// Where the input is strongest, the response is known best: one line for each output.
void add_response(const Analysis& a, Report& report) {
  const auto input =
      std::find_if(a.estimates.begin(), a.estimates.end(), [&](const Estimate& e) { return e.signal.name == a.input; });
  if (a.input.empty() || input == a.estimates.end()) return;
  const auto& density = input->welch.spectrum.density;
  const auto k = static_cast<std::size_t>(std::max_element(density.begin() + 1, density.end()) - density.begin());
  report.say("response to {} at its peak, {:.4g} Hz:", a.input, input->welch.spectrum.frequency_hz[k]);
  for (const Estimate& e : a.estimates) {
    if (!e.transfer) continue;
    const hs::TransferEstimate& t = *e.transfer;
    const std::string by_chance = fmt::format("unrelated signals stay below {:.2f} at {:g} % of the frequencies",
                                              t.coherence_threshold, 100 * a.confidence);
    const std::string unit = gain_unit(e.signal.units, input->signal.units);
    if (t.coherence[k] < t.coherence_threshold)
      report.say("{:<24} may have nothing to do with it: coherence {:.3f} ({}), so no gain is told", e.signal.name,
                 t.coherence[k], by_chance);
    else
      report.say(
          "{:<24} |H1| {:.4g} +- {:.2g}{} ({:g} %), |H2| {:.4g}, |Hv| {:.4g}, phase {:.1f} deg, coherence {:.3f} ({})",
          e.signal.name, std::abs(t.h1[k]), half_band(t, k, a.confidence) * std::abs(t.h1[k]),
          unit.empty() ? "" : " " + unit, 100 * a.confidence, std::abs(t.h2[k]), hs::total_gain(t, k),
          std::arg(t.h1[k]) / degree, t.coherence[k], by_chance);
  }
}

/// One column of results along frequency, SI: densities here are per hertz, and a file's unit says so.
struct Column {
  std::string name, unit;
  std::vector<double> values;
};

std::vector<Column> columns_of(const Analysis& a) {
  std::vector<Column> out{{"frequency", "Hz", a.estimates.front().welch.spectrum.frequency_hz}};
  std::string input_unit;
  for (const Estimate& e : a.estimates)
    if (e.signal.name == a.input) input_unit = e.signal.units;
  for (const Estimate& e : a.estimates) {
    Column density{e.signal.name + ".density", density_unit(e.signal.units), e.welch.spectrum.density}, low = density,
                                                                                                        high = density;
    low.name += "_low";
    high.name += "_high";
    for (double& v : low.values) v *= a.band.lower;
    for (double& v : high.values) v *= a.band.upper;
    out.insert(out.end(), {density, low, high});
    if (!e.transfer) continue;
    const std::string unit = gain_unit(e.signal.units, input_unit);
    Column h1{e.signal.name + ".gain_h1", unit, {}}, h2{e.signal.name + ".gain_h2", unit, {}},
        phase{e.signal.name + ".phase", "deg", {}};
    for (const auto& h : e.transfer->h1) h1.values.push_back(std::abs(h));
    for (const auto& h : e.transfer->h2) h2.values.push_back(std::abs(h));
    for (const auto& h : e.transfer->h1) phase.values.push_back(std::arg(h) / degree);
    out.insert(out.end(), {h1,
                           h2,
                           phase,
                           {e.signal.name + ".coherence", "", e.transfer->coherence},
                           {e.signal.name + ".gain_relative_error", "", e.transfer->gain_relative_error}});
    for (const auto& [end, sign] : {std::pair{"low", -1.0}, {"high", 1.0}}) {
      Column edge{fmt::format("{}.gain_h1_{}", e.signal.name, end), unit, h1.values};
      for (std::size_t k = 0; k < edge.values.size(); ++k) {
        edge.values[k] *= 1 + sign * half_band(*e.transfer, k, a.confidence);
        if (!e.resolution.empty()) edge.values[k] += sign * std::max(0.0, sign * e.resolution[k]);
      }
      out.push_back(std::move(edge));
    }
    Column hv{e.signal.name + ".gain_hv", unit, {}};
    for (std::size_t k = 0; k < h1.values.size(); ++k) hv.values.push_back(hs::total_gain(*e.transfer, k));
    out.push_back(std::move(hv));
  }
  return out;
}

const char* method_of(const Analysis& a) {
  return a.tapers ? "sine tapers" : a.uneven_segment ? "least squares (Lomb-Scargle)" : "Welch";
}

/// What was done before the spectrum, as attributes of the file.
void note_steps(hydro::io::Hdf5Writer& file, const StepsDone& done) {
  file.attribute("/", "prepared", fmt::format("{}", fmt::join(done.steps, "; ")));
  file.attribute("/", "cautions", fmt::format("{}", fmt::join(done.cautions, "; ")));
  file.attribute("/", "steady_from_s", done.steady_from_s);
  file.attribute("/", "steady_to_s", done.steady_to_s);
  file.attribute("/", "samples_filled", static_cast<double>(done.filled));
  for (const auto& [name, count] : done.outliers)
    file.attribute("/", "outliers_of_" + name, static_cast<double>(count));
}

/// The frequency below which 99.9 % of all variance lies: what lies beyond would squeeze the picture.
double interesting_hz(const Analysis& a) {
  const auto& f = a.estimates.front().welch.spectrum.frequency_hz;
  double highest = f[std::min<std::size_t>(8, f.size() - 1)];
  for (const Estimate& e : a.estimates) {
    const auto& density = e.welch.spectrum.density;
    double left = 0.001 * std::accumulate(density.begin(), density.end(), 0.0);
    std::size_t k = density.size() - 1;
    while (k > 0 && (left -= density[k]) > 0) --k;
    highest = std::max(highest, 1.2 * f[k]);
  }
  return std::min(f.back(), highest);
}

}  // namespace

Report report_of(const Analysis& a) {
  const hs::WelchSpectrum& w = a.estimates.front().welch;
  Report out, signals;
  if (a.prepared) out.part("prepared", froude::report_of(*a.prepared));
  if (a.tapers)
    out.say("{} samples every {:.6g} s; {} sine tapers over all of them", fact("samples", a.samples),
            fact("step_s", a.step), fact("tapers", *a.tapers));
  else if (a.uneven_segment)
    out.say("{} samples, most of them {:.6g} s apart; {} segments of {:.6g} s, Hann, half overlapping, least squares",
            fact("samples", a.samples), fact("step_s", a.step), fact("segments", w.segments),
            fact("segment_s", *a.uneven_segment));
  else
    out.say("{} samples every {:.6g} s; {} segments of {} ({:.6g} s), Hann, half overlapping",
            fact("samples", a.samples), fact("step_s", a.step), fact("segments", w.segments),
            fact("segment_samples", a.options.segment), static_cast<double>(a.options.segment) * a.step);
  out.say(
      "resolution {:.4g} Hz, {:.3g} degrees of freedom: with {:g} % the density in truth is {:.3g} to {:.3g} times the "
      "estimate",
      fact("resolution_hz", w.resolution_hz), fact("degrees_of_freedom", w.dof),
      fact("confidence", a.confidence, 100 * a.confidence), a.band.lower, a.band.upper);
  out.keep("band", std::vector{a.band.lower, a.band.upper}).keep("frequency_hz", w.spectrum.frequency_hz);
  out.say("{:<24} {:<8} {:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6}", "signal", "unit", "mean", "4 sqrt(m0)",
          "Tp [s]", "Te [s]", "Tm02 [s]", "Tz [s]", "H1/3", "waves");
  for (const Estimate& e : a.estimates) signals.part(e.signal.name, report_of(e, a.input));
  out.part("signals", std::move(signals));
  out.sentences("notes", "note: {}", notes_of(a));
  add_response(a, out);
  return out;
}

std::vector<std::string> notes_of(const Analysis& a) {
  std::vector<std::string> out = a.cautions;
  for (const Estimate& e : a.estimates)
    for (std::string& note : notes_of(e, a.uneven_segment.has_value())) out.push_back(std::move(note));
  for (const Estimate& e : a.estimates) {
    if (!e.transfer) continue;
    std::string caution =
        hs::caution_of_resolution(e.signal.name, *e.transfer, e.resolution, told_half_bands(e, a.confidence));
    if (!caution.empty()) out.push_back(std::move(caution));
  }
  return out;
}

void write_table(const Path& path, const Analysis& a) {
  std::vector<Column> columns = columns_of(a);
  const std::string kind = path.extension().string();
  if (kind == ".csv") {
    std::vector<hydro::io::CsvColumn> table;
    for (Column& c : columns) {
      // write_csv takes SI, and SI of a hertz is 2π rad/s: what it divides out again is put in here.
      const double factor = hydro::parse_unit(c.unit).factor;
      for (double& v : c.values) v *= factor;
      table.push_back({c.name, c.unit, &c.values});
    }
    std::vector<std::string> comments{
        fmt::format("one-sided densities by {}, {:g} % band from low to high", method_of(a), 100 * a.confidence)};
    const Report before = a.prepared ? froude::report_of(*a.prepared) : Report();
    comments.insert(comments.end(), before.lines().begin(), before.lines().end());
    hydro::io::write_csv(path, table, comments);
    return;
  }
  hydro::require(kind == ".h5", "the table is written as .csv or .h5, not as \"{}\"", path.filename().string());
  hydro::io::Hdf5Writer file;
  file.attribute("/", "kind", "froude psd");
  file.attribute("/", "froude_version", FROUDE_VERSION);
  file.attribute("/", "confidence", a.confidence);
  file.attribute("/", "degrees_of_freedom", a.estimates.front().welch.dof);
  if (a.prepared) note_steps(file, *a.prepared);
  for (const Column& c : columns) {
    const std::string name = "/" + c.name;
    file.write(name, c.values, {c.values.size()});
    if (c.name == "frequency") {
      file.make_dimension(name);
    } else {
      file.attach_dimension(name, 0, "/frequency");
    }
    file.attribute(name, "units", c.unit.empty() ? "1" : c.unit);
  }
  file.save(path);
}

plot::Figure figure(const Analysis& a, const std::string& file_name) {
  plot::Figure figure{.title = "Spectra of " + file_name, .panels = {}};
  const auto& f = a.estimates.front().welch.spectrum.frequency_hz;
  const plot::Axis x{.label = "frequency", .unit = "Hz", .range = std::pair{0.0, interesting_hz(a)}};
  const auto panel = [&](const std::string& label, const std::string& unit) -> plot::Panel& {
    const auto at = std::find_if(figure.panels.begin(), figure.panels.end(),
                                 [&](const auto& p) { return p.y.label == label && p.y.unit == unit; });
    if (at != figure.panels.end()) return *at;
    figure.panels.push_back({.x = x, .y = {label, unit}, .series = {}});
    return figure.panels.back();
  };
  double threshold = 0;
  for (const Estimate& e : a.estimates)
    if (e.transfer) threshold = e.transfer->coherence_threshold;
  const std::vector<Column> columns = columns_of(a);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& c = columns[i];
    if (c.name.ends_with(".density")) {
      auto& p = panel("density", c.unit);
      p.series.push_back({c.name.substr(0, c.name.size() - 8), f, c.values});
      p.bands.push_back({fmt::format("{:g} %", 100 * a.confidence), f, columns[i + 1].values, columns[i + 2].values});
    }
    if (c.name.ends_with(".gain_h1")) {
      // A gain between unrelated signals is noise; it would set the scale of the axis.
      plot::Series gain{c.name.substr(0, c.name.size() - 8) + ", where coherent", f, c.values};
      plot::Band band{fmt::format("{:g} %", 100 * a.confidence), {}, {}, {}};
      for (std::size_t k = 0; k < f.size(); ++k) {
        if (columns[i + 3].values[k] < threshold) gain.y[k] = std::numeric_limits<double>::quiet_NaN();
        if (columns[i + 3].values[k] < threshold) continue;
        band.x.push_back(f[k]);
        band.low.push_back(columns[i + 5].values[k]);
        band.high.push_back(columns[i + 6].values[k]);
      }
      panel("gain", c.unit).series.push_back(std::move(gain));
      panel("gain", c.unit).bands.push_back(std::move(band));
    }
    if (c.name.ends_with(".coherence"))
      panel("coherence", "").series.push_back({c.name.substr(0, c.name.size() - 10), f, c.values});
  }
  return figure;
}

}  // namespace froude::spectra
