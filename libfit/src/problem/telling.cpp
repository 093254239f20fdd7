#include "telling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hydro/signal/distributions.hpp"

namespace fit {

void require_within_half_a_turn(const std::vector<double>& angle) {
  const double mean = std::accumulate(angle.begin(), angle.end(), 0.0) / static_cast<double>(angle.size());
  double farthest = 0;
  for (const double a : angle) farthest = std::max(farthest, std::abs(a - mean));
  if (farthest > std::numbers::pi)
    throw hydro::InputError(
        fmt::format("the angle goes {:.4g} rad from its mean, more than half a turn: a body that swings does not",
                    farthest),
        {}, "look at the unit in the header: numbers in degrees need [deg]");
}

Refusal drives_the_motion(const std::string& what, const Source& source) {
  return {.reason = Refusal::Reason::wrong_sign,
          .why = fmt::format("{}, as if the water drove the motion: the force or the motion has the wrong sign, they "
                             "stand in each other's place, or one of them is recorded late",
                             what),
          .source = source.file.string()};
}

Report begin_run(const Source& source) {
  return {.key = "run", .one_of_many = true, .facts = {{"file", source.name()}}};
}

void add_labels(Report& report, const Source& source) {
  if (source.labels.empty()) return;
  Facts labels;
  for (const auto& [name, value] : source.labels) labels.emplace_back(name, value);
  report.facts.emplace_back("labels", std::move(labels));
}

void add_residuals(Report& report, const ResidualReport& left, const std::string& unit) {
  std::string large;
  std::vector<double> amplitudes;
  for (const auto& h : left.harmonics) {
    amplitudes.push_back(h.amplitude);
    if (!unit.empty() && h.relative > 0.01)
      large += fmt::format("{}{} ({:.2g} {})", large.empty() ? "" : ", ", h.number, h.amplitude, unit);
  }
  report.say(
      "residuals: {:.0f} % of their variance in harmonics{}; neighbouring fortieths of a period correlate by {:.2f} "
      "(white with p = {:.2g})",
      100 * left.harmonic_share, large.empty() ? "" : ", above 1 % of the force in number " + large, left.lag_one,
      left.ljung_box_p);
  Facts facts{{"harmonic_share", left.harmonic_share}, {"lag_one", left.lag_one}, {"ljung_box_p", left.ljung_box_p}};
  if (!unit.empty()) facts.emplace_back("harmonic_amplitudes_" + unit, amplitudes);
  report.facts.emplace_back("residuals", std::move(facts));
}

RandomEffects together(const std::vector<Coefficient>& of, const std::vector<std::string>& files, double confidence,
                       bool sizes) {
  hydro::ensure(files.size() == of.size(), "each run has a file");
  std::vector<RunEstimate> runs;
  double common = 0;
  for (const Coefficient& c : of) {
    const double value = sizes ? std::abs(middle(c)) : middle(c);
    const double own =
        std::sqrt(std::max(0.0, c.standard_error * c.standard_error - c.systematic_error * c.systematic_error));
    runs.push_back({value, own, 0, 0, 0, files[runs.size()]});
    common += c.systematic_error / static_cast<double>(of.size());
  }
  RandomEffects law = fit_runs(runs, Law::constant, confidence);
  const double mean = law.coefficients[0], same = common * hydro::signal::normal_quantile((1 + confidence) / 2);
  for (Interval* i : {&law.intervals[0], &law.prediction})
    *i = {mean - std::hypot(mean - i->low, same), mean + std::hypot(i->high - mean, same)};
  return law;
}

Report over_runs(const std::string& name, const std::string& unit, const RandomEffects& law, const std::string& runs,
                 std::size_t count, double confidence) {
  Report out{.key = name};
  out.heading = fmt::format(
      "{} over {} {}s: {:.4g}{}{}, {:g} % interval {:.4g} to {:.4g}; from {} to {} ±{:.2g}; the next between {:.4g} "
      "and {:.4g}",
      name, count, runs, law.coefficients[0], unit.empty() ? "" : " ", unit, 100 * confidence, law.intervals[0].low,
      law.intervals[0].high, runs, runs, law.between, law.prediction.low, law.prediction.high);
  out.facts = {{"value", law.coefficients[0]},
               {"interval", law.intervals[0]},
               {"between_" + runs + "s", law.between},
               {"prediction", law.prediction}};
  return out;
}

}  // namespace fit
