#include "decay_report.hpp"

#include <cmath>

#include "fit/runs.hpp"
#include "fit/verdict.hpp"
#include "telling.hpp"

namespace fit::decay {
namespace {

Estimate in_units(const Coefficient& c, bool turns) { return {c, unit_of(c.name, turns)}; }
Estimate in_units_with_mass(const Coefficient& c, bool turns) { return {c, unit_with_mass(c.name, turns)}; }

/// Added mass and damping that belong to the natural period of the fit without a memory.
Report told(const AddedMass& water, bool turns) {
  Report report{.key = "water"}, damping{.key = "damping"};
  report.heading = fmt::format("  at {:.4g} rad/s, with the body's mass and stiffness:", water.omega);
  report.facts = {{"omega_rad_s", water.omega}};
  report.estimates = {in_units_with_mass(water.added_mass, turns)};
  for (const Coefficient& c : water.damping) damping.estimates.push_back(in_units_with_mass(c, turns));
  report.parts = {std::move(damping)};
  return report;
}

/// By the memory at the frequency of the swing.
Report told_swing(const DecayRadiation& r, bool turns) {
  return {.key = "swing",
          .heading = fmt::format("  by the memory at {:.4g} rad/s:", r.omega),
          .facts = {{"omega_rad_s", r.omega}},
          .estimates = {in_units_with_mass(r.added_mass, turns), in_units_with_mass(r.damping, turns)}};
}

/// By the memory at infinite frequency, where damping is that of the linear term, which is told already.
Report told_limit(const DecayRadiation& r, bool turns) {
  Report report{.key = "limit", .heading = "  and at infinite frequency:"};
  report.estimates = {in_units_with_mass(r.damping, turns), in_units_with_mass(r.added_mass, turns)};
  report.estimates[0].in_words = true;
  return report;
}

Report told_memory(const FittedRun& run, bool turns) {
  const DecayMemoryFit& m = *run.memory;
  const SearchReport& search = m.motion.search;
  Report report{.key = "memory"};
  report.heading = fmt::format(
      "  with a memory of the water in place of a constant damping: swings at {:.4g} rad/s, decays by {:.4g}/s; "
      "residual {:.3g} rms; AICc lower by {:.4g} than without",
      m.omega, m.rate, m.motion.rms[0], m.gain);
  report.facts = {{"omega_rad_s", m.omega},
                  {"rate_1_s", m.rate},
                  {"residual_rms", m.motion.rms[0]},
                  {"aicc_gained", m.gain},
                  {"weakest", m.weakest},
                  {"identifiability", search.identifiability},
                  {"singular_values", m.singular_values}};
  for (const auto* group : {&m.memory, &m.damping})
    for (const Coefficient& c : *group) report.estimates.push_back(in_units(c, turns));
  if (m.singular_values.size() > 0)
    report.say("singular values of the parameters over their errors {:.3g}; {}", fmt::join(m.singular_values, ", "),
               m.weakest);
  report.say("search: iterations {}, {}; {}", search.iterations, search.why, search.identifiability);
  report.warn(m.motion.caution);
  if (run.swing) report.parts = {told_swing(*run.swing, turns), told_limit(*run.limit, turns)};
  return report;
}

/// How large the residual is of a record, or of several together.
std::string heading_of(const FittedRun& run, bool turns) {
  const ShootingFit& m = run.fit.motion;
  const auto& amplitude = run.decrement.amplitude;
  const std::string of =
      run.alone()
          ? fmt::format("{}: {}residual {:.3g} rms", run.name(),
                        !run.decrement.ratio.empty()
                            ? fmt::format("{} half cycles from {:.4g} to {:.4g} {}, ", amplitude.size(),
                                          amplitude.front(), amplitude.back(), turns ? "rad" : "m")
                            : "",
                        m.rms[0])
          : fmt::format("{} runs with one set of coefficients: residual {:.3g} rms", run.records.size(), m.rms[0]);
  return of + fmt::format(", {:.4g} % of the variance explained", 100 * m.explained[0]);
}

Report begun(const FittedRun& run, bool turns) {
  const ShootingFit& m = run.fit.motion;
  Report report{.key = run.alone() ? "run" : "together", .one_of_many = run.alone(), .heading = heading_of(run, turns)};
  report.facts = {{"file", run.name()},
                  {"residual_rms", m.rms[0]},
                  {"explained", m.explained[0]},
                  {"search", m.search.why},
                  {"identifiability", m.search.identifiability}};
  add_labels(report, run.source);
  Facts energy;
  for (const Coefficient& c : run.fit.energy.damping) energy.emplace_back(c.name, *c.value);
  if (!energy.empty()) report.facts.emplace_back("energy", std::move(energy));
  return report;
}

/// What extremes alone tell.
void add_energy(const FittedRun& run, Report& report) {
  const Decrement& d = run.decrement;
  if (d.ratio.empty() || run.fit.energy.damping.empty()) {
    report.say("too few swings stand out of the noise for a decrement, or for the energy that they lose");
    return;
  }
  append(report.facts, {{"decrement_ratio", d.ratio}, {"decrement_amplitude", d.amplitude}});
  std::string by_energy;
  for (const Coefficient& c : run.fit.energy.damping) by_energy += fmt::format(" {} {:.4g}", c.name, *c.value);
  report.say("damping ratio by decrement {:.4g} in the first half cycle, {:.4g} in the last; by energy:{}",
             d.ratio.front(), d.ratio.back(), by_energy);
}

void add_variants(const FittedRun& run, Report& report) {
  add_rows(report, "variant", run.variants, [&](const Variant& v) {
    Facts facts{{"with", v.what}};
    if (!v.why_not.empty()) facts.emplace_back("why_not", v.why_not);
    std::string changes = v.why_not.empty() ? "" : "cannot be fitted: " + v.why_not;
    for (std::size_t k = 0; k < v.changes.size(); ++k) {
      const std::string name = k == 0 ? "period" : run.fit.damping[k - 1].name;
      facts.emplace_back(name, v.changes[k]);
      changes += fmt::format("{}{} {:+.1f} errors", k > 0 ? ", " : "", name, v.changes[k]);
    }
    return std::pair{facts, fmt::format("with {}: {}", v.what, changes)};
  });
}

/// How well the terms fit, to compare them on this record, and the bands about the motion.
void add_quality(const FittedRun& run, double confidence, Report& report) {
  const ShootingFit& m = run.fit.motion;
  if (std::isfinite(run.fit.aicc)) report.facts.emplace_back("aicc", run.fit.aicc);
  if (std::isfinite(run.fit.bic)) report.facts.emplace_back("bic", run.fit.bic);
  report.facts.emplace_back("independent_samples", run.fit.independent);
  report.say(
      "AICc {:.1f}, BIC {:.1f}, of {:.0f} independent samples whatever the terms (to compare terms on this record); "
      "halving the steps changes {:.1g} % of the amplitude",
      run.fit.aicc, run.fit.bic, run.fit.independent, m.integration_error);
  if (!m.fit_band.empty()) {
    append(report.facts, {{"samples_in_band", m.inside},
                          {"widest_band_of_fit", m.fit_band[0].maxCoeff()},
                          {"widest_band_of_sample", m.sample_band[0].maxCoeff()}});
    report.say("{:.1f} % of the samples lie in the band in which {:g} % should", 100 * m.inside, 100 * confidence);
  }
  report.say("search: iterations {}, {}; {}", m.search.iterations, m.search.why, m.search.identifiability);
}

/// (F78)
void add_halves(double apart, Report& report) {
  report.facts.emplace_back("halves_apart", apart);
  report.say("{}both halves of the record tell values that are {:.2g} times as far apart as chance allows",
             apart < 1 ? "" : "accepted: ", apart);
}

/// (F79) Terms that would feed the motion; with others beside them that brake it, so that no value is kept back.
std::string caution_of_negative_terms(const FittedRun& run) {
  std::vector<std::string> negative;
  for (const Coefficient& c : run.fit.damping)
    if (c.value && c.interval.high < 0)
      negative.push_back(fmt::format("{} ({:.3g} to {:.3g})", c.name, c.interval.low, c.interval.high));
  if (negative.empty()) return {};
  return fmt::format(
      "{} comes out negative, with its whole interval: still water and friction take energy from a motion. Another "
      "term acts than those asked for, and the values of all of them make up for it: ask for another (coulomb for "
      "losses that do not fall with the swings, linear or quadratic for those that do)",
      fmt::join(negative, ", "));
}

Report told(const Problem& problem, const FittedRun& run) {
  const bool turns = problem.turns;
  Report report = begun(run, turns);
  report.estimates = {in_units(run.fit.period, turns)};
  for (std::size_t k = 0; k < run.fit.damping.size(); ++k) {
    report.estimates.push_back(in_units(run.fit.damping[k], turns));
    if (k < run.profiles.size()) report.estimates.back().profile = run.profiles[k];
  }
  if (run.fit.motion.explained[0] < least_explained)
    report.say(
        "accepted: less than {:g} % is explained; intervals are made from what is left, and an error of the model is "
        "in none of them",
        100 * least_explained);
  if (run.halves) add_halves(*run.halves, report);
  for (const std::string& name : run.by_likelihood)
    report.say("the interval of {} is that of its likelihood, which the second derivative does not describe", name);
  if (run.alone()) add_energy(run, report);
  add_quality(run, problem.options.motion.confidence, report);
  add_variants(run, report);
  if (run.left) add_residuals(report, *run.left);
  if (run.alone()) report.steps = run.records[0].steps;
  if (run.alone()) report.cautions = run.records[0].cautions;
  report.warn(run.fit.motion.caution);
  report.warn(caution_of_negative_terms(run));
  if (run.water) report.parts.push_back(told(*run.water, turns));
  if (run.memory) report.parts.push_back(told_memory(run, turns));
  return report;
}

/// Each coefficient over three runs and more that were fitted alone, those that cannot tell it from zero among them.
Report told_over(const Problem& problem, const std::vector<FittedRun>& runs) {
  Report report{.key = "over_runs"};
  if (runs.size() < 3) return report;
  const double confidence = problem.options.motion.confidence;
  const auto add = [&](const std::string& name, const auto& coefficient_of) {
    std::vector<Coefficient> estimates;
    for (const FittedRun& run : runs)
      if (const Coefficient& c = coefficient_of(run); c.standard_error > 0) estimates.push_back(c);
    if (estimates.size() == runs.size())
      report.parts.push_back(over_runs(name, unit_of(name, problem.turns),
                                       together(estimates, files_of(runs), confidence), "run", runs.size(),
                                       confidence));
  };
  add("period", [](const FittedRun& run) -> const Coefficient& { return run.fit.period; });
  for (std::size_t k = 0; k < runs[0].fit.damping.size(); ++k)
    add(runs[0].fit.damping[k].name, [k](const FittedRun& run) -> const Coefficient& { return run.fit.damping[k]; });
  return report;
}

/// What a scene of motion may include, of one run or of all together.
Facts coefficients_of(const FittedRun& run, bool turns) {
  Facts out;
  const auto put = [&](const Coefficient& c) {
    if (c.value) out.emplace_back(c.name, *c.value);
  };
  put(run.fit.period);
  for (const Coefficient& c : run.fit.damping) put(c);
  if (run.water) put(run.water->added_mass);
  if (run.water)
    for (const Coefficient& c : run.water->damping)
      if (c.value)
        out.emplace_back(c.name + "_damping", fmt::format("{:.10g} {}", *c.value, unit_with_mass(c.name, turns)));
  if (!run.memory) return out;
  for (const Coefficient& c : run.memory->memory) put(c);
  return out;
}

/// The same of several runs, each coefficient in their middle.
Facts coefficients_over(const Report& over) {
  Facts out;
  for (const Report& law : over.parts) out.emplace_back(law.key, *find(law.facts, "value"));
  return out;
}

}  // namespace

const char* unit_of(const std::string& coefficient, bool turns) {
  if (coefficient == "linear" || coefficient == "memory_decay") return "1/s";
  if (coefficient == "memory_strength") return "1/s^2";
  if (coefficient == "memory_frequency") return "rad/s";
  if (coefficient == "quadratic") return turns ? "1/rad" : "1/m";
  if (coefficient == "cubic") return turns ? "s/rad^2" : "s/m^2";
  if (coefficient == "period") return "s";
  return turns ? "rad/s^2" : "m/s^2";
}

const char* unit_with_mass(const std::string& coefficient, bool turns) {
  if (coefficient == "added_mass") return turns ? "kg m^2" : "kg";
  if (coefficient == "linear" || coefficient == "damping") return turns ? "N m s/rad" : "N s/m";
  if (coefficient == "quadratic") return turns ? "N m s^2/rad^2" : "N s^2/m^2";
  if (coefficient == "cubic") return turns ? "N m s^3/rad^3" : "N s^3/m^3";
  return turns ? "N m" : "N";
}

Report told(const Problem& problem, const std::vector<FittedRun>& runs, const std::optional<FittedRun>& together) {
  Report report, over = told_over(problem, runs);
  if (together || runs.size() == 1)
    report.facts = {{"coefficients", coefficients_of(together ? *together : runs[0], problem.turns)}};
  else if (!over.parts.empty())
    report.facts = {{"coefficients", coefficients_over(over)}};
  for (const FittedRun& run : runs) report.parts.push_back(told(problem, run));
  if (together) report.parts.push_back(told(problem, *together));
  if (!over.parts.empty()) report.parts.push_back(std::move(over));
  return report;
}

}  // namespace fit::decay
