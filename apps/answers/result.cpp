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

std::vector<std::string> Run::warnings() const {
  if (std::abs(worst_residual.energy) <= tolerated_residual * turnover()) return {};
  return {
      fmt::format("warning: the energy residual is {:.2g} of the energy turned over at {:.5g} s: the step of {:.4g} s "
                  "is too long for "
                  "what moves; compare with a run of half the step, [solve] step = \"{:.6g} s\"",
                  relative_residual(), worst_residual.time, step, step / 2)};
}

void Run::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  p.energy = energy;
  p.wall_time = {{"preparation", preparation_s}, {"stepping", stepping_s}};
  p.settings.emplace_back("chosen.step", fmt::format("{} s", step));
  for (const auto& [effect, count] : evaluations)
    p.settings.emplace_back("evaluations." + effect, std::to_string(count));
  for (const Snaps& s : snaps) p.settings.emplace_back("snaps." + s.line, sentence(s));
  for (const LineExponent& e : exponents) p.settings.emplace_back("lyapunov." + e.line, sentence(e));
  add_notes(notes, p);
  for (const auto& warning : warnings()) p.notes.emplace_back("warning", warning);
  if (!stopped.empty()) p.notes.emplace_back("stopped", stopped);
  write_run(path, time, signals, p);
}

const ComplexSignal& Responses::signal(const std::string& name) const {
  return named(signals, name, "[ask.rao] gives");
}

void Responses::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  add_notes(notes, p);
  write_rao(path, omega, heading, signals, p);
}

void WaterSeries::write(const std::filesystem::path& path) const {
  Provenance p = provenance;
  p.settings.emplace_back("chosen.synthesis", method);
  add_notes(notes, p);
  write_run(path, time, signals, p);
}

double Modes::period(std::size_t mode) const { return 2 * std::numbers::pi / omega[mode]; }

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
