#include "froude/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/provenance.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// The signal of a name. \throws InputError with those that there are
template <class S>
const S& named(const std::vector<S>& signals, const std::string& name, const std::string& whose) {
  std::vector<std::string> names;
  for (const S& s : signals) {
    if (s.name == name) return s;
    names.push_back(s.name);
  }
  throw hydro::InputError(fmt::format("{} no signal \"{}\"", whose, name), {},
                          fmt::format("signals are: {}", fmt::join(names, ", ")));
}

double entry(const std::vector<std::pair<std::string, double>>& entries, const std::string& name) {
  for (const auto& [key, value] : entries)
    if (key == name) return value;
  return 0;
}

/// More of the energy turned over than the residual of sound runs; a motion whose energies are that far off is no
/// answer.
constexpr double tolerated_residual = 0.02;

}  // namespace

std::string sentence(const Snaps& s) {
  return fmt::format("{}: slack {:.3g} % of the time, {} snap{}, largest tension {:.5g} N in link {} at {:.5g} s",
                     s.line, 100 * s.slack_share, s.snaps, s.snaps == 1 ? "" : "s", s.largest_tension, s.link, s.at);
}

std::string sentence(const LineExponent& of) {
  const dynamics::Exponent& e = of.exponent;
  return fmt::format(
      "{}: largest Lyapunov exponent {:.4g} +- {:.2g} 1/s from {:.5g} to {:.5g} s; a regular motion would show up to "
      "{:.2g} 1/s{}",
      of.line, e.value, e.error, e.from, e.to, e.regular,
      e.has_lasted() ? ""
                     : fmt::format("; the error is too small, since blocks resemble their neighbours (correlation "
                                   "{:.2g}): let it run longer",
                                   e.block_correlation));
}

const std::vector<double>& Run::signal(const std::string& name) const {
  return named(signals, name, "the run has").values;
}

double Run::turnover() const { return entry(energy, "turnover"); }

double Run::relative_residual() const { return turnover() > 0 ? std::abs(worst_residual.energy) / turnover() : 0; }

double ErrorEstimate::total(std::size_t signal) const {
  double out = 0;
  for (const Source& source : sources) out += source.of_signal[signal];
  return out;
}

std::size_t ErrorEstimate::worst() const {
  std::size_t out = 0;
  const std::size_t signals = sources.empty() ? 0 : sources.front().of_signal.size();
  for (std::size_t i = 1; i < signals; ++i)
    if (total(i) > total(out)) out = i;
  return out;
}

const ErrorEstimate::Source& ErrorEstimate::largest_source(std::size_t signal) const {
  return *std::max_element(sources.begin(), sources.end(),
                           [&](const Source& a, const Source& b) { return a.of_signal[signal] < b.of_signal[signal]; });
}

namespace {

/// `of`: " of its peak", or nothing for rms.
template <class S>
std::string accuracy_of(const ErrorEstimate& error, const std::vector<S>& signals, const char* of) {
  if (error.asked == 0 || signals.empty()) return "";
  const std::string asked = fmt::format("accuracy asked {:.2g}, ", error.asked);
  if (!error.missing.empty()) return asked + "not estimated: " + error.missing;
  if (error.sources.empty()) return "";
  const std::size_t worst = error.worst();
  return fmt::format("{}estimated {:.2g}{} ({}), {} the {}{}", asked, error.total(worst), of, signals[worst].name,
                     error.sources.size() > 1 ? "most of it from" : "by", error.largest_source(worst).name,
                     error.unpredictable.empty() ? "" : ", for as long as signals can be predicted");
}

constexpr std::size_t told_by_name = 4;  // signals; results have each

/// ", m1.heave by 0.02, m2.heave by 0.01, and 12 more"
std::string listed(const std::vector<std::string>& all) {
  std::string out;
  for (std::size_t i = 0; i < std::min(told_by_name, all.size()); ++i) out += ", " + all[i];
  return all.size() > told_by_name ? fmt::format("{}, and {} more", out, all.size() - told_by_name) : out;
}

/// What the scene gives keeps a signal from the accuracy asked: its largest part in that.
std::string share_of_given(const ErrorEstimate& e, std::size_t signal) {
  const ErrorEstimate::Source* largest = nullptr;
  for (const auto& source : e.sources)
    if (source.given && (!largest || source.of_signal[signal] > largest->of_signal[signal])) largest = &source;
  if (!largest) return fmt::format("most of it from the {}", e.largest_source(signal).name);
  if (largest == &e.largest_source(signal))
    return fmt::format("most of it from the {} that the scene gives", largest->name);
  return fmt::format("{:.2g} of it from the {} that the scene gives", largest->of_signal[signal], largest->name);
}

/// Of signals that are off by more than was asked, which the scene takes.
template <class S>
std::string warning_of_error(const ErrorEstimate& e, const std::vector<S>& signals, const char* of) {
  if (e.sources.empty() || e.total(e.worst()) <= e.asked) return "";
  std::vector<std::string> others;
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (i != e.worst() && e.total(i) > e.asked)
      others.push_back(fmt::format("{} by {:.2g}", signals[i].name, e.total(i)));
  const std::string why = e.accepted ? "which the scene accepts" : share_of_given(e, e.worst());
  return fmt::format("warning: {} is off by an estimated {:.2g} of its {}, {}{}", signals[e.worst()].name,
                     e.total(e.worst()), of, why, listed(others));
}

/// Of energy that comes from nowhere, or goes there.
std::string warning_of_residual(const Run& run) {
  if (std::abs(run.worst_residual.energy) <= tolerated_residual * run.turnover()) return "";
  return fmt::format(
      "warning: the energy residual is {:.2g} of the energy turned over at {:.5g} s: the step of {:.4g} s is too long "
      "for what moves; compare with a run of half the step, [solve] step = \"{:.6g} s\"",
      run.relative_residual(), run.worst_residual.time, run.step, run.step / 2);
}

/// Of signals that no step can predict.
std::string warning_of_prediction(const Run& run) {
  std::vector<ErrorEstimate::Unpredictable> lost = run.error.unpredictable;
  if (lost.empty()) return "";
  std::stable_sort(lost.begin(), lost.end(), [](const auto& a, const auto& b) { return a.until < b.until; });
  std::vector<std::string> others;
  for (std::size_t i = 1; i < lost.size(); ++i)
    others.push_back(fmt::format("{} until {:.4g} s", run.signals[lost[i].signal].name, lost[i].until));
  const auto& first = lost.front();
  const Signal& s = run.signals[first.signal];
  return fmt::format(
      "warning: {} can be predicted until {:.4g} s only, since neighbouring motions part{}; beyond, statistics can be "
      "told: {} has a standard deviation of {:.3g} {}, which differs between runs by {:.2g}",
      s.name, first.until, listed(others), s.name, first.deviation, s.units, first.scatter);
}

std::string warning_of_unseen(const ErrorEstimate& e) {
  return e.unseen.empty() ? "" : fmt::format("warning: no error is estimated of {}", fmt::join(e.unseen, "; "));
}

}  // namespace

std::string Run::accuracy() const { return accuracy_of(error, signals, ""); }

std::string Responses::accuracy() const { return accuracy_of(error, signals, " of the peak"); }

std::vector<std::string> Responses::warnings() const {
  std::vector<std::string> out;
  for (std::string warning : {warning_of_error(error, signals, "peak"), warning_of_unseen(error)})
    if (!warning.empty()) out.push_back(std::move(warning));
  return out;
}

std::vector<std::string> Run::warnings() const {
  std::vector<std::string> out;
  for (std::string warning :
       {warning_of_residual(*this), warning_of_error(error, signals, "rms, standard deviation or extreme"),
        warning_of_prediction(*this), warning_of_unseen(error)})
    if (!warning.empty()) out.push_back(std::move(warning));
  return out;
}

void Run::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  p.energy = energy;
  p.wall_time = {{"preparation", preparation_s}, {"stepping", stepping_s}, {"estimating", estimating_s}};
  p.settings.emplace_back("chosen.step", fmt::format("{} s", step));
  for (const auto& [effect, count] : evaluations)
    p.settings.emplace_back("evaluations." + effect, std::to_string(count));
  for (const Snaps& s : snaps) p.settings.emplace_back("snaps." + s.line, sentence(s));
  for (const LineExponent& e : exponents) p.settings.emplace_back("lyapunov." + e.line, sentence(e));
  add_notes(notes, p);
  add_notes(warnings(), p, "warning");
  if (!stopped.empty()) p.notes.emplace_back("stopped", stopped);
  if (const std::string told = accuracy(); !told.empty()) p.settings.emplace_back("estimated.accuracy", told);
  write_run(path, time, signals, p, error);
}

const ComplexSignal& Responses::signal(const std::string& name) const {
  return named(signals, name, "[ask.rao] gives");
}

void Responses::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  add_notes(notes, p);
  add_notes(warnings(), p, "warning");
  if (const std::string told = accuracy(); !told.empty()) p.settings.emplace_back("estimated.accuracy", told);
  write_rao(path, omega, heading, signals, p, error, sections);
}

void WaterSeries::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  p.settings.emplace_back("chosen.synthesis", method);
  add_notes(notes, p);
  write_run(path, time, signals, p);
}

double Modes::period(std::size_t mode) const { return 2 * std::numbers::pi / omega[mode]; }

std::optional<double> Modes::damped_period(std::size_t mode) const {
  if (std::isnan(s[mode].real())) return std::nullopt;
  return 2 * std::numbers::pi / std::abs(s[mode].imag());
}

std::optional<double> Modes::damping_ratio(std::size_t mode) const {
  if (std::isnan(s[mode].real())) return std::nullopt;
  return -s[mode].real() / std::abs(s[mode]);
}

std::span<const double> Modes::shape_of(std::size_t mode) const {
  return std::span(shape).subspan(mode * motions.size(), motions.size());
}

void Modes::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  add_notes(notes, p);
  write_modes(path, *this, p);
}

}  // namespace froude
