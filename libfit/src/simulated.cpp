#include "simulated.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>

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

// Of the prime number of its dimension: 1/2, 1/4, 3/4 …; 1/3, 2/3, 1/9 …
double halton(int index, std::size_t dimension) {
  constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  hydro::require(dimension < std::size(primes), "several starts are for {} parameters at most", std::size(primes));
  const int base = primes[dimension];
  double out = 0, digit = 1;
  for (int rest = index; rest > 0; rest /= base) out += (digit /= base) * (rest % base);
  return out;
}

}  // namespace

double SimulationParameter::scale() const {
  const double range = std::isfinite(highest - lowest) ? (highest - lowest) / 10 : 0;
  const double out = std::max(std::abs(first), range);
  return out > 0 ? out : 1;
}

SimulationFit fit_simulation(Simulation& simulation, const SimulationProblem& problem) {
  hydro::require(!problem.parameters.empty(), "a fit needs a parameter at least");
  return told(problem, search_simulation(simulation, problem));
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
  SimulationProblem others = problem;
  others.parameters.erase(others.parameters.begin() + static_cast<std::ptrdiff_t>(parameter));
  others.begin = &begin;
  // Of a parabola this is straight in the distance, so that false position needs few searches.
  const auto risen = [&](double at) {
    Held held(simulation, parameter, at);
    try {
      const double cost = least_cost(held, others) - fit.search.cost_last;
      return std::isfinite(cost) ? std::sqrt(std::max(0.0, cost) / rise) : std::numeric_limits<double>::infinity();
    } catch (const SearchFailed&) {
      throw;
    } catch (const hydro::NumericsError&) {
      return std::numeric_limits<double>::infinity();  // no motion there: the end lies before
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
  SeveralStarts out{{}, starts, 0, 0, 0};
  std::vector<double> costs;
  std::exception_ptr failure;
  for (int k = 0; k < starts; ++k) {
    SimulationProblem other = problem;
    for (std::size_t i = 0; k > 0 && i < other.parameters.size(); ++i) {
      auto& q = other.parameters[i];
      q.first = q.lowest + halton(k, i) * (q.highest - q.lowest);
    }
    try {
      SimulationFit fit = fit_simulation(simulation, other);
      costs.push_back(fit.search.cost_last);
      out.unended += !fit.search.ended();
      if (costs.back() <= *std::min_element(costs.begin(), costs.end())) out.best = std::move(fit);
    } catch (const hydro::NumericsError&) {
      failure = std::current_exception();
      ++out.failed;
    } catch (const hydro::InputError&) {
      if (k == 0) throw;  // of the problem itself; later it is a point at which there is no motion
      ++out.failed;
    }
  }
  if (costs.empty()) std::rethrow_exception(failure);
  double rows = 0;
  for (const auto& m : problem.measured) rows += static_cast<double>(m.size());
  // One standard error of one unknown raises the cost by itself over n (F41).
  const double least = *std::min_element(costs.begin(), costs.end());
  out.agree = static_cast<int>(
      std::count_if(costs.begin(), costs.end(), [&](double cost) { return cost - least <= least / rows; }));
  return out;
}

}  // namespace fit
