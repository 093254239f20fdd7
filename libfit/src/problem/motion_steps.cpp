#include "motion_steps.hpp"

#include <algorithm>
#include <cmath>

namespace fit::motion {
namespace {

// Steps of a 64th take 64 times as long. The order of an error is not seen yet where steps are long, so that more than
// an eighth is not taken in one go.
constexpr int most_divided = 64, most_at_once = 8;

SeveralStarts searched(const Problem& problem, const SimulationProblem& search) {
  const Options& options = problem.options;
  return options.starts.value_or(1) > 1
             ? fit_simulation_from(*problem.simulation, search, *options.starts)
             : fit_simulation_insisting(*problem.simulation, search, options.starts ? 0 : starts_after_failure);
}

/// The error of the steps, of the windows as the best search handed them on.
void look_at_steps(const Problem& problem, const SimulationProblem& search, SteppedSearch& found) {
  SeveralStarts& several = found.several;
  const bool others_after = several.best_of + 1 < several.searches.size();
  if (several.best.starts_all > 0 && others_after && !found.last_in_windows) {
    several.best = searched_again(problem, search, several);
    found.last_in_windows = true;
  }
  found.error = step_error(*problem.simulation, search, several.best, found.divided);
}

/// By what the steps must be divided beside what they are; 1: by nothing, or by nothing that is allowed.
int more_division(const Problem& problem, const SteppedSearch& found) {
  if (!problem.options.own_steps || !found.error || !found.error->unknown.empty()) return 1;
  return std::min({division_needed(*found.error, found.several.best), most_at_once, most_divided / found.divided});
}

/// A fit with values goes on from where it ended, which takes few runs; one without is begun anew.
void search_anew(const Problem& problem, SimulationProblem search, SteppedSearch& found) {
  if (!found.several.best.refused.empty()) {
    found.several = searched(problem, search);
    found.last_in_windows = false;
    return;
  }
  const SimulationFit before = std::move(found.several.best);
  search.begin = &before;
  found.several.best = fit_simulation(*problem.simulation, search);
}

/// "line.damping.linear too large by 0.00011 kg/s, 1.9 of the half-width of its interval"
std::string what_it_moves(const Problem& problem, const SteppedSearch& found, std::size_t k) {
  const double shift = found.error->shift[static_cast<Eigen::Index>(k)];
  const std::string& unit = problem.parameters[k].unit;
  return fmt::format("{} too {} by {:.2g}{}{}, {:.2g} of the half-width of its interval",
                     problem.parameters[k].number.name, shift < 0 ? "large" : "small", std::abs(shift),
                     unit.empty() ? "" : " ", unit, share_of_half_width(*found.error, found.several.best, k));
}

std::string caution_of(const Problem& problem, const SteppedSearch& found) {
  const StepError& error = *found.error;
  const SimulationFit& fit = found.several.best;
  if (!error.unknown.empty())
    return fmt::format("the error of the run's steps is not known, and in no interval: with shorter ones {}",
                       error.unknown);
  std::vector<std::string> moved;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    if (share_of_half_width(error, fit, k) > small_step_error) moved.push_back(what_it_moves(problem, found, k));
  if (moved.empty()) return {};
  return fmt::format(
      "the steps of the run make {}; intervals reach over that, and are so much wider than the record makes them: {}",
      fmt::join(moved, ", and "),
      problem.options.own_steps
          ? "the accuracy of the scene chooses the first step"
          : fmt::format("steps divided by {} leave less than a fifth ([solve] step of the scene; without one the fit "
                        "chooses it)",
                        division_needed(error, fit)));
}

}  // namespace

SimulationFit searched_again(const Problem& problem, SimulationProblem search, const SeveralStarts& several) {
  for (std::size_t k = 0; k < search.parameters.size(); ++k)
    search.parameters[k].first = several.searches[several.best_of].first[static_cast<Eigen::Index>(k)];
  return fit_simulation(*problem.simulation, search);
}

SteppedSearch search_with_steps(const Problem& problem, const SimulationProblem& search) {
  SteppedSearch out{searched(problem, search), false, {}, 1};
  look_at_steps(problem, search, out);
  for (int more = more_division(problem, out); more > 1; more = more_division(problem, out)) {
    out.divided *= more;
    problem.simulation->divide_steps(out.divided);
    search_anew(problem, search, out);
    look_at_steps(problem, search, out);
  }
  return out;
}

void tell_steps(const Problem& problem, const SteppedSearch& found, Report& report) {
  const SimulationFit& fit = found.several.best;
  if (!found.error || !fit.refused.empty()) return;
  double largest = 0;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    largest = std::max(largest, share_of_half_width(*found.error, fit, k));
    if (!fit.parameters[k].value || !found.error->unknown.empty()) continue;
    report.estimates[k].facts.emplace_back("shift_of_short_steps", found.error->shift[static_cast<Eigen::Index>(k)]);
  }
  report.facts.emplace_back("steps_divided_by", found.divided);
  if (found.error->unknown.empty())
    report.say("steps{}: their error moves no parameter by more than {:.2g} of the half-width of its interval",
               found.divided > 1 ? fmt::format(", divided by {} for this fit", found.divided) : "", largest);
  report.warn(caution_of(problem, found));
}

std::string trouble_of_steps(const SteppedSearch& found) {
  if (!found.error || !found.error->unknown.empty() || found.error->motion <= small_step_error) return {};
  return fmt::format(
      "half the step changes the motion by {:.2g} of the deviations rms, so that steps may be what it differs by",
      found.error->motion);
}

}  // namespace fit::motion
