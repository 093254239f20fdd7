#include "simulated.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <stdexcept>

#include "fit/verdict.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {
namespace {

/// A simulation of which one parameter is held.
class Held final : public Simulation {
 public:
  Held(Simulation& whole, std::size_t parameter, double value)
      : whole_(whole), parameter_(static_cast<Eigen::Index>(parameter)), value_(value) {}
  Eigen::Index coordinates(std::size_t window) override { return whole_.coordinates(window); }
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& others, const Eigen::VectorXd& start) override {
    return whole_.follow(window, with(others), start);
  }
  void hand_on(std::size_t window, const Eigen::VectorXd& others, const Eigen::VectorXd& start) override {
    whole_.hand_on(window, with(others), start);
  }
  bool moves(std::size_t window, std::size_t other) const override {
    return whole_.moves(window, other < static_cast<std::size_t>(parameter_) ? other : other + 1);
  }

 private:
  Eigen::VectorXd with(const Eigen::VectorXd& others) const {
    Eigen::VectorXd all(others.size() + 1);
    all << others.head(parameter_), value_, others.tail(others.size() - parameter_);
    return all;
  }
  Simulation& whole_;
  Eigen::Index parameter_;
  double value_;
};

/// Where the search for the others begins: at the end of `fit`, without the parameter that is held.
SimulationFit without(const SimulationFit& fit, std::size_t parameter) {
  SimulationFit out{};
  out.end.seen = fit.end.seen;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < fit.end.unknowns.size(); ++j)
    if (j != static_cast<Eigen::Index>(parameter)) kept.push_back(j);
  out.end.unknowns = fit.end.unknowns(kept);
  out.end.jacobian = fit.end.jacobian(Eigen::all, kept);
  return out;
}

constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};

// Of the prime number of its dimension: 1/2, 1/4, 3/4 …; 1/3, 2/3, 1/9 …
double halton(int index, std::size_t dimension) {
  hydro::require(dimension < std::size(primes), "several starts are for {} parameters at most", std::size(primes));
  const int base = primes[dimension];
  double out = 0, digit = 1;
  for (int rest = index; rest > 0; rest /= base) out += (digit /= base) * (rest % base);
  return out;
}

/// Where a search begins: a share of the way between the bounds, else from a quarter of the first value to four times
/// that, or where that is zero as far as its scale.
double start_of(const SimulationParameter& q, double share) {
  if (std::isfinite(q.lowest) && std::isfinite(q.highest)) return q.lowest + share * (q.highest - q.lowest);
  const double way = 2 * share - 1, there = q.first != 0 ? q.first * std::pow(4, way) : way * q.scale();
  return std::clamp(there, q.lowest, q.highest);
}

/// Searches from several points, of which the best is kept.
class Searches {
 public:
  Searches(Simulation& simulation, const SimulationProblem& problem) : simulation_(simulation), problem_(problem) {}

  /// At the first values, k = 0, or at a point of the Halton sequence.
  void begin_at(int k) {
    SimulationProblem other = problem_;
    for (std::size_t i = 0; k > 0 && i < other.parameters.size(); ++i)
      other.parameters[i].first = start_of(other.parameters[i], halton(k, i));
    ++out_.tried;
    try {
      keep(other, fit_simulation(simulation_, other));
    } catch (const hydro::NumericsError&) {
      failure_ = std::current_exception();
      ++out_.failed;
    } catch (const hydro::InputError&) {
      if (k == 0) throw;  // of the problem itself; later it is a point at which there is no motion
      ++out_.failed;
    }
  }

  /// Whether there are values to be told.
  bool found() const { return !out_.searches.empty() && out_.best.refused.empty(); }

  SeveralStarts best() {
    if (out_.searches.empty()) std::rethrow_exception(failure_);
    out_.agree = static_cast<int>(std::count_if(out_.searches.begin(), out_.searches.end(),
                                                [&](const auto& s) { return as_low(s.cost, least()); }));
    return std::move(out_);
  }

 private:
  double least() const { return out_.searches[out_.best_of].cost; }
  /// One standard error of one unknown raises the cost by itself over n (F41).
  bool as_low(double cost, double than) const {
    double rows = 0;
    for (const auto& m : problem_.measured) rows += static_cast<double>(m.size());
    return cost - than <= than / rows;
  }
  void keep(const SimulationProblem& begun, SimulationFit fit) {
    SeveralStarts::Search search{Eigen::VectorXd(std::ssize(begun.parameters)),
                                 fit.end.unknowns.head(std::ssize(begun.parameters)), fit.search.cost_last,
                                 fit.search.ended()};
    for (std::size_t i = 0; i < begun.parameters.size(); ++i)
      search.first[static_cast<Eigen::Index>(i)] = begun.parameters[i].first;
    out_.unended += !search.ended;
    const bool better = out_.searches.empty() || search.cost < least();
    out_.searches.push_back(std::move(search));
    if (!better) return;
    out_.best = std::move(fit);
    out_.best_of = out_.searches.size() - 1;
  }

  Simulation& simulation_;
  const SimulationProblem& problem_;
  SeveralStarts out_{};
  std::exception_ptr failure_;
};

/// The same problem without one of its parameters, which `Held` holds.
SimulationProblem without(const SimulationProblem& problem, std::size_t parameter, const SimulationFit& begin) {
  SimulationProblem out = problem;
  out.parameters.erase(out.parameters.begin() + static_cast<std::ptrdiff_t>(parameter));
  out.begin = &begin;
  return out;
}

/// √ of the rise of the cost over that of the second derivative, with one parameter moved so far and all else where the
/// Jacobian says that it follows. Infinite where there is no motion.
double rise_against_quadratic(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                              std::size_t parameter, double move) {  // (F76)
  const auto k = static_cast<Eigen::Index>(parameter);
  const Eigen::MatrixXd& inverse = fit.search.covariance;
  SimulationFit moved{};
  moved.end = fit.end;
  moved.end.unknowns += inverse.col(k) * (move / inverse(k, k));
  for (Eigen::Index j = 0; j < std::ssize(problem.parameters); ++j) {
    const auto& q = problem.parameters[static_cast<std::size_t>(j)];
    moved.end.unknowns[j] = std::clamp(moved.end.unknowns[j], q.lowest, q.highest);
  }
  Held held(simulation, parameter, moved.end.unknowns[k]);
  const SimulationFit begin = without(moved, parameter);
  try {
    const double rise = cost_nearby(held, without(problem, parameter, begin)) - fit.search.cost_last;
    return std::isfinite(rise) ? std::sqrt(std::max(0.0, 2 * rise * inverse(k, k))) / std::abs(move)
                               : std::numeric_limits<double>::infinity();
  } catch (const std::runtime_error&) {  // no motion there, or a scene that cannot be: as far as one can go
    return std::numeric_limits<double>::infinity();
  }
}

/// Whether both ends of an interval lie where the cost has risen as its second derivative says. An end that is off by a
/// quarter of its distance is no worse than the errors of an interval made from some twenty independent residuals.
bool is_quadratic(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                  std::size_t parameter) {
  constexpr double off = 1.25;
  const Coefficient& c = fit.parameters[parameter];
  const SimulationParameter& q = problem.parameters[parameter];
  for (const double end : {std::max(c.interval.low, q.lowest), std::min(c.interval.high, q.highest)}) {
    const double rise = rise_against_quadratic(simulation, problem, fit, parameter, end - *c.value);
    if (!(rise > 1 / off && rise < off)) return false;
  }
  return true;
}

}  // namespace

double SimulationParameter::scale() const {
  const double range = std::isfinite(highest - lowest) ? (highest - lowest) / 10 : 0;
  const double out = std::max(std::abs(first), range);
  return out > 0 ? out : 1;
}

SimulationFit fit_simulation(Simulation& simulation, const SimulationProblem& problem) {
  hydro::require(!problem.parameters.empty(), "a fit needs a parameter at least");
  SimulationFit fit = told(problem, search_simulation(simulation, problem));
  compare_with_likelihood(simulation, problem, fit);
  return fit;
}

void compare_with_likelihood(Simulation& simulation, const SimulationProblem& problem, SimulationFit& fit) {  // (F76)
  fit.by_likelihood.assign(fit.parameters.size(), false);
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    Coefficient& c = fit.parameters[k];
    if (!c.value || !(c.standard_error > 0) || is_quadratic(simulation, problem, fit, k)) continue;
    try {
      c.interval = profile_interval(simulation, problem, fit, k);
      fit.by_likelihood[k] = true;
    } catch (const hydro::NumericsError& e) {
      withhold(
          c, fmt::format("the second derivative does not describe the cost about {:.6g}, and {}", *c.value, e.what()));
    }
  }
}

Interval profile_interval(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                          std::size_t parameter) {  // (F64)
  hydro::require(parameter < fit.parameters.size() && fit.parameters[parameter].value &&
                     fit.parameters[parameter].standard_error > 0,
                 "a profile needs a parameter with a value and an error");
  const Coefficient& c = fit.parameters[parameter];
  const SimulationParameter& q = problem.parameters[parameter];
  const double value = *c.value, t = hydro::signal::student_t_quantile((1 + problem.confidence) / 2, fit.dof);
  // t² s² (n/n_eff)/2, s² = 2 C/n
  const double rise = t * t * fit.search.cost_last / std::max(1.0, c.effective_samples);
  const SimulationFit begin = without(fit, parameter);
  const SimulationProblem others = without(problem, parameter, begin);
  // Of a parabola this is straight in the distance, so that false position needs few searches.
  const auto risen = [&](double at) {
    Held held(simulation, parameter, at);
    try {
      const double cost = least_cost(held, others) - fit.search.cost_last;
      return std::isfinite(cost) ? std::sqrt(std::max(0.0, cost) / rise) : std::numeric_limits<double>::infinity();
    } catch (const SearchFailed&) {
      throw;
    } catch (const std::runtime_error&) {  // no motion there, or a scene that cannot be: the end lies before
      return std::numeric_limits<double>::infinity();
    }
  };
  const auto end = [&](double sign) {
    const double bound = sign < 0 ? q.lowest : q.highest, farthest = value + sign * 30 * t * c.standard_error;
    double inside = value, at_inside = 0, outside = 0, at_outside = 0, at = value + sign * t * c.standard_error;
    for (int i = 0; i < 20; ++i) {
      if (sign * (at - bound) > 0) at = bound;
      const double g = risen(at);
      if (std::abs(g - 1) < 0.03 || (at == bound && g < 1)) return at;
      if (g < 1) {
        inside = at, at_inside = g;
        if (sign * (at - farthest) > 0) break;
      } else {
        outside = at, at_outside = g;
      }
      if (at_outside == 0)  // nothing outside yet
        at = value + (at - value) * std::clamp(1.02 / std::max(g, 0.1), 1.05, 3.0);
      else if (std::isinf(at_outside) || i % 4 == 3)
        at = (inside + outside) / 2;
      else
        at = inside + (outside - inside) * (1 - at_inside) / (at_outside - at_inside);
    }
    throw hydro::NumericsError(
        fmt::format("the likelihood of {} has no end within 30 standard errors of {:.6g}", q.name, value));
  };
  return {end(-1), end(1)};
}

SeveralStarts fit_simulation_from(Simulation& simulation, const SimulationProblem& problem, int starts) {  // (F58)
  hydro::require(starts >= 2 && problem.begin == nullptr, "several starts are two at least, got {}", starts);
  for (const auto& q : problem.parameters)
    hydro::require(std::isfinite(q.lowest) && std::isfinite(q.highest),
                   "{} has no bounds on both sides, between which a search could start", q.name);
  Searches searches(simulation, problem);
  for (int k = 0; k < starts; ++k) searches.begin_at(k);
  return searches.best();
}

SeveralStarts fit_simulation_insisting(Simulation& simulation, const SimulationProblem& problem, int more) {  // (F58)
  Searches searches(simulation, problem);
  searches.begin_at(0);
  if (!searches.found() && problem.parameters.size() <= std::size(primes))
    for (int k = 1; k <= more; ++k) searches.begin_at(k);
  return searches.best();
}

}  // namespace fit
