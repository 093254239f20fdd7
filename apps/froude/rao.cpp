#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "answers/linear_response.hpp"
#include "answers/picture.hpp"
#include "answers/rao_check.hpp"
#include "compile/compile.hpp"
#include "compile/sections.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "froude/sections_told.hpp"
#include "froude/shares.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "interchange/csv.hpp"

namespace froude {
namespace {

double degrees(double radians) { return hydro::Angle::from_radians(radians).degrees(); }

std::vector<double> periods_of(const Responses& r) {
  std::vector<double> period;
  for (const double w : r.omega) period.push_back(2 * std::numbers::pi / w);
  return period;
}

/// A signal in waves of heading number h.
std::span<const std::complex<double>> of_heading(const ComplexSignal& signal, const Responses& r, std::size_t h) {
  return std::span(signal.values).subspan(h * r.omega.size(), r.omega.size());
}

template <class Values>
std::vector<double> amplitudes_of(const Values& values) {
  std::vector<double> out;
  for (const auto& v : values) out.push_back(std::abs(v));
  return out;
}
template <class Values>
std::vector<double> phases_of(const Values& values) {
  std::vector<double> out;
  for (const auto& v : values) out.push_back(std::arg(v));
  return out;
}

/// The highest point of a response and where it is.
struct Peak {
  double amplitude = 0, period = 0, phase = 0;
};

Peak peak(std::span<const std::complex<double>> values, const std::vector<double>& omega) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < omega.size(); ++i)
    if (std::norm(values[i]) >= std::norm(values[best])) best = i;
  return {std::abs(values[best]), 2 * std::numbers::pi / omega[best], degrees(std::arg(values[best]))};
}

/// One panel for each unit, so that metres and newtons do not share an axis.
std::vector<plot::Panel> panels_by_unit(const Responses& r) {
  std::vector<plot::Panel> panels;
  for (const auto& s : r.signals) {
    auto at = std::find_if(panels.begin(), panels.end(), [&](const auto& p) { return p.y.unit == s.units; });
    if (at == panels.end())
      at = panels.insert(at, {.x = {"wave period", "s"}, .y = {"amplitude", s.units}, .series = {}});
    at->series.push_back({s.name, periods_of(r), amplitudes_of(s.values)});
  }
  return panels;
}

/// One panel for each signal, one curve for each heading.
std::vector<plot::Panel> panels_by_signal(const Responses& r) {
  std::vector<plot::Panel> panels;
  for (const auto& s : r.signals) {
    panels.push_back({.x = {"wave period", "s"}, .y = {s.name, s.units}, .series = {}});
    for (std::size_t h = 0; h < r.heading.size(); ++h)
      panels.back().series.push_back(
          {fmt::format("{:.4g} deg", degrees(r.heading[h])), periods_of(r), amplitudes_of(of_heading(s, r, h))});
  }
  return panels;
}

plot::Figure figure(const scene::Scene& scene, const Responses& r) {
  return {.title = scene.title.empty() ? "Response amplitude operators" : scene.title,
          .panels = r.heading.size() == 1 ? panels_by_unit(r) : panels_by_signal(r)};
}

/// What runs have at the same frequency, as marks upon the curves of `r`, which may be over the slope of the wave where
/// cells are per metre: both are over the same wave.
void mark_runs(const std::vector<CheckedCell>& cells, const Responses& r, plot::Figure& figure) {
  for (std::size_t i = 0; i < r.signals.size(); ++i) {
    const ComplexSignal& s = r.signals[i];
    const auto panel = r.heading.size() > 1 ? figure.panels.begin() + static_cast<std::ptrdiff_t>(i)
                                            : std::find_if(figure.panels.begin(), figure.panels.end(),
                                                           [&](const plot::Panel& p) { return p.y.unit == s.units; });
    plot::Series marks{.name = s.name + ", runs", .x = {}, .y = {}, .line = false, .marks = true};
    for (const CheckedCell& c : cells) {
      const auto at = std::find(r.omega.begin(), r.omega.end(), c.omega);
      if (c.signal != s.name || at == r.omega.end()) continue;
      const double linear = std::abs(of_heading(s, r, 0)[static_cast<std::size_t>(at - r.omega.begin())]);
      if (std::abs(c.linear) == 0) continue;
      marks.x.push_back(2 * std::numbers::pi / c.omega);
      marks.y.push_back(std::abs(c.run) * linear / std::abs(c.linear));
    }
    if (!marks.x.empty()) panel->series.push_back(std::move(marks));
  }
}

/// Its peaks for people, all of it for programs: one list a heading where there are several. A tree of all numbers of a
/// thousand bodies takes longer than they do, and is made where it is asked for.
Report report_of(const ComplexSignal& s, const Responses& r, bool for_programs) {
  const bool several = r.heading.size() > 1;
  Report out;
  Json amplitude, phase;
  for (std::size_t h = 0; h < r.heading.size(); ++h) {
    const auto values = of_heading(s, r, h);
    const Peak p = peak(values, r.omega);
    out.say("{:<24} {}{:>12.5g} {:<7} {:>10.4g} {:>10.1f}", s.name,
            several ? fmt::format("{:>13.4g} ", degrees(r.heading[h])) : "", p.amplitude, fact("unit", s.units),
            p.period, p.phase);
    if (!for_programs) continue;
    amplitude.push_back(amplitudes_of(values));
    phase.push_back(phases_of(values));
  }
  if (!for_programs) return out;
  return out.keep("amplitude", several ? amplitude : amplitude[0]).keep("phase_rad", several ? phase : phase[0]);
}

/// Responses beside what runs have at the same frequency; peaks and the signal with the largest difference first.
Report report_of(const std::vector<CheckedCell>& cells) {
  Report out;
  out.say("in time, waves of the first heading: difference and what a run has not settled are of the signal's peak");
  out.say("{:<24} {:>8} {:>10} {:>12} {:>12} {:>11} {:>10} {:>12}", "signal", "T [s]", "height [m]", "linear", "run",
          "difference", "unsettled", "other rms");
  const CheckedCell* worst = nullptr;
  for (const CheckedCell& c : cells) {
    out.row("cells", "{:<24} {:>8.4g} {:>10.4g} {:>12.5g} {:>12.5g} {:>9.2g} % {:>8.2g} % {:>12.3g}",
            fact("signal", c.signal), fact("period_s", 2 * std::numbers::pi / c.omega), fact("height_m", c.height),
            fact("linear", std::abs(c.linear)), fact("run", std::abs(c.run)),
            fact("difference", c.difference(), 100 * c.difference()), fact("unsettled", c.unsettled, 100 * c.unsettled),
            fact("other_rms", c.rest));
    if (worst == nullptr || c.difference() > worst->difference()) worst = &c;
  }
  if (worst != nullptr)
    out.say(
        "what the linear answer ignores, with the errors of the runs, is at most {:.2g} % of the peak: {} at {:.4g} s, "
        "waves of {:.4g} m",
        100 * worst->difference(), worst->signal, 2 * std::numbers::pi / worst->omega, worst->height);
  return out;
}

Report report_of(const scene::Scene& scene, const Responses& r, const Shares& shares, const Path& file,
                 bool for_programs) {
  const bool several = r.heading.size() > 1;
  Report out, signals;
  out.say("{}: {} signals at {} frequencies{}, periods {:.4g} to {:.4g} s", scene.file.filename().string(),
          r.signals.size(), fact("omega_rad_per_s", r.omega, r.omega.size()),
          several ? fmt::format(" and {} headings", r.heading.size()) : "", 2 * std::numbers::pi / r.omega.back(),
          2 * std::numbers::pi / r.omega.front());
  if (several) out.keep("heading_rad", r.heading);
  out.say("{:<24} {}{:>12} {:<7} {:>10} {:>10}", "signal", several ? "heading [deg] " : "", "largest", "unit",
          "at T [s]", "phase [deg]");
  for (const auto& s : r.signals) signals.part(s.name, report_of(s, r, for_programs));
  out.part("signals", std::move(signals));
  if (!r.sections.empty()) out.part("at_rest", report_of(r.sections));
  out.part("error", error_of(r));
  out.sentences("notes", "note: {}", r.notes).sentences("warnings", "{}", r.warnings());
  out.part("", shares.report());
  return out.say("wrote {}", fact("file", file.string()));
}

}  // namespace

void rao(const RaoArguments& arguments, const Console& console) {
  Shares shares;
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.rao.has_value(), scene, "RAOs", "rao = { periods = \"2 s .. 8 s, 61 values\" }");
  if (!arguments.check.empty()) compile::require_no_sections(scene);
  const Path file = checked_output(arguments, ".rao.h5");
  shares.end("reading");
  HowToRespond how{.refine = arguments.refine};
  if (arguments.threads) how.threads = *arguments.threads;
  const compile::Prepared prepared = compile::prepare(scene);
  shares.end("preparing");
  const Responses per_metre = respond(scene, prepared, how);
  std::optional<Responses> over_slope;
  if (arguments.nondimensional) over_slope = over_wave_slope(per_metre, scene.water);
  const Responses& r = over_slope ? *over_slope : per_metre;
  shares.end("answering");
  r.write(file);
  if (arguments.csv) interchange::write_csv(*arguments.csv, interchange::content_of(r));
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(scene, r));
  shares.end("writing");
  Report report = report_of(scene, r, shares, file, console.json);
  if (!arguments.check.empty()) {
    Progress progress(console.err, "runs", console.show_progress);
    const auto cells =
        check_in_time(scene, per_metre, arguments.check_steepness, [&](double done) { progress.update(done); });
    report.part("check", report_of(cells));
    if (arguments.picture) {
      plot::Figure drawn = figure(scene, r);
      mark_runs(cells, r, drawn);
      plot::write_picture(*arguments.picture, drawn);
    }
  }
  tell(report, console);
}

}  // namespace froude
