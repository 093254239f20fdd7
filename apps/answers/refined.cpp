#include "answers/refined.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "answers/convergence.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// All values at one frequency: signal by signal, of each its headings.
struct Column {
  double omega;
  std::vector<std::complex<double>> values;
};

class Refinement {
 public:
  Refinement(std::size_t headings, double accuracy,
             const std::function<std::vector<ComplexSignal>(const std::vector<double>&)>& at)
      : headings_(headings), accuracy_(accuracy), at_(at) {}

  Refined from(const std::vector<double>& omega) {
    constexpr int most = 24;  // halvings: a peak a millionth as wide as the spacing asked for is found
    take(omega);
    error_.assign(signals_.size(), 0);
    std::vector<double> lower_ends(omega.begin(), omega.end() - 1);
    for (int round = 0; !lower_ends.empty(); ++round) {
      if (round == most)
        throw hydro::NumericsError(fmt::format(
            "a response near {:.6g} rad/s is too sharp: straight lines between frequencies miss it by more than the "
            "accuracy asked, {:g}, however closely they stand; a motion without damping has no peak",
            lower_ends.front(), accuracy_));
      lower_ends = halve(lower_ends);
    }
    return result();
  }

 private:
  /// Answers at these frequencies, and puts them among the others.
  void take(const std::vector<double>& omega) {
    std::vector<ComplexSignal> found = at_(omega);
    for (std::size_t w = 0; w < omega.size(); ++w) {
      Column column{omega[w], {}};
      for (const ComplexSignal& s : found)
        for (std::size_t h = 0; h < headings_; ++h) column.values.push_back(s.values[h * omega.size() + w]);
      columns_.push_back(std::move(column));
    }
    std::sort(columns_.begin(), columns_.end(), [](const Column& a, const Column& b) { return a.omega < b.omega; });
    if (signals_.empty()) {
      for (ComplexSignal& s : found) s.values.clear();
      signals_ = std::move(found);
      largest_.assign(signals_.size(), 0);
    }
    for (const Column& c : columns_)
      for (std::size_t i = 0; i < c.values.size(); ++i)
        largest_[i / headings_] = std::max(largest_[i / headings_], std::abs(c.values[i]));
  }

  /// Puts a frequency in the middle of each of these intervals. \return the lower ends of those halves that straight
  /// lines still miss
  std::vector<double> halve(const std::vector<double>& lower_ends) {
    std::vector<double> middles;
    for (const double low : lower_ends) {
      const auto at = std::upper_bound(columns_.begin(), columns_.end(), low,
                                       [](double omega, const Column& c) { return omega < c.omega; });
      middles.push_back((low + at->omega) / 2);
    }
    take(middles);
    const std::vector<double> peak = at_least_a_thousandth(largest_, signals_, &ComplexSignal::units);
    std::vector<double> again;
    for (std::size_t m = 1; m + 1 < columns_.size(); ++m) {
      if (!std::binary_search(middles.begin(), middles.end(), columns_[m].omega)) continue;
      if (is_straight(columns_[m - 1], columns_[m], columns_[m + 1], peak)) continue;
      again.push_back(columns_[m - 1].omega);
      again.push_back(columns_[m].omega);
    }
    return again;
  }

  /// What is straight enough leaves, in halves, a quarter of what it is off by.
  bool is_straight(const Column& low, const Column& middle, const Column& high, const std::vector<double>& peak) {
    std::vector<double> off(signals_.size(), 0);
    for (std::size_t i = 0; i < middle.values.size(); ++i)
      if (const std::size_t s = i / headings_; peak[s] > 0)
        off[s] = std::max(off[s], std::abs(middle.values[i] - (low.values[i] + high.values[i]) / 2.0) / peak[s]);
    if (*std::max_element(off.begin(), off.end()) > accuracy_) return false;
    for (std::size_t s = 0; s < off.size(); ++s) error_[s] = std::max(error_[s], off[s] / 4);
    return true;
  }

  Refined result() {
    Refined out{{}, std::move(signals_), std::move(error_)};
    for (const Column& c : columns_) out.omega.push_back(c.omega);
    for (std::size_t i = 0; i < out.signals.size() * headings_; ++i)
      for (const Column& c : columns_) out.signals[i / headings_].values.push_back(c.values[i]);
    return out;
  }

  std::size_t headings_;
  double accuracy_;
  const std::function<std::vector<ComplexSignal>(const std::vector<double>&)>& at_;
  std::vector<Column> columns_;
  std::vector<ComplexSignal> signals_;  // without values
  std::vector<double> largest_, error_;
};

}  // namespace

Refined refined(const std::vector<double>& omega, std::size_t headings, double accuracy,
                const std::function<std::vector<ComplexSignal>(const std::vector<double>&)>& at) {
  return Refinement(headings, accuracy, at).from(omega);
}

}  // namespace froude
