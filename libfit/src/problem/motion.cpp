#include "fit/problem/motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "motion_channels.hpp"
#include "motion_steps.hpp"
#include "telling.hpp"

namespace fit::motion {
namespace {

SimulationProblem simulated(const Problem& problem) {
  SimulationProblem out;
  for (const Parameter& p : problem.parameters) out.parameters.push_back(p.number);
  out.measured = problem.measured;
  for (const Signal& s : problem.signals) {
    out.deviations.push_back(s.deviation);
    out.periods.push_back(s.period);
  }
  out.whitening = problem.whitening;
  out.confidence = problem.options.confidence;
  out.iterations_reach = problem.options.iterations_reach;
  out.accept_residuals = problem.options.accept_residuals;
  return out;
}

Eigen::VectorXd first_of(const Problem& problem) {
  Eigen::VectorXd out(std::ssize(problem.parameters));
  for (std::size_t k = 0; k < problem.parameters.size(); ++k)
    out[static_cast<Eigen::Index>(k)] = problem.parameters[k].number.first;
  return out;
}

/// "x differs by 0.057 m rms; its deviation is stated as 0.002 m, which allows 0.0026 m"
std::string difference(const Problem& problem, const SimulationFit& fit, std::size_t c) {
  const StatedResiduals& s = fit.stated[c];
  const auto& [name, unit, deviation, period, slope] = problem.signals[c];
  return fmt::format("{} differs by {:.3g} {} rms; its deviation is stated as {:.3g} {}, which allows {:.3g} {}", name,
                     fit.rms[c], unit, s.stated, unit, s.allowed, unit);
}

/// What is too large and was accepted; values are told all the same.
std::vector<std::string> accepted(const Problem& problem, const SimulationFit& fit) {
  std::vector<std::string> out;
  for (std::size_t c = 0; c < problem.signals.size(); ++c)
    if (const StatedResiduals& s = fit.stated[c]; !s.hold())
      out.push_back(
          fmt::format("{}; intervals are made from these residuals, {:.3g} times what is stated, and an error of the "
                      "model is in none of them",
                      difference(problem, fit, c), s.rms / s.stated));
  return out;
}

/// "line[1].damping.linear" as a word: line1_damping_linear.
std::string word_of(std::string key) {
  std::replace_if(
      key.begin(), key.end(), [](char c) { return c == '.' || c == ' '; }, '_');
  std::erase_if(key, [](char c) { return c == '[' || c == ']'; });
  return key;
}

double widest(const std::vector<Eigen::MatrixXd>& bands, std::size_t column) {
  double out = 0;
  for (const auto& band : bands)
    for (const double width : band.col(static_cast<Eigen::Index>(column)))
      if (width > out) out = width;  // NaN where nothing was measured
  return out;
}

/// Which number of a scene it is.
Facts identity_of(const Parameter& p) {
  Facts out{{"key", p.record.empty() ? p.number.name : p.path}, {"unit", p.unit}};
  if (!p.record.empty()) out.emplace_back("record", p.record);
  return out;
}

/// Values of the parameters, and what a scene of motion may include of them.
void add_values(const Problem& problem, const SimulationFit& fit, Report& report) {
  Facts coefficients;
  report.group = "parameter";
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const Coefficient& c = fit.parameters[k];
    const std::string &unit = problem.parameters[k].unit, key = word_of(c.name);
    if (c.value && unit.empty()) coefficients.emplace_back(key, *c.value);
    if (c.value && !unit.empty()) coefficients.emplace_back(key, fmt::format("{:.10g} {}", *c.value, unit));
    Estimate e{c, unit};
    e.key = key;
    e.facts = identity_of(problem.parameters[k]);
    if (c.value && fit.by_likelihood[k])
      e.more = " by its likelihood, which the second derivative does not describe";
    else if (c.value)
      e.more =
          fmt::format(" (if residuals were independent {:.5g} to {:.5g})", c.white_interval.low, c.white_interval.high);
    report.estimates.push_back(std::move(e));
  }
  if (!coefficients.empty()) report.facts.emplace_back("coefficients", std::move(coefficients));
}

Facts facts_of_signal(const Problem& problem, const SimulationFit& fit, std::size_t c) {
  return {{"of", problem.signals[c].name},
          {"unit", problem.signals[c].unit},
          {"rms", fit.rms[c]},
          {"deviation", fit.stated[c].stated},
          {"rms_allowed", fit.stated[c].allowed},
          {"widest_band_of_fit", widest(fit.fit_band, c)},
          {"widest_band_of_sample", widest(fit.sample_band, c)}};
}

/// Residuals of each signal against the deviation that was stated, and the bands.
void add_signals(const Problem& problem, const SimulationFit& fit, Report& report) {
  std::vector<Facts> all;
  for (std::size_t c = 0; c < problem.signals.size(); ++c) {
    report.say("{}", difference(problem, fit, c));
    if (fit.refused.empty()) all.push_back(facts_of_signal(problem, fit, c));
  }
  if (!fit.refused.empty()) return;
  append(report.facts, {{"signal", std::move(all)}, {"samples_in_band", fit.inside}});
  report.say("{:.1f} % of the samples lie in the band in which {:g} % should", 100 * fit.inside,
             100 * problem.options.confidence);
}

/// What is left of one signal, and what a motion explains of it.
struct Explained {
  double rms, part;
  Eigen::Index samples;
};
/// Of the windows from `first` on. (F104)
Explained explained(const std::vector<Eigen::MatrixXd>& measured, const std::vector<Eigen::MatrixXd>& motion,
                    std::size_t first, std::size_t windows, std::size_t signal) {
  double sum = 0, squares = 0, left = 0;
  Eigen::Index n = 0;
  for (std::size_t w = first; w < first + windows; ++w)
    for (Eigen::Index i = 0; i < measured[w].rows(); ++i) {
      const double x = measured[w](i, static_cast<Eigen::Index>(signal));
      if (std::isnan(x)) continue;  // not measured
      ++n, sum += x, squares += x * x;
      left += std::pow(x - motion[w](i, static_cast<Eigen::Index>(signal)), 2);
    }
  const double samples = static_cast<double>(std::max<Eigen::Index>(1, n));
  return {std::sqrt(left / samples), 1 - left / std::max(squares - sum * sum / samples, 1e-300), n};
}

/// "heave differs by 0.0021 m rms, 1.05 times its deviation of 0.002 m; explained 99.31 %"
Report told(const Problem& problem, const std::vector<Eigen::MatrixXd>& motion, std::size_t first,
            std::size_t windows) {
  Report out;
  std::vector<Facts> all;
  for (std::size_t c = 0; c < problem.signals.size(); ++c) {
    const Signal& s = problem.signals[c];
    const Explained e = explained(problem.measured, motion, first, windows, c);
    out.say("{} differs by {:.3g} {} rms, {:.3g} times its deviation of {:.3g} {}; explained {:.2f} %", s.name, e.rms,
            s.unit, e.rms / s.deviation, s.deviation, s.unit, 100 * e.part);
    all.push_back({{"of", s.name},
                   {"unit", s.unit},
                   {"samples", e.samples},
                   {"rms", e.rms},
                   {"deviation", s.deviation},
                   {"explained", e.part}});
  }
  out.facts.emplace_back("signal", std::move(all));
  return out;
}

/// What is left in each of several records.
void add_records(const Problem& problem, const std::vector<Eigen::MatrixXd>& motion, Report& report) {
  if (problem.records.size() < 2) return;
  std::size_t first = 0;
  for (const Record& record : problem.records) {
    Report one = told(problem, motion, first, record.windows);
    one.key = "record";
    one.one_of_many = true;
    one.heading = record.title();
    one.facts.insert(one.facts.begin(), Fact("file", record.source.name()));
    if (!record.name.empty()) one.facts.insert(one.facts.begin(), Fact("name", record.name));
    report.parts.push_back(std::move(one));
    first += record.windows;
  }
}

void add_accepted(const Problem& problem, const SimulationFit& fit, Report& report) {
  const std::vector<std::string> all = accepted(problem, fit);
  report.facts.emplace_back("accepted", all);
  for (const std::string& one : all) report.say("accepted: {}", one);
}

/// "line.damping.linear 0.0123 kg/s"
std::vector<std::string> point(const Problem& problem, const Eigen::VectorXd& at) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    const std::string& unit = problem.parameters[k].unit;
    out.push_back(fmt::format("{} {:.6g}{}{}", problem.parameters[k].number.name, at[static_cast<Eigen::Index>(k)],
                              unit.empty() ? "" : " ", unit));
  }
  return out;
}

/// Where searches ended that did not come to the best one.
void add_other_ends(const Problem& problem, const SeveralStarts& several, Report& report) {
  const auto& best = several.searches[several.best_of];
  std::vector<std::string> ends;
  for (const auto& search : several.searches)
    if (search.cost > 1.01 * best.cost)
      ends.push_back(
          fmt::format("from {} to {}, {} the squares {:.3g} times as large",
                      fmt::join(point(problem, search.first), ", "), fmt::join(point(problem, search.last), ", "),
                      search.ended ? "where it ended with" : "where it gave up with", search.cost / best.cost));
  if (ends.empty()) return;
  report.facts.emplace_back("other_ends", ends);
  for (const std::string& end : ends) report.say("another search went {}", end);
}

void add_starts(const Problem& problem, const SeveralStarts& several, Report& report) {
  report.facts.emplace_back("starts", Facts{{"tried", several.tried},
                                            {"agree", several.agree},
                                            {"failed", several.failed},
                                            {"unended", several.unended}});
  report.say("of {} starts {} came there, {} had no motion to follow, {} came to no end", several.tried, several.agree,
             several.failed, several.unended);
  if (!problem.options.starts)
    report.say("the others were begun since the first, at {}, gave nothing to tell",
               fmt::join(point(problem, first_of(problem)), ", "));
  add_other_ends(problem, several, report);
}

/// "pair.csv: 300 samples of 2 signals in 1 window"
std::string heading_of(const Problem& problem) {
  Eigen::Index samples = 0;
  for (const Eigen::MatrixXd& window : problem.measured) samples += window.rows();
  std::vector<std::string> names;
  for (const Record& record : problem.records) names.push_back(record.title());
  return fmt::format("{}: {} samples of {} signals in {} window{}", fmt::join(names, ", "), samples,
                     problem.signals.size(), problem.measured.size(), problem.measured.size() == 1 ? "" : "s");
}

Report told(const Problem& problem, const SimulationFit& fit) {
  const bool values = fit.refused.empty();
  Report report{.heading = fmt::format("{}, {} runs of a window", heading_of(problem), fit.windows_followed),
                .facts = {{"search", fit.search.why}}};
  if (values) add_values(problem, fit, report);
  add_signals(problem, fit, report);
  if (values) add_accepted(problem, fit, report);
  add_records(problem, fit.motion, report);
  if (fit.starts_all > 0)
    report.say("of {} numbers of the windows' starts the signals see {}, which are fitted too", fit.starts_all,
               fit.starts_seen);
  if (values) {
    append(report.facts, {{"weakest", fit.weakest}, {"singular_values", fit.singular_values}});
    report.say("singular values {:.3g}; {}", fmt::join(fit.singular_values, ", "), fit.weakest);
  }
  report.say("search: iterations {}, {}", fit.search.iterations, fit.search.why);
  report.warn(fit.caution);
  return report;
}

/// (F65), (F66) Nothing is told but what stands against it.
std::optional<Refusal> refusal_of(const Problem& problem, const SimulationFit& fit, const std::string& trouble,
                                  const std::string& trouble_of_steps) {
  if (fit.refused.empty()) return {};
  std::string more;
  for (std::size_t c = 0; c < problem.signals.size(); ++c)
    if (!fit.stated[c].hold()) more += "; " + difference(problem, fit, c);
  for (const std::string& one : {trouble, trouble_of_steps})
    if (!one.empty()) more += "; " + one;
  const std::vector<std::string> best = point(problem, fit.end.unknowns);
  if (!fit.search.ended())
    return Refusal{.reason = Refusal::Reason::search_without_end,
                   .why = fmt::format("no value is told: the search has no end: {}{}", why_unended(fit.search), more),
                   .best_point = best};
  return Refusal{.reason = Refusal::Reason::residuals_too_large,
                 .why = "no value is told: the search ended, but not at the motion that was measured" + more,
                 .best_point = best};
}

/// Intervals by the likelihood of each parameter that has a value and an error.
/// (F105) What one channel larger by ε does to the parameters, to first order and per ε: the search's own step there.
Eigen::VectorXd sensitivity(const Problem& problem, const SimulationFit& fit, Eigen::Index channel) {
  const Eigen::MatrixXd& jacobian = fit.end.jacobian;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(jacobian.rows());
  Eigen::Index row = 0;
  for (const Eigen::MatrixXd& measured : problem.measured) {
    change.segment(row + channel * measured.rows(), measured.rows()) =
        measured.col(channel) / problem.signals[static_cast<std::size_t>(channel)].deviation;
    row += measured.size();
  }
  std::vector<Eigen::Index> seen;
  for (std::size_t j = 0; j < fit.search.identifiable.size(); ++j)
    if (fit.search.identifiable[j]) seen.push_back(static_cast<Eigen::Index>(j));
  Eigen::VectorXd out = Eigen::VectorXd::Zero(jacobian.cols());
  if (!seen.empty()) out(seen) = hydro::dense::HouseholderQr(Eigen::MatrixXd(jacobian(Eigen::all, seen))).solve(change);
  return out;
}

void count_slopes(const Problem& problem, SimulationFit& fit) {
  if (!fit.refused.empty()) return;
  for (std::size_t c = 0; c < problem.signals.size(); ++c) {
    if (problem.signals[c].slope.standard == 0) continue;
    const Eigen::VectorXd change = sensitivity(problem, fit, static_cast<Eigen::Index>(c));
    for (std::size_t k = 0; k < fit.parameters.size(); ++k)
      count_slope(problem.signals[c].slope, change[static_cast<Eigen::Index>(k)], fit.parameters[k]);
  }
}

void add_profiles(const Problem& problem, const SimulationProblem& simulated, const SimulationFit& fit,
                  const std::optional<StepError>& steps, Report& report) {
  try {
    for (std::size_t k = 0; k < report.estimates.size(); ++k)
      if (const Coefficient& c = fit.parameters[k]; c.value && c.standard_error > 0) {
        const Interval own = profile_interval(*problem.simulation, simulated, fit, k);
        report.estimates[k].profile = steps ? with_steps(*steps, k, own) : own;
      }
  } catch (const hydro::NumericsError& e) {
    report.refused = {Refusal::Reason::profile_without_an_end, e.what()};
  }
}

}  // namespace

Solution solve(const Problem& problem) {
  const SimulationProblem search = simulated(problem);
  const Options& options = problem.options;
  const SteppedSearch found = search_with_steps(problem, search);
  const SeveralStarts& several = found.several;
  Solution out{.report = {}, .fit = several.best, .trouble = {}};
  // Errors that channels share would be another matter once two of them are exchanged.
  if (!out.fit.refused.empty() && problem.whitening.empty())
    out.trouble = trouble_of_channels(problem, search, out.fit);
  count_slopes(problem, out.fit);
  if (found.error) count_steps(*found.error, out.fit);
  out.report = told(problem, out.fit);
  tell_steps(problem, found, out.report);
  if (several.tried > 1) add_starts(problem, several, out.report);
  out.report.refused = refusal_of(problem, out.fit, out.trouble, trouble_of_steps(found));
  if (out.report.refused || !options.profile) return out;
  // Profiles need the windows as the search of the fit handed them on.
  if (several.best_of + 1 < several.searches.size() && !found.last_in_windows)
    out.fit = searched_again(problem, search, several);
  add_profiles(problem, search, out.fit, found.error, out.report);
  return out;
}

Prediction predict(const Problem& problem, const Eigen::VectorXd& at, const std::vector<std::string>& from) {
  hydro::require(std::ssize(problem.parameters) == at.size() && problem.parameters.size() == from.size(),
                 "{} parameters have {} values from {} places", problem.parameters.size(), at.size(), from.size());
  Prediction out{.report = {}, .motion = follow_all(*problem.simulation, simulated(problem), at)};
  out.report = told(problem, out.motion, 0, problem.measured.size());
  out.report.heading = heading_of(problem) + "; nothing is fitted";
  std::vector<Facts> parameters;
  std::vector<std::string> remarks;
  const std::vector<std::string> values = point(problem, at);
  for (std::size_t k = 0; k < from.size(); ++k) {
    Facts one = identity_of(problem.parameters[k]);
    append(one, {{"value", at[static_cast<Eigen::Index>(k)]}, {"from", from[k]}});
    parameters.push_back(std::move(one));
    remarks.push_back(fmt::format("{}, from {}", values[k], from[k]));
  }
  out.report.remarks.insert(out.report.remarks.begin(), remarks.begin(), remarks.end());
  if (!parameters.empty()) out.report.facts.emplace_back("parameter", std::move(parameters));
  add_records(problem, out.motion, out.report);
  return out;
}

}  // namespace fit::motion
