#include "answers/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace froude {
namespace {

/// Differences at the samples that two runs share, and their times.
template <class See>
void each_difference(const Beside& fine, const Beside& coarse, std::size_t signal, const See& see) {
  const auto& x = fine.run->signals[signal].values;
  const auto& y = coarse.run->signals[signal].values;
  const std::size_t step = coarse.stride / fine.stride;
  for (std::size_t j = 0; j < y.size() && j * step < x.size(); ++j) see(coarse.run->time[j], x[j * step] - y[j]);
}

/// rms of what is added.
class Mean {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  double rms() const { return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : 0; }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

double rounding_of(const std::string& unit, double weight) {
  constexpr double least = 1e-9;
  return unit.find_first_of("NJW") == std::string::npos ? least : least * std::max(1.0, weight);
}

}  // namespace

bool is_residual(const std::string& signal) { return signal.ends_with(".residual"); }

double rms(std::span<const double> values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return values.empty() ? 0 : std::sqrt(squares / static_cast<double>(values.size()));
}

double deviation(std::span<const double> values) {
  if (values.empty()) return 0;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

std::vector<double> scales(const Run& run, double weight) {
  std::vector<double> out;
  for (const Signal& s : run.signals) out.push_back(rms(s.values));
  out = at_least_a_thousandth(std::move(out), run.signals, &Signal::units);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], rounding_of(run.signals[i].units, weight));
  return out;
}

double difference(const Beside& fine, const Beside& coarse, std::size_t signal, double until) {
  Mean mean;
  each_difference(fine, coarse, signal, [&](double t, double d) {
    if (t <= until) mean.add(d);
  });
  return mean.rms();
}

// (E1)
Convergence convergence(const Beside& fine, const Beside& coarse, const std::optional<Beside>& coarsest, double largest,
                        std::size_t signal, double until) {
  const double d = difference(fine, coarse, signal, until);
  if (!coarsest) return {d, 0};
  const double before = difference(coarse, *coarsest, signal, until);
  if (d == 0) return {0, largest};
  const double ratio = before / d;
  return {d / (std::clamp(ratio, std::numbers::sqrt2, largest) - 1), ratio};
}

double agrees_until(const Beside& fine, const Beside& coarse, std::size_t signal, double allowed) {
  constexpr int blocks = 50;
  const double end = fine.run->time.back(), begin = fine.run->time.front();
  std::vector<Mean> means(blocks);
  each_difference(fine, coarse, signal, [&](double t, double d) {
    const double share = end > begin ? (t - begin) / (end - begin) : 0;
    means[static_cast<std::size_t>(std::min(blocks - 1, static_cast<int>(share * blocks)))].add(d);
  });
  const auto first = std::find_if(means.begin(), means.end(), [&](const Mean& m) { return m.rms() > allowed; });
  return begin + (end - begin) * static_cast<double>(first - means.begin()) / blocks;
}

// (E2)
double growth(const Run& run, const Run& neighbour, std::size_t signal, double least) {
  const std::size_t samples = std::min(run.time.size(), neighbour.time.size());
  Mean early, late;
  for (std::size_t j = 1; j < samples; ++j) {
    const double d = run.signals[signal].values[j] - neighbour.signals[signal].values[j];
    if (100 * j <= std::max<std::size_t>(samples, 300)) early.add(d);
    if (3 * j >= 2 * samples) late.add(d);
  }
  return late.rms() / std::max(early.rms(), least);
}

double deviation(const Run& run, std::size_t signal, double from) {
  const auto before = std::lower_bound(run.time.begin(), run.time.end(), from) - run.time.begin();
  return deviation(std::span(run.signals[signal].values).subspan(static_cast<std::size_t>(before)));
}

}  // namespace froude
