// `froude response`: spectra of responses in the sea of a scene, and over a scatter diagram.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "answers/picture.hpp"
#include "answers/response_check.hpp"
#include "answers/response_spectra.hpp"
#include "answers/second_order_spectra.hpp"
#include "compile/sections.hpp"
#include "froude/commands.hpp"
#include "froude/density_unit.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "froude/scene.hpp"
#include "froude/scene_result.hpp"
#include "froude/sections_told.hpp"
#include "froude/sn_curve.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/extremes.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;
using hs::GaussianPeaks, hs::PeakLaw;

/// What is asked beside the scene.
struct Asked {
  double duration;  ///< s
  std::vector<double> quantiles;
  std::optional<SnOfUnit> sn;
};

Asked asked_of(const ResponseArguments& a) {
  Asked out{option_si("--duration", a.duration, hydro::dim::time), a.quantiles, sn_curve(a.sn)};
  for (const double q : out.quantiles)
    if (!(q > 0 && q < 1))
      throw hydro::InputError(fmt::format("a quantile is between 0 and 1, got {:g}", q), {.file = "--quantile"},
                              "0.9 is the value that nine in ten durations stay below");
  if (!(out.duration > 0))
    throw hydro::InputError("the duration must be positive", {.file = "--duration"}, "write \"3 h\"");
  return out;
}

/// The moments of what responds; none where nothing does.
std::optional<hs::Moments> moments_of(const ResponseSpectrum& s) {
  const auto& density = s.spectrum.density;
  if (std::all_of(density.begin(), density.end(), [](double d) { return d == 0; })) return std::nullopt;
  return hs::moments(s.spectrum, hs::whole(s.spectrum));
}

std::string unit_or_dash(const std::string& units) { return units.empty() ? "-" : units; }

/// "0.99" → "99 %".
std::string percent(double share) { return fmt::format("{:g} %", 100 * share); }

// ---- one sea ----

Report statistics_of(const ResponseSpectrum& s, const hs::Moments& m) {
  const hs::Peak peak = hs::peak(s.spectrum, hs::whole(s.spectrum));
  Report out;
  out.say("{:<24} {:<7} {:>11.5g} {:>11.5g} {:>8.4g} {:>8} {:>8.4g} {:>8.4g} {:>6.3f} {:>6.3f}", s.name,
          fact("unit", s.units, unit_or_dash(s.units)), fact("standard_deviation", std::sqrt(m.m0)),
          fact("significant_amplitude", 2 * std::sqrt(m.m0)), fact("tz_s", m.tm02()),
          fact("tp_s", peak.period_s(), peak.at_edge ? std::string("-") : fmt::format("{:.4g}", peak.period_s())),
          fact("mean_period_s", m.tm01()), fact("period_of_peaks_s", std::sqrt(m.m2 / m.m4)),
          fact("epsilon", m.epsilon()), fact("nu", m.nu()));
  out.keep("m0", m.m0).keep("m1", m.m1).keep("m2", m.m2).keep("m4", m.m4).keep("peak_at_edge", peak.at_edge);
  return out.keep("up_crossings_per_s", 1 / m.tm02()).keep("density_per_hz", s.spectrum.density);
}

Report moments_line(const ResponseSpectrum& s, const hs::Moments& m) {
  return std::move(Report().say("{:<24} {:<7} {:>13.5g} {:>13.5g} {:>13.5g} {:>13.5g}", s.name, unit_or_dash(s.units),
                                m.m0, m.m1, m.m2, m.m4));
}

Report largest_of(const ResponseSpectrum& s, const hs::Moments& m, const Asked& asked) {
  const GaussianPeaks narrow(m, PeakLaw::rayleigh), broad(m, PeakLaw::rice);
  std::string columns;
  Json quantiles = Json::array();
  for (const double q : asked.quantiles) {
    const double level = broad.largest_not_exceeded(asked.duration, q);
    columns += fmt::format(" {:>11.5g}", level);
    quantiles.push_back(
        {{"probability", q}, {"rice", level}, {"rayleigh", narrow.largest_not_exceeded(asked.duration, q)}});
  }
  Report out;
  out.say("{:<24} {:<7} {:>12.5g} {:>12.5g} {:>12.5g}{}", s.name, unit_or_dash(s.units),
          fact("most_probable", broad.most_probable_largest(asked.duration)),
          fact("expected_rayleigh", narrow.expected_largest(asked.duration)),
          fact("expected_rice", broad.expected_largest(asked.duration)), columns);
  return out.keep("not_exceeded", quantiles);
}

Report damage_of(const ResponseSpectrum& s, const hs::Moments& m, const Asked& asked) {
  const std::optional<double> dirlik = hs::dirlik_damage_rate(m, asked.sn->curve);
  const double narrow = hs::narrow_band_damage_rate(m, asked.sn->curve);
  const std::optional<double> damage = dirlik ? std::optional(*dirlik * asked.duration) : std::nullopt;
  Report out;
  out.say("{:<24} {:<7} {:>14} {:>14.5g} {:>14.5g}", s.name, unit_or_dash(s.units),
          fact("damage_dirlik", damage, damage ? fmt::format("{:.5g}", *damage) : std::string("-")),
          fact("damage_narrow_band", narrow * asked.duration), fact("life_h", 1 / dirlik.value_or(narrow) / 3600));
  return out;
}

/// How drag became linear, and the relative velocities it is linear for. (D143)
Report drag_of(const DragInSea& drag) {
  Report out;
  out.say("{:<24} {:>16} {:>16} {:>16}", "drag, linear in this sea", "sigma [m/s]", "across [m/s]", "F/w [N s/m]");
  for (const MemberDrag& m : drag.members)
    out.row("members", "{:<24} {:>16.5g} {:>16.5g} {:>16.5g}", fact("member", m.member),
            fact("sigma_major_m_per_s", m.sigma_major), fact("sigma_minor_m_per_s", m.sigma_minor),
            fact("coefficient_n_s_per_m", m.coefficient));
  out.say("drag settled in {} iterations; one more would change it by {:.2g} of its largest coefficient",
          fact("iterations", drag.iterations), fact("residual", drag.residual));
  return out;
}

/// m₀, m₂ of a part; zeros where it has none.
struct Part {
  double m0 = 0, m2 = 0;
  explicit Part(const hs::SpectrumPerHz& s) {
    if (std::all_of(s.density.begin(), s.density.end(), [](double d) { return d == 0; })) return;
    const hs::Moments m = hs::moments(s, hs::whole(s));
    m0 = m.m0, m2 = m.m2;
  }
};

/// Offset and deviations, first order beside second. Parts are uncorrelated: variances add. (D142)
Report second_order_of(const ResponseSpectra& r, const SecondOrderResponses& second) {
  Report out, signals;
  out.say("{:<24} {:<7} {:>11} {:>11} {:>11} {:>11} {:>11} {:>13}", "second order", "unit", "offset", "dev. first",
          "dev. slow", "dev. sums", "dev. all", "Tz slow [s]");
  for (std::size_t s = 0; s < second.signals.size(); ++s) {
    const SecondOrderResponse& of = second.signals[s];
    const Part first(r.signals[s].spectrum), slow(of.slow), sum(of.sum);
    const double all = first.m0 + slow.m0 + sum.m0;
    if (of.offset == 0 && all == 0) continue;
    const std::optional<double> tz = slow.m2 > 0 ? std::optional(std::sqrt(slow.m0 / slow.m2)) : std::nullopt;
    Report one;
    one.say("{:<24} {:<7} {:>11.5g} {:>11.5g} {:>11.5g} {:>11.5g} {:>11.5g} {:>13}", of.name,
            fact("unit", of.units, unit_or_dash(of.units)), fact("offset", of.offset),
            fact("standard_deviation_first", std::sqrt(first.m0)), fact("standard_deviation_slow", std::sqrt(slow.m0)),
            fact("standard_deviation_sums", std::sqrt(sum.m0)), fact("standard_deviation_all", std::sqrt(all)),
            fact("tz_slow_s", tz, tz ? fmt::format("{:.4g}", *tz) : std::string("-")));
    one.keep("slow_frequency_hz", of.slow.frequency_hz).keep("slow_density_per_hz", of.slow.density);
    one.keep("sum_frequency_hz", of.sum.frequency_hz).keep("sum_density_per_hz", of.sum.density);
    signals.part(of.name, std::move(one));
  }
  out.keep("error", second.error);
  return std::move(out.part("signals", std::move(signals)).sentences("notes", "note: {}", second.notes));
}

Report report_of(const scene::Scene& scene, const ResponseSpectra& r, const SecondOrderResponses* second,
                 const Asked& asked) {
  Report out, statistics, moments, largest, damage;
  const hs::Moments sea = hs::moments(r.sea, hs::whole(r.sea));
  out.say("{}: {} signals at {} frequencies and {} {}, placed until moments are within {:.2g} (asked {:g})",
          scene.file.filename().string(), r.signals.size(), fact("frequencies", r.sea.frequency_hz.size()),
          fact("headings", r.headings), r.headings == 1 ? "heading" : "headings", fact("error", r.error),
          scene.accuracy);
  out.say("sea: Hs {:.4g} m, Tz {:.4g} s between {:.4g} and {:.4g} Hz; {:.2g} % of its energy lies outside",
          fact("sea_hs_m", sea.hs()), fact("sea_tz_s", sea.tm02()), sea.band.from_hz, sea.band.to_hz,
          fact("sea_left_out", r.left_out, 100 * r.left_out));
  out.keep("duration_s", asked.duration)
      .keep("frequency_hz", r.sea.frequency_hz)
      .keep("sea_density_per_hz", r.sea.density);
  statistics.say("{:<24} {:<7} {:>11} {:>11} {:>8} {:>8} {:>8} {:>8} {:>6} {:>6}", "signal", "unit", "deviation",
                 "2 dev.", "Tz [s]", "Tp [s]", "Tm01 [s]", "Tc [s]", "eps", "nu");
  moments.say("{:<24} {:<7} {:>13} {:>13} {:>13} {:>13}", "moments of f^n S(f), Hz^n", "unit^2", "m0", "m1", "m2",
              "m4");
  std::string columns;
  for (const double q : asked.quantiles) columns += fmt::format(" {:>11}", percent(q));
  largest.say("{:<24} {:<7} {:>12} {:>12} {:>12}{}", fmt::format("largest in {:.4g} h", asked.duration / 3600), "unit",
              "most prob.", "E Rayleigh", "E Rice", columns);
  damage.say("{:<24} {:<7} {:>14} {:>14} {:>14}", fmt::format("damage in {:.4g} h", asked.duration / 3600), "unit",
             "Dirlik", "narrow band", "life [h]");
  std::vector<std::string> notes = r.notes;
  for (const ResponseSpectrum& s : r.signals) {
    const auto m = moments_of(s);
    if (!m) {
      notes.push_back(s.name + " does not respond to this sea");
      continue;
    }
    statistics.part(s.name, statistics_of(s, *m));
    moments.part("", moments_line(s, *m));
    largest.part(s.name, largest_of(s, *m, asked));
    if (asked.sn && asked.sn->fits(s.units)) damage.part(s.name, damage_of(s, *m, asked));
  }
  out.part("signals", std::move(statistics)).part("", std::move(moments)).part("largest", std::move(largest));
  if (asked.sn) out.part("damage", std::move(damage));
  if (!r.sections.empty()) out.part("at_rest", report_of(r.sections));
  if (r.drag) out.part("drag", drag_of(*r.drag));
  if (second != nullptr) out.part("second_order", second_order_of(r, *second));
  return std::move(out.sentences("notes", "note: {}", notes).sentences("warnings", "{}", r.warnings));
}

// ---- the same by runs ----

/// The linear number beside that of the runs. Where they differ by more than the accuracy that the scene asks for, and
/// that is no chance, the answer says so.
Report compared(const std::string& signal, const std::string& what, double linear, const OfRuns& runs, double accuracy,
                std::vector<std::string>& warnings) {
  constexpr double by_chance = 3;  // standard errors, of a few runs
  const double off = linear - runs.mean;
  if (std::abs(off) > accuracy * std::abs(runs.mean) && std::abs(off) > by_chance * runs.error)
    warnings.push_back(fmt::format("{}: {} is {:.5g} by the linear response and {:.5g} +- {:.2g} by runs, {:+.1f} %",
                                   signal, what, linear, runs.mean, runs.error, 100 * off / runs.mean));
  Report out;
  return std::move(out.keep("linear", linear).keep("runs", runs.mean).keep("standard_error", runs.error));
}

Report check_of(const ResponseSpectra& r, const std::vector<CheckedStatistics>& checked, const Asked& asked,
                const ResponseArguments& arguments, double accuracy) {
  Report out;
  std::vector<std::string> warnings;
  out.say("{:<24} {:<7} {:>11} {:>20} {:>8} {:>16} {:>11} {:>20}",
          fmt::format("by {} runs of {:.4g} h", arguments.check_runs, asked.duration / 3600), "unit", "deviation",
          "of runs", "Tz [s]", "of runs", "E Rice", "largest of runs");
  for (const CheckedStatistics& c : checked) {
    const auto& of = *std::ranges::find(r.signals, c.signal, &ResponseSpectrum::name);
    const hs::Moments m = *moments_of(of);
    const double largest = GaussianPeaks(m, PeakLaw::rice).expected_largest(asked.duration);
    const auto with_error = [](const OfRuns& n) { return fmt::format("{:.5g} +- {:.2g}", n.mean, n.error); };
    Report one;
    one.say("{:<24} {:<7} {:>11.5g} {:>20} {:>8.4g} {:>16} {:>11.5g} {:>20}", c.signal, unit_or_dash(c.units),
            std::sqrt(m.m0), with_error(c.deviation), m.tm02(), with_error(c.tz), largest, with_error(c.largest));
    one.part("deviation", compared(c.signal, "the deviation", std::sqrt(m.m0), c.deviation, accuracy, warnings));
    one.part("tz_s", compared(c.signal, "the mean period", m.tm02(), c.tz, accuracy, warnings));
    one.part("largest", compared(c.signal, "the expected largest value", largest, c.largest, accuracy, warnings));
    one.keep("mean", c.mean.mean).keep("standard_error_of_mean", c.mean.error);
    out.part(c.signal, std::move(one));
  }
  out.keep("number_of_runs", arguments.check_runs);
  return std::move(out.sentences("warnings", "warning: {}", warnings));
}

/// \throws hydro::InputError for what cannot be held against runs
void require_checkable(const ResponseArguments& arguments) {
  if (!arguments.check.empty() && arguments.scatter)
    throw hydro::InputError("--check runs one sea, and --scatter has many", {.file = "--check"},
                            "leave one of them out");
}

/// SI of a hertz is 2π rad/s, which write_csv() divides by: it is put in here.
std::vector<double> as_si_of(const std::string& unit, std::vector<double> values) {
  const double factor = hydro::parse_unit(unit).factor;
  for (double& v : values) v *= factor;
  return values;
}

/// What a spectrum, or a part of one, is called.
struct NamedSpectrum {
  std::string name, units;
  const hs::SpectrumPerHz* spectrum;
};

/// The sea, responses of first order, and parts of second order, of what has any.
std::vector<NamedSpectrum> spectra_of(const ResponseSpectra& r, const SecondOrderResponses* second) {
  std::vector<NamedSpectrum> out{{"sea", "m^2/Hz", &r.sea}};
  for (const auto& s : r.signals) out.push_back({s.name, density_unit(s.units), &s.spectrum});
  if (second == nullptr) return out;
  for (const auto& s : second->signals) {
    if (Part(s.slow).m0 > 0) out.push_back({s.name + " slow", density_unit(s.units), &s.slow});
    if (Part(s.sum).m0 > 0) out.push_back({s.name + " sums", density_unit(s.units), &s.sum});
  }
  return out;
}

/// Straight between the frequencies of a spectrum, nothing beyond them.
double density_at(const hs::SpectrumPerHz& s, double f) {
  const auto high = std::lower_bound(s.frequency_hz.begin(), s.frequency_hz.end(), f);
  if (high == s.frequency_hz.end()) return 0;
  const auto i = static_cast<std::size_t>(high - s.frequency_hz.begin());
  if (*high == f) return s.density[i];
  if (i == 0) return 0;
  const double u = (f - s.frequency_hz[i - 1]) / (s.frequency_hz[i] - s.frequency_hz[i - 1]);
  return (1 - u) * s.density[i - 1] + u * s.density[i];
}

/// One column a spectrum, at the frequencies of all of them.
void write_spectra(const Path& path, const std::vector<NamedSpectrum>& spectra) {
  std::vector<double> frequency;
  for (const auto& s : spectra)
    frequency.insert(frequency.end(), s.spectrum->frequency_hz.begin(), s.spectrum->frequency_hz.end());
  std::sort(frequency.begin(), frequency.end());
  frequency.erase(std::unique(frequency.begin(), frequency.end()), frequency.end());
  std::vector<std::vector<double>> values{as_si_of("Hz", frequency)};
  for (const auto& s : spectra) {
    std::vector<double> density;
    for (const double f : frequency) density.push_back(density_at(*s.spectrum, f));
    values.push_back(as_si_of(s.units, std::move(density)));
  }
  std::vector<hydro::io::CsvColumn> columns{{"frequency", "Hz", &values.front()}};
  for (std::size_t i = 0; i < spectra.size(); ++i)
    columns.push_back({spectra[i].name, spectra[i].units, &values[i + 1]});
  hydro::io::write_csv(path, columns, {"one-sided densities of responses in the sea"});
}

plot::Figure figure(const scene::Scene& scene, const std::vector<NamedSpectrum>& spectra) {
  plot::Figure out{.title = scene.title.empty() ? "Response spectra" : scene.title, .panels = {}};
  for (const auto& s : spectra) {
    auto at = std::find_if(out.panels.begin(), out.panels.end(), [&](const auto& p) { return p.y.unit == s.units; });
    if (at == out.panels.end())
      at = out.panels.insert(at, {.x = {"frequency", "Hz"}, .y = {"density", s.units}, .series = {}});
    at->series.push_back({s.name, s.spectrum->frequency_hz, s.spectrum->density});
  }
  return out;
}

// ---- a lifetime of seas ----

/// The seas of a scatter diagram and how often they come.
struct Scatter {
  std::vector<double> share;
  std::vector<Scene> scenes;
};

/// A row's numbers are those of a sea. `all`: the sum of shares.
void require_sea(const hydro::io::CsvTable& table, std::size_t row, double all) {
  for (const char* name : {"hs", "tp"})
    if (!(table.column(name)[row] > 0))
      throw hydro::InputError(fmt::format("{} of a sea must be positive", name), table.place_of(name, row),
                              "for calm write a small height: shares are divided by their sum, which calm counts in");
  if (!(table.column("share")[row] >= 0) || !(all > 0))
    throw hydro::InputError("the share of a sea must not be negative, and one at least must come",
                            table.place_of("share", row),
                            "write how often the sea comes, in any measure: shares are divided by their sum");
}

Scatter scatter_of(const ResponseArguments& arguments) {
  const auto table = hydro::io::CsvTable::read(*arguments.scatter);
  const auto &hs = table.column("hs", hydro::dim::length), &tp = table.column("tp", hydro::dim::time),
             &share = table.column("share", hydro::dim::none);
  const double all = std::accumulate(share.begin(), share.end(), 0.0);
  const Scene scene = read(arguments.scene);
  const Parameter height = scene.parameter("waves.hs"), period = scene.parameter("waves.tp");
  Scatter out;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    require_sea(table, i, all);
    if (share[i] == 0) continue;
    out.share.push_back(share[i] / all);
    out.scenes.push_back(scene::placed([&] { return table.place_of("hs", i); },
                                       [&] {
                                         return scene.with(height, hs[i] / hydro::parse_unit(height.unit).factor)
                                             .with(period, tp[i] / hydro::parse_unit(period.unit).factor);
                                       }));
  }
  return out;
}

/// One signal over all seas.
struct Life {
  std::string name, units;
  std::vector<hs::StationaryPart> parts;
  std::optional<double> damage;  ///< in the duration, by Dirlik's formula or, where it has none, as a narrow band
  double narrow_seas = 0;        ///< share of the time in which it has none
};

std::vector<Life> lives_of(const Scatter& scatter, const std::vector<ResponseSpectra>& seas, const Asked& asked) {
  std::vector<Life> out;
  for (std::size_t s = 0; s < seas.front().signals.size(); ++s) {
    Life life{seas.front().signals[s].name, seas.front().signals[s].units, {}, {}};
    const bool has_damage = asked.sn && asked.sn->fits(life.units);
    if (has_damage) life.damage = 0;
    for (std::size_t i = 0; i < seas.size(); ++i) {
      const auto m = moments_of(seas[i].signals[s]);
      if (!m) continue;
      life.parts.push_back({scatter.share[i], GaussianPeaks(*m, PeakLaw::rice)});
      if (!has_damage) continue;
      const auto dirlik = hs::dirlik_damage_rate(*m, asked.sn->curve);
      if (!dirlik) life.narrow_seas += scatter.share[i];
      *life.damage +=
          asked.duration * scatter.share[i] * dirlik.value_or(hs::narrow_band_damage_rate(*m, asked.sn->curve));
    }
    out.push_back(std::move(life));
  }
  return out;
}

/// Levels up to the largest that counts, and how many peaks are above.
struct Exceedance {
  std::vector<double> level, peaks;
};

Exceedance exceedance_of(const Life& life, double duration) {
  Exceedance out;
  const double top = 1.1 * hs::largest_of_life(life.parts, duration, 0.99);
  constexpr int points = 101;
  for (int i = 0; i < points; ++i) {
    out.level.push_back(top * i / (points - 1));
    out.peaks.push_back(hs::expected_peaks_above(life.parts, out.level.back(), duration));
  }
  return out;
}

Report report_of(const Scatter& scatter, const std::vector<ResponseSpectra>& seas, const std::vector<Life>& lives,
                 const Asked& asked) {
  Report out, signals;
  out.say("{} seas, {} frequencies and {} {} for all of them; {:.6g} h", fact("seas", scatter.scenes.size()),
          fact("frequencies", seas.front().sea.frequency_hz.size()), fact("headings", seas.front().headings),
          seas.front().headings == 1 ? "heading" : "headings",
          fact("duration_s", asked.duration, asked.duration / 3600));
  out.keep("error", seas.front().error);
  std::string columns;
  for (const double q : asked.quantiles) columns += fmt::format(" {:>11}", percent(q));
  signals.say("{:<24} {:<7} {:>13} {:>12}{}{}", "signal", "unit", "peaks > 0", "1 expected", columns,
              asked.sn ? fmt::format(" {:>11} {:>11}", "damage", "life [h]") : "");
  std::vector<std::string> notes = seas.front().notes;
  if (seas.front().drag) {
    int most = 0;
    double residual = 0;
    for (const auto& sea : seas) {
      most = std::max(most, sea.drag->iterations);
      residual = std::max(residual, sea.drag->residual);
    }
    notes.push_back(fmt::format(
        "drag on members is linear for each sea by itself, settled in {} iterations at most, to {:.2g} of its largest "
        "coefficient; frequencies are each sea's own, and the first line tells those of the first",
        most, residual));
  }
  const auto& bodies = scatter.scenes.front().read().bodies;
  if (std::any_of(bodies.begin(), bodies.end(), [](const auto& b) { return b.second_order; }))
    notes.emplace_back("wave loads of second order are left out of a lifetime: one sea at a time has them");
  for (const Life& life : lives) {
    if (life.parts.empty()) {
      notes.push_back(life.name + " does not respond to these seas");
      continue;
    }
    Report one;
    std::string levels;
    Json quantiles = Json::array();
    for (const double q : asked.quantiles) {
      const double level = hs::largest_of_life(life.parts, asked.duration, q);
      levels += fmt::format(" {:>11.5g}", level);
      quantiles.push_back({{"probability", q}, {"largest", level}});
    }
    // One peak above is expected where e^{−n} = e^{−1}.
    one.say("{:<24} {:<7} {:>13.5g} {:>12.5g}{}{}", life.name, fact("unit", life.units, unit_or_dash(life.units)),
            fact("peaks_above_mean", hs::expected_peaks_above(life.parts, 0, asked.duration)),
            fact("exceeded_once", hs::largest_of_life(life.parts, asked.duration, std::exp(-1.0))), levels,
            life.damage ? fmt::format(" {:>11.4g} {:>11.4g}", *life.damage, asked.duration / *life.damage / 3600) : "");
    one.keep("not_exceeded", quantiles);
    if (life.damage) one.keep("damage", *life.damage);
    const Exceedance e = exceedance_of(life, asked.duration);
    one.keep("level", e.level).keep("peaks_above", e.peaks);
    signals.part(life.name, std::move(one));
    if (life.narrow_seas > 0)
      notes.push_back(
          fmt::format("Dirlik's formula has no density of {} in {:.2g} % of the time: its damage there is that of a "
                      "narrow band",
                      life.name, 100 * life.narrow_seas));
  }
  std::vector<std::string> warnings;
  double left_out = 0;
  for (const auto& sea : seas) left_out = std::max(left_out, sea.left_out);
  if (left_out > scatter.scenes.front().read().accuracy)
    warnings.push_back(fmt::format(
        "warning: up to {:.2g} % of a sea's energy lies outside the frequencies of [ask.rao]", 100 * left_out));
  out.part("signals", std::move(signals));
  return std::move(out.sentences("notes", "note: {}", notes).sentences("warnings", "{}", warnings));
}

void write_exceedances(const Path& path, const std::vector<Life>& lives, double duration) {
  std::vector<Exceedance> found;
  for (const Life& life : lives)
    if (!life.parts.empty()) found.push_back(exceedance_of(life, duration));
  std::vector<hydro::io::CsvColumn> columns;
  std::size_t next = 0;
  for (const Life& life : lives) {
    if (life.parts.empty()) continue;
    columns.push_back({life.name + ".level", life.units, &found[next].level});
    columns.push_back({life.name + ".peaks_above", "", &found[next++].peaks});
  }
  hydro::io::write_csv(path, columns, {fmt::format("expected peaks above levels in {:.6g} s", duration)});
}

plot::Figure figure(const std::string& title, const std::vector<Life>& lives, double duration) {
  plot::Figure out{.title = title, .panels = {}};
  for (const Life& life : lives) {
    if (life.parts.empty()) continue;
    auto at = std::find_if(out.panels.begin(), out.panels.end(), [&](const auto& p) { return p.x.unit == life.units; });
    if (at == out.panels.end())
      at = out.panels.insert(at, {.x = {.label = "level", .unit = life.units},
                                  .y = {.label = fmt::format("peaks above in {:.4g} h", duration / 3600),
                                        .unit = "",
                                        .scale = plot::Scale::logarithmic},
                                  .series = {}});
    Exceedance e = exceedance_of(life, duration);
    at->series.push_back({life.name, std::move(e.level), std::move(e.peaks)});
  }
  return out;
}

std::vector<std::string> units_of(const ResponseSpectra& r) {
  std::vector<std::string> out;
  for (const auto& s : r.signals) out.push_back(s.units);
  return out;
}

}  // namespace

void response(const ResponseArguments& arguments, const Console& console) {
  std::vector<NamedFile> inputs = files_of_scene(arguments.scene);
  if (arguments.scatter) inputs.push_back({"--scatter", *arguments.scatter});
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}), inputs);
  require_picture(arguments.picture);
  require_csv(arguments.output);
  require_checkable(arguments);
  const Asked asked = asked_of(arguments);
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.rao.has_value(), scene, "RAOs", "rao = { periods = \"3 s .. 25 s, 45 values\" }");
  if (!arguments.check.empty()) compile::require_no_sections(scene);
  if (arguments.scatter) {
    const Scatter scatter = scatter_of(arguments);
    std::vector<const scene::Scene*> scenes;
    for (const Scene& s : scatter.scenes) scenes.push_back(&s.read());
    const auto seas = response_spectra(scenes);
    if (asked.sn) require_one_fits(*asked.sn, units_of(seas.front()));
    const auto lives = lives_of(scatter, seas, asked);
    const Report report = scene::placed({.file = "--duration"}, [&] { return report_of(scatter, seas, lives, asked); });
    if (arguments.output) write_exceedances(*arguments.output, lives, asked.duration);
    if (arguments.picture)
      plot::write_picture(*arguments.picture,
                          figure(scene.title.empty() ? "Exceedance of levels" : scene.title, lives, asked.duration));
    tell(Report(report).wrote(arguments.output).wrote(arguments.picture), console);
    return;
  }
  const auto kept = std::make_shared<compile::Kept>();  // coefficients are read or computed once
  const ResponseSpectra found = response_spectra({&scene}, kept).front();
  if (asked.sn) require_one_fits(*asked.sn, units_of(found));
  std::vector<double> resolved;
  for (const double f : found.sea.frequency_hz) resolved.push_back(2 * std::numbers::pi * f);
  const std::optional<SecondOrderResponses> more = second_order_responses(scene, kept, resolved);
  const SecondOrderResponses* second = more ? &*more : nullptr;
  Report report = scene::placed({.file = "--duration"}, [&] { return report_of(scene, found, second, asked); });
  if (!arguments.check.empty()) {
    Progress progress(console.err, "check", console.show_progress);
    const auto checked = check_by_runs(scene, found, asked.duration, arguments.check_runs, hydro::all_processors(),
                                       kept, [&](double done) { progress.update(done); });
    report.part("check", check_of(found, checked, asked, arguments, scene.accuracy));
  }
  const std::vector<NamedSpectrum> spectra = spectra_of(found, second);
  if (arguments.output) write_spectra(*arguments.output, spectra);
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(scene, spectra));
  tell(report.wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
