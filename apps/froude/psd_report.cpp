#include "froude/psd_report.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/io/hdf5.hpp"

namespace froude::spectra {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A unit that hydro::parse_unit reads: "1/m/s" is written "m^-1 s^-1".
std::string unit_of(const hydro::Dimension& dimension) {
  const std::string si = dimension.si();
  if (!si.starts_with("1/")) return si;
  std::string out;
  for (std::size_t at = 1; at < si.size();) {
    const auto end = std::min(si.find('/', at + 1), si.size());
    const std::string factor = si.substr(at + 1, end - at - 1);
    const auto caret = factor.find('^');
    out += (out.empty() ? "" : " ") + factor.substr(0, caret) + "^-" +
           (caret == std::string::npos ? "1" : factor.substr(caret + 1));
    at = end;
  }
  return out;
}

bool is_one_symbol(const std::string& unit) {
  return !unit.empty() && std::all_of(unit.begin(), unit.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

/// Of a density: "m" → "m^2/Hz"; the SI base units where the signal's unit is composed.
std::string density_unit(const std::string& unit) {
  if (unit.empty()) return "Hz^-1";
  if (is_one_symbol(unit)) return unit + "^2/Hz";
  const auto dimension = hydro::parse_unit(unit).dimension;
  return unit_of(dimension * dimension) + "/Hz";
}

std::string gain_unit(const std::string& output, const std::string& input) {
  if (output == input) return "";
  if (is_one_symbol(output) && is_one_symbol(input)) return output + "/" + input;
  return unit_of(hydro::parse_unit(output).dimension / hydro::parse_unit(input).dimension);
}

std::string dash_or(bool known, double value) { return known ? fmt::format("{:.4g}", value) : "-"; }

void tell_text(const Analysis& a, const Console& console) {
  const hs::WelchSpectrum& w = a.estimates.front().welch;
  console.out << fmt::format(
      "{} samples every {:.6g} s; {} segments of {} ({:.6g} s), Hann, half overlapping\n"
      "resolution {:.4g} Hz, {:.3g} degrees of freedom: with {:g} % the density in truth is {:.3g} to {:.3g} times the "
      "estimate\n",
      a.samples, a.step, w.segments, a.options.segment, static_cast<double>(a.options.segment) * a.step,
      w.resolution_hz, w.dof, 100 * a.confidence, a.band.lower, a.band.upper);
  console.out << fmt::format("{:<24} {:<8} {:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6}\n", "signal", "unit",
                             "mean", "4 sqrt(m0)", "Tp [s]", "Te [s]", "Tm02 [s]", "Tz [s]", "H1/3", "waves");
  for (const Estimate& e : a.estimates) {
    const bool moves = e.moments.has_value(), waves = e.statistics.has_value();
    console.out << fmt::format(
        "{:<24} {:<8} {:>10.4g} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6}\n", e.signal.name,
        e.signal.units.empty() ? "-" : e.signal.units, e.welch.mean, dash_or(moves, moves ? e.moments->hs() : 0),
        dash_or(moves && !e.peak->at_edge, moves ? e.peak->period_s() : 0), dash_or(moves, moves ? e.moments->te() : 0),
        dash_or(moves, moves ? e.moments->tm02() : 0), dash_or(waves, waves ? e.statistics->mean_period : 0),
        dash_or(waves, waves ? e.statistics->h13 : 0), e.waves);
  }
  for (const Estimate& e : a.estimates) {
    if (!e.moments) console.out << fmt::format("note: {} never changes\n", e.signal.name);
    if (e.moments && e.peak->at_edge)
      console.out << fmt::format(
          "note: {} is strongest at an end of its spectrum, {:.4g} Hz: no peak, or one that needs longer segments "
          "(--segment)\n",
          e.signal.name, e.peak->frequency_hz);
    if (!e.drift.empty()) console.out << fmt::format("note: {} {}\n", e.signal.name, e.drift);
    if (e.moments && !e.statistics)
      console.out << fmt::format("note: {} has {} complete waves: too few for H1/3\n", e.signal.name, e.waves);
  }
}

/// Where the input is strongest, the response is known best: one line for each output.
void tell_transfer(const Analysis& a, const Console& console) {
  const auto input =
      std::find_if(a.estimates.begin(), a.estimates.end(), [&](const Estimate& e) { return e.signal.name == a.input; });
  if (input == a.estimates.end()) return;
  const auto& density = input->welch.spectrum.density;
  const auto k = static_cast<std::size_t>(std::max_element(density.begin() + 1, density.end()) - density.begin());
  console.out << fmt::format("response to {} at its peak, {:.4g} Hz:\n", a.input,
                             input->welch.spectrum.frequency_hz[k]);
  for (const Estimate& e : a.estimates)
    if (e.transfer)
      console.out << fmt::format(
          "{:<24} |H1| {:.4g} +- {:.2g} {}, |H2| {:.4g}, phase {:.1f} deg, coherence {:.3f} (unrelated signals stay "
          "below {:.2f} at {:g} % of the frequencies)\n",
          e.signal.name, std::abs(e.transfer->h1[k]), std::abs(e.transfer->h1[k]) * e.transfer->gain_relative_error[k],
          gain_unit(e.signal.units, input->signal.units), std::abs(e.transfer->h2[k]),
          std::arg(e.transfer->h1[k]) / degree, e.transfer->coherence[k], e.transfer->coherence_threshold,
          100 * a.confidence);
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
  }
  return out;
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

void tell(const Analysis& analysis, const Console& console) {
  tell_text(analysis, console);
  if (!analysis.input.empty()) tell_transfer(analysis, console);
}

nlohmann::json as_json(const Analysis& a) {
  const hs::WelchSpectrum& w = a.estimates.front().welch;
  nlohmann::json j{{"samples", a.samples},
                   {"step_s", a.step},
                   {"segment_samples", a.options.segment},
                   {"segments", w.segments},
                   {"resolution_hz", w.resolution_hz},
                   {"degrees_of_freedom", w.dof},
                   {"confidence", a.confidence},
                   {"band", {a.band.lower, a.band.upper}},
                   {"frequency_hz", w.spectrum.frequency_hz}};
  for (const Estimate& e : a.estimates) {
    nlohmann::json& s = j["signals"][e.signal.name];
    s = {{"unit", e.signal.units},
         {"mean", e.welch.mean},
         {"variance", e.welch.variance},
         {"density_per_hz", e.welch.spectrum.density},
         {"waves", e.waves}};
    if (e.moments) {
      s.update({{"hs", e.moments->hs()},
                {"te_s", e.moments->te()},
                {"tm01_s", e.moments->tm01()},
                {"tm02_s", e.moments->tm02()},
                {"epsilon", e.moments->epsilon()},
                {"nu", e.moments->nu()},
                {"tp_s", e.peak->period_s()},
                {"peak_at_edge", e.peak->at_edge}});
    }
    if (!e.drift.empty()) s["drift"] = e.drift;
    if (e.statistics)
      s.update({{"tz_s", e.statistics->mean_period},
                {"h13", e.statistics->h13},
                {"h_max", e.statistics->highest},
                {"t13_s", e.statistics->t13}});
    if (!e.transfer) continue;
    nlohmann::json gain = nlohmann::json::array(), phase = nlohmann::json::array();
    for (const auto& h : e.transfer->h1) {
      gain.push_back(std::abs(h));
      phase.push_back(std::arg(h));
    }
    s["transfer"] = {{"input", a.input},
                     {"gain", gain},
                     {"phase_rad", phase},
                     {"coherence", e.transfer->coherence},
                     {"gain_relative_error", e.transfer->gain_relative_error},
                     {"coherence_threshold", e.transfer->coherence_threshold}};
  }
  return j;
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
    hydro::io::write_csv(
        path, table, {fmt::format("one-sided densities by Welch, {:g} % band from low to high", 100 * a.confidence)});
    return;
  }
  hydro::require(kind == ".h5", "the table is written as .csv or .h5, not as \"{}\"", path.filename().string());
  hydro::io::Hdf5Writer file;
  file.attribute("/", "kind", "froude psd");
  file.attribute("/", "froude_version", FROUDE_VERSION);
  file.attribute("/", "confidence", a.confidence);
  file.attribute("/", "degrees_of_freedom", a.estimates.front().welch.dof);
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
      for (std::size_t k = 0; k < f.size(); ++k)
        if (columns[i + 3].values[k] < threshold) gain.y[k] = std::numeric_limits<double>::quiet_NaN();
      panel("gain", c.unit).series.push_back(std::move(gain));
    }
    if (c.name.ends_with(".coherence"))
      panel("coherence", "").series.push_back({c.name.substr(0, c.name.size() - 10), f, c.values});
  }
  return figure;
}

}  // namespace froude::spectra
