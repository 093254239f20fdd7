#include "answers/cost_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace froude {
namespace {

double rms(std::span<const double> values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

double deviation(std::span<const double> values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

double largest(std::span<const double> values) {
  double out = 0;
  for (const double x : values) out = std::max(out, std::abs(x));
  return out;
}

/// In the unit of the signal.
double difference(ErrorMeasure measure, const Signal& answer, const Signal& reference) {
  if (measure != ErrorMeasure::rms)
    return std::abs(size_of(measure, answer.values) - size_of(measure, reference.values));
  std::vector<double> off(reference.values.size());
  for (std::size_t i = 0; i < off.size(); ++i) off[i] = answer.values[i] - reference.values[i];
  return rms(off);
}

/// Difference of each signal over its scale.
std::vector<double> errors_by(ErrorMeasure measure, const std::vector<Signal>& answer,
                              const std::vector<Signal>& reference) {
  constexpr double share_of_largest = 1e-3;  // motions that symmetry forbids are small, and matter to nobody
  std::map<std::string, double> largest_of_unit;
  for (const Signal& r : reference)
    largest_of_unit[r.units] = std::max(largest_of_unit[r.units], size_of(measure, r.values));
  std::vector<double> out(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Signal& r = reference[i];
    const double scale = std::max(size_of(measure, r.values), share_of_largest * largest_of_unit[r.units]);
    if (scale > 0 && !r.name.ends_with(".residual")) out[i] = difference(measure, answer[i], r) / scale;
  }
  return out;
}

}  // namespace

double size_of(ErrorMeasure measure, std::span<const double> values) {
  if (values.empty()) return 0;
  switch (measure) {
    case ErrorMeasure::rms:
      return rms(values);
    case ErrorMeasure::deviation:
      return deviation(values);
    case ErrorMeasure::extreme:
    case ErrorMeasure::peak:
      return largest(values);
    case ErrorMeasure::range: {
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      return *high - *low;
    }
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
    const std::vector<double> errors = errors_by(measure, answer, reference);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (measure == ErrorMeasure::rms && unpredictable.contains(reference[i].name)) continue;
      if (out[m].signal.empty() || errors[i] > out[m].error) out[m] = {errors[i], reference[i].name};
    }
  }
  return out;
}

}  // namespace froude
