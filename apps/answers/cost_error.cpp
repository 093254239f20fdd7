#include "answers/cost_error.hpp"

#include <algorithm>
#include <cmath>

#include "answers/convergence.hpp"
#include "answers/statistics.hpp"

namespace froude {
namespace {

/// In the unit of the signal.
double difference(ErrorMeasure measure, const Signal& answer, const Signal& reference) {
  if (measure != ErrorMeasure::rms)
    return std::abs(size_of(measure, answer.values) - size_of(measure, reference.values));
  std::vector<double> off(reference.values.size());
  for (std::size_t i = 0; i < off.size(); ++i) off[i] = answer.values[i] - reference.values[i];
  return statistics(off).rms;
}

/// Difference of each signal over its scale.
std::vector<double> errors_by(ErrorMeasure measure, const std::vector<Signal>& answer,
                              const std::vector<Signal>& reference) {
  std::vector<double> scale;
  for (const Signal& r : reference) scale.push_back(size_of(measure, r.values));
  scale = at_least_a_thousandth(std::move(scale), reference, &Signal::units);
  std::vector<double> out(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    if (scale[i] > 0 && !is_residual(reference[i].name))
      out[i] = difference(measure, answer[i], reference[i]) / scale[i];
  return out;
}

}  // namespace

double size_of(ErrorMeasure measure, std::span<const double> values) {
  const Statistics s = statistics(values);
  switch (measure) {
    case ErrorMeasure::rms:
      return s.rms;
    case ErrorMeasure::deviation:
      return s.deviation;
    case ErrorMeasure::extreme:
    case ErrorMeasure::peak:
      return s.extreme();
    case ErrorMeasure::range:
      return s.highest - s.lowest;
  }
  return 0;
}

std::vector<double> rms_errors(const std::vector<Signal>& answer, const std::vector<Signal>& reference) {
  return errors_by(ErrorMeasure::rms, answer, reference);
}

CostErrors errors_of(const std::vector<Signal>& answer, const std::vector<Signal>& reference, bool responses,
                     const std::set<std::string>& unpredictable) {
  CostErrors out;
  for (std::size_t m = 0; m < error_measures; ++m) {
    const auto measure = static_cast<ErrorMeasure>(m);
    if ((measure == ErrorMeasure::peak) != responses) continue;
    std::vector<double> errors = errors_by(measure, answer, reference);
    if (measure == ErrorMeasure::rms && !unpredictable.empty()) {
      const std::vector<double> of_deviations = errors_by(ErrorMeasure::deviation, answer, reference);
      for (std::size_t i = 0; i < errors.size(); ++i)
        if (unpredictable.contains(reference[i].name)) errors[i] = of_deviations[i];
    }
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (out[m].signal.empty() || errors[i] > out[m].error) out[m] = {errors[i], reference[i].name};
    }
  }
  return out;
}

}  // namespace froude
