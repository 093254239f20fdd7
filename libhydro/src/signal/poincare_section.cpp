#include "hydro/signal/poincare_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

constexpr std::size_t beside = 3;  // samples on either side

/// The polynomial through `Side` samples on either side of an interval, at the share s of it. `first`: the outermost.
template <int Side>
double polynomial(const double* first, double s) {
  double sum = 0;
  for (int i = 0; i < 2 * Side; ++i) {
    double weight = 1;
    for (int k = 0; k < 2 * Side; ++k)
      if (k != i) weight *= (s - (k - Side + 1)) / (i - k);
    sum += weight * first[i];
  }
  return sum;
}

/// Between samples k and k + 1: through six samples, and through the inner four.
double fine(std::span<const double> v, std::size_t k, double s) { return polynomial<3>(&v[k - 2], s); }
double coarse(std::span<const double> v, std::size_t k, double s) { return polynomial<2>(&v[k - 1], s); }

/// Where in its interval a polynomial reaches a level, by halving: it does so at either end's sample or between.
template <class Function>
double reaches(const Function& f, double level) {
  double low = 0, high = 1;
  const bool rises = f(1.0) > f(0.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((f(middle) < level) == rises ? low : high) = middle;
  }
  return (low + high) / 2;
}

void check(std::span<const double> values, std::size_t size) {
  require(values.size() >= 2 * beside, "a section needs at least {} samples, got {}", 2 * beside, values.size());
  require(values.size() == size, "signals of {} and {} samples are of no one motion", values.size(), size);
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  require(bad == values.end(), "sample {} of the record is not a finite number", bad - values.begin() + 1);
}

PoincareSection empty(const Samples& samples) {
  require(std::isfinite(samples.step_s) && samples.step_s > 0, "samples need a step above 0, got {} s", samples.step_s);
  PoincareSection out;
  out.values.resize(samples.of.size());
  out.errors.resize(samples.of.size());
  return out;
}

/// A point at the share `s` of the interval after sample k; by fewer samples it would be at `other`.
void add(std::size_t k, double s, double other, const Samples& samples, PoincareSection& out) {
  out.time_s.push_back(samples.start_s + samples.step_s * (static_cast<double>(k) + s));
  for (std::size_t i = 0; i < samples.of.size(); ++i) {
    out.values[i].push_back(fine(samples.of[i], k, s));
    out.errors[i].push_back(std::abs(out.values[i].back() - coarse(samples.of[i], k, other)));
  }
}

}  // namespace

PoincareSection poincare_section_at(std::span<const double> across, double level, Through through,
                                    const Samples& samples) {
  PoincareSection out = empty(samples);
  check(across, across.size());
  for (const auto& signal : samples.of) check(signal, across.size());
  for (std::size_t k = 0; k + 1 < across.size(); ++k) {
    const bool up = across[k] < level && across[k + 1] >= level, down = across[k] > level && across[k + 1] <= level;
    if (!(up && through != Through::down) && !(down && through != Through::up)) continue;
    if (k + 1 < beside || k + beside >= across.size()) {
      ++out.left_out;
      continue;
    }
    add(k, reaches([&](double s) { return fine(across, k, s); }, level),
        reaches([&](double s) { return coarse(across, k, s); }, level), samples, out);
  }
  return out;
}

PoincareSection poincare_section_every(double first_s, double period_s, const Samples& samples) {
  PoincareSection out = empty(samples);
  require(!samples.of.empty(), "a section needs a signal");
  const std::size_t size = samples.of.front().size();
  for (const auto& signal : samples.of) check(signal, size);
  require(std::isfinite(period_s) && period_s > 0, "a section once in a period needs one above 0, got {} s", period_s);
  const double last = static_cast<double>(size - 1), rounding = 1e-9;
  const double begins = (first_s - samples.start_s) / samples.step_s;
  require(begins >= -rounding && begins <= last, "a section from {} s on is asked of a record from {} to {} s", first_s,
          samples.start_s, samples.start_s + samples.step_s * last);
  for (std::size_t n = 0;; ++n) {
    const double at = begins + static_cast<double>(n) * period_s / samples.step_s;
    if (at > last + rounding) return out;
    const auto k = static_cast<std::size_t>(std::max(0.0, std::floor(at)));
    if (k + 1 < beside || k + beside >= size) {
      ++out.left_out;
      continue;
    }
    add(k, at - static_cast<double>(k), at - static_cast<double>(k), samples, out);
  }
}

}  // namespace hydro::signal
