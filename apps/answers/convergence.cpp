#include "answers/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "answers/statistics.hpp"

namespace froude {
namespace {

/// Both values at the samples that two runs share, of which a third run of this stride has all that are seen, and their
/// times.
template <class See>
void each_pair(const Beside& fine, const Beside& coarse, std::size_t signal, const See& see, std::size_t stride = 1) {
  const auto& x = fine.run->signals[signal].values;
  const auto& y = coarse.run->signals[signal].values;
  const std::size_t step = coarse.stride / fine.stride, every = std::max<std::size_t>(1, stride / coarse.stride);
  for (std::size_t j = 0; j < y.size() && j * step < x.size(); j += every) see(coarse.run->time[j], x[j * step], y[j]);
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

/// A thousandth of the largest of its unit; of an energy a thousandth of the kinetic one, which does not grow with the
/// time of the run as work and what is dissipated do.
std::vector<double> least_sizes(const std::vector<double>& rms, const std::vector<Signal>& signals) {
  std::vector<double> out = thousandth_of_largest(rms, signals, &Signal::units);
  const auto kinetic = std::find_if(signals.begin(), signals.end(), [](auto& s) { return s.name == "energy.kinetic"; });
  if (kinetic == signals.end()) return out;
  const double of_energies = 1e-3 * rms[static_cast<std::size_t>(kinetic - signals.begin())];
  for (std::size_t i = 0; i < out.size(); ++i)
    if (signals[i].name.starts_with("energy.")) out[i] = std::min(out[i], of_energies);
  return out;
}

}  // namespace

bool is_residual(const std::string& signal) { return signal.ends_with(".residual"); }

std::vector<Sizes> sizes_of(const Run& run, double weight) {
  std::vector<Statistics> seen;
  std::vector<double> rms;
  for (const Signal& s : run.signals) {
    seen.push_back(statistics(s.values));
    rms.push_back(seen.back().rms);
  }
  const std::vector<double> least = least_sizes(rms, run.signals);
  std::vector<Sizes> out;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double floor = std::max(least[i], rounding_of(run.signals[i].units, weight));
    out.push_back(
        {std::max(seen[i].rms, floor), std::max(seen[i].deviation, floor), std::max(seen[i].extreme(), floor)});
  }
  return out;
}

Difference difference(const Beside& fine, const Beside& coarse, std::size_t signal, const Sizes& sizes, double until,
                      std::size_t stride) {
  std::vector<double> a, b, off;
  const auto see = [&](double t, double x, double y) {
    if (t > until) return;
    a.push_back(x);
    b.push_back(y);
    off.push_back(x - y);
  };
  each_pair(fine, coarse, signal, see, stride);
  const Statistics x = statistics(a), y = statistics(b);
  const double ends = std::max(std::abs(x.lowest - y.lowest), std::abs(x.highest - y.highest));
  return {statistics(off).rms / sizes.rms,
          std::max(std::abs(x.deviation - y.deviation) / sizes.deviation, ends / sizes.extreme)};
}

// (E1)
Convergence convergence(const Beside& fine, const Beside& coarse, const std::optional<Beside>& coarsest, double largest,
                        std::size_t signal, const Sizes& sizes, double until) {
  const Difference d = difference(fine, coarse, signal, sizes, until);
  if (!coarsest) return {d.most(), 0};
  const Difference before = difference(coarse, *coarsest, signal, sizes, until);
  if (d.rms == 0) return {0, largest};
  constexpr double safety = 1.25;  // what is left beside the first term of the error [Roache 1994, sec. 4]
  // By how much differences fall is seen where all three runs are: samples twice as far apart may lie at crests alone,
  // where errors of phase are not seen.
  const double shared = difference(fine, coarse, signal, sizes, until, coarsest->stride).rms;
  const double ratio = shared > 0 ? before.rms / shared : largest,
               falls = std::clamp(ratio, std::numbers::sqrt2, largest);
  // Two runs may agree by chance, where corners of a force fall on their steps alike: no error falls by more than the
  // method's order.
  const double rms = std::max(d.rms, before.rms / largest);
  const double statistics = std::max(d.statistics, before.statistics / std::max(ratio, std::numbers::sqrt2));
  return {safety * std::max(rms, statistics) / (falls - 1), ratio};
}

double agrees_until(const Beside& fine, const Beside& coarse, std::size_t signal, double allowed) {
  constexpr int blocks = 50;
  const double end = fine.run->time.back(), begin = fine.run->time.front();
  std::vector<Mean> means(blocks);
  each_pair(fine, coarse, signal, [&](double t, double x, double y) {
    const double share = end > begin ? (t - begin) / (end - begin) : 0;
    means[static_cast<std::size_t>(std::min(blocks - 1, static_cast<int>(share * blocks)))].add(x - y);
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
  return statistics(std::span(run.signals[signal].values).subspan(static_cast<std::size_t>(before))).deviation;
}

}  // namespace froude
