#include "answers/cost_components.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "answers/cost_error.hpp"
#include "answers/cost_ladder.hpp"

namespace froude {
namespace {

/// Mean and variance of the mean, over seeds, of the standard deviation of each signal.
struct Spread {
  std::vector<std::string> name;
  std::vector<double> mean, variance;
  double answering_s = std::numeric_limits<double>::infinity();
};

/// Empty where the setting is refused.
Spread spread_of(const scene::Scene& scene, Interview& interview, const Question& own, const Rung& rung, int seeds) {
  Spread out;
  std::vector<double> squares;
  for (int n = 0; n < seeds; ++n) {
    Question other = own;
    other.edits.insert(other.edits.end(), rung.edits.begin(), rung.edits.end());
    other.edits.push_back(with_seed(scene, n));
    const Answer& answer = interview.ask(other);
    if (!answer.is()) return {};
    out.answering_s = std::min(out.answering_s, answer.answering_s);
    out.mean.resize(answer.signals.size());
    squares.resize(answer.signals.size());
    for (std::size_t i = 0; i < answer.signals.size(); ++i) {
      const double deviation = size_of(ErrorMeasure::deviation, answer.signals[i].values);
      out.mean[i] += deviation / seeds;
      squares[i] += deviation * deviation / seeds;
      if (n == 0) out.name.push_back(answer.signals[i].name);
    }
  }
  for (std::size_t i = 0; i < squares.size(); ++i)
    out.variance.push_back(std::max(0.0, squares[i] - out.mean[i] * out.mean[i]) / (seeds - 1));
  return out;
}

/// The signal that is worst; those at rest do not count, nor energies, which are sums over the run.
CostOfComponents compared(const Rung& rung, const Spread& of, const Spread& finest) {
  CostOfComponents out{rung.setting, 0, 0, "", of.answering_s};
  const double largest = *std::max_element(finest.mean.begin(), finest.mean.end());
  for (std::size_t i = 0; i < of.mean.size(); ++i) {
    if (of.name[i].starts_with("energy.") || finest.mean[i] <= 1e-6 * largest) continue;
    const double error = std::abs(of.mean[i] - finest.mean[i]) / finest.mean[i];
    if (!out.signal.empty() && error <= out.error) continue;
    out.error = error;
    out.by_chance = std::sqrt(of.variance[i] + finest.variance[i]) / finest.mean[i];
    out.signal = of.name[i];
  }
  return out;
}

}  // namespace

std::vector<CostOfComponents> cost_of_components(const scene::Scene& scene, Interview& interview, const Question& own,
                                                 double limit_s, std::vector<std::string>& notes) {
  const auto ladder = components_of_run(scene);
  if (!ladder) return {};
  constexpr int most = 8, fewest = 3;  // seeds; of fewer the scatter is not known
  const Answer& one = interview.ask(own);
  const double each_s = (one.preparing_s + one.answering_s) * static_cast<double>(ladder->rungs.size() + 1);
  if (fewest * each_s > limit_s) {
    notes.push_back(
        fmt::format("components of the sea stay as they are: other ones are another realisation, and to compare "
                    "statistics takes {} seeds of each, {:.2g} s",
                    fewest, fewest * each_s));
    return {};
  }
  const int seeds = std::min(most, static_cast<int>(limit_s / each_s));
  std::vector<CostOfComponents> out;
  const Spread finest = spread_of(scene, interview, own, ladder->finest, seeds);
  if (finest.mean.empty()) return {};
  for (const Rung& rung : ladder->rungs)
    if (const Spread of = spread_of(scene, interview, own, rung, seeds); !of.mean.empty())
      out.push_back(compared(rung, of, finest));
  notes.push_back(
      fmt::format("seas of other components are other realisations: the table compares standard deviations, means of "
                  "{} seeds, with those of the sea {}",
                  seeds, ladder->finest.setting));
  return out;
}

}  // namespace froude
