#include "fit/step_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fit/parts.hpp"
#include "hydro/base/dense.hpp"
#include "simulated.hpp"

namespace fit {
namespace {

/// Steps are divided as they were when this ends.
class Divided {
 public:
  Divided(Simulation& simulation, int before) : simulation_(simulation), before_(before) {}
  ~Divided() { simulation_.divide_steps(before_); }
  Divided(const Divided&) = delete;
  Divided& operator=(const Divided&) = delete;

 private:
  Simulation& simulation_;
  int before_;
};

/// Unknowns that follow the residuals: those that the data see, but for parameters at a bound.
std::vector<Eigen::Index> free_unknowns(const SimulationProblem& problem, const SimulationFit& fit) {
  std::vector<Eigen::Index> out;
  for (std::size_t j = 0; j < fit.search.identifiable.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    if (!fit.search.identifiable[j]) continue;
    if (j < problem.parameters.size()) {
      const SimulationParameter& q = problem.parameters[j];
      const double at = fit.end.unknowns[column], near = 1e-6 * q.scale();
      if (at - q.lowest < near || q.highest - at < near) continue;
    }
    out.push_back(column);
  }
  return out;
}

/// By how much the parameters follow a change of the residuals: −J⁺Δr.
Eigen::VectorXd follow_change(const SimulationProblem& problem, const SimulationFit& fit,
                              const Eigen::VectorXd& change) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(fit.end.jacobian.cols());
  if (const auto free = free_unknowns(problem, fit); !free.empty())
    out(free) = -hydro::dense::HouseholderQr(Eigen::MatrixXd(fit.end.jacobian(Eigen::all, free))).solve(change);
  return out.head(std::ssize(problem.parameters));
}

/// What is left of an error once its steps are divided by a power of two.
double left_of(double error, double falls, int division) { return error / std::pow(falls, std::log2(division)); }

}  // namespace

std::optional<StepError> step_error(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                                    int divided) {
  if (!simulation.divide_steps(divided)) return {};
  const Divided afterwards(simulation, divided);
  StepError out;
  out.shift = Eigen::VectorXd::Zero(std::ssize(problem.parameters));
  out.falls = Eigen::VectorXd::Constant(out.shift.size(), 2);
  try {
    const Eigen::VectorXd whole = residuals_at_end(simulation, problem, fit);
    simulation.divide_steps(2 * divided);
    const Eigen::VectorXd half = residuals_at_end(simulation, problem, fit);
    simulation.divide_steps(4 * divided);
    const Eigen::VectorXd quarter = residuals_at_end(simulation, problem, fit);
    const auto samples = static_cast<double>(measured_rows(problem).size());
    out.motion = (half - whole).norm() / std::sqrt(samples);
    const Eigen::VectorXd first = follow_change(problem, fit, half - whole),
                          second = follow_change(problem, fit, quarter - half);
    for (Eigen::Index k = 0; k < out.shift.size(); ++k) {
      // Richardson, at the order that both show: one at least, four at most.
      const double falls = second[k] == 0 ? 16 : std::clamp(std::abs(first[k] / second[k]), 2.0, 16.0);
      out.falls[k] = falls;
      out.shift[k] = first[k] + second[k] * falls / (falls - 1);
    }
  } catch (const std::runtime_error& e) {
    out.unknown = e.what();
  }
  return out;
}

double share_of_half_width(const StepError& error, const SimulationFit& fit, std::size_t parameter) {
  const Coefficient& c = fit.parameters[parameter];
  const double half = (c.interval.high - c.interval.low) / 2;
  return c.value && half > 0 ? std::abs(error.shift[static_cast<Eigen::Index>(parameter)]) / half : 0;
}

int division_needed(const StepError& error, const SimulationFit& fit) {
  constexpr double aim = 0.75 * small_step_error;
  constexpr int most = 1024;
  const auto reached = [&](int division) {
    if (!fit.refused.empty()) return left_of(error.motion, 2, division) <= aim;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k)
      if (left_of(share_of_half_width(error, fit, k), error.falls[static_cast<Eigen::Index>(k)], division) > aim)
        return false;
    return true;
  };
  int out = 1;
  while (out < most && !reached(out)) out *= 2;
  return out;
}

Interval with_steps(const StepError& error, std::size_t parameter, const Interval& interval) {
  return with_shift(error.shift[static_cast<Eigen::Index>(parameter)], interval);
}

void count_steps(const StepError& error, SimulationFit& fit) {
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    if (fit.parameters[k].value) count_shift(error.shift[static_cast<Eigen::Index>(k)], fit.parameters[k]);
}

}  // namespace fit
