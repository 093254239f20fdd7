// Two runs beside each other.
#include <algorithm>
#include <cmath>
#include <optional>

#include "hydro/base/error.hpp"
#include "report/contents.hpp"

namespace froude::html {
namespace {

/// A series at a time within its record, by a straight line between its samples.
class Interpolated {
 public:
  Interpolated(const std::vector<double>& time, const std::vector<double>& values) : time_(time), values_(values) {}
  /// Times must rise from call to call.
  double at(double t) {
    while (next_ + 1 < time_.size() && time_[next_] < t) ++next_;
    const std::size_t before = next_ - 1;
    const double share = (t - time_[before]) / (time_[next_] - time_[before]);
    return values_[before] + share * (values_[next_] - values_[before]);
  }

 private:
  const std::vector<double>&time_, &values_;
  std::size_t next_ = 1;
};

struct Spread {
  double n = 0, sum = 0, squares = 0, low = INFINITY, high = -INFINITY;
  void add(double v) {
    n += 1, sum += v, squares += v * v;
    low = std::min(low, v), high = std::max(high, v);
  }
  double mean() const { return sum / n; }
  double deviation() const { return std::sqrt(std::max(0.0, squares / n - mean() * mean())); }
};

std::optional<Json> row_of(const RunResult& a, const RunResult& b, const Signal& of, const Signal& other, double from) {
  Interpolated second(b.time, other.values);
  Spread first_spread, second_spread;
  double squares = 0, largest = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i) {
    const double t = a.time[i];
    if (t < std::max(from, b.time.front()) || t > b.time.back()) continue;
    const double x = of.values[i], y = second.at(t);
    if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    first_spread.add(x), second_spread.add(y);
    squares += (x - y) * (x - y), largest = std::max(largest, std::abs(x - y));
  }
  if (first_spread.n < 2) return std::nullopt;
  const auto told = [](const Spread& s) {
    return Json{{"mean", s.mean()}, {"deviation", s.deviation()}, {"least", s.low}, {"largest", s.high}};
  };
  return Json{{"signal", of.name},
              {"unit", of.units},
              {"first", told(first_spread)},
              {"second", told(second_spread)},
              {"rms", std::sqrt(squares / first_spread.n)},
              {"largest_difference", largest}};
}

}  // namespace

Json run_difference(const std::filesystem::path& first, const std::filesystem::path& second, const Options& options) {
  const RunResult a = read_run(first), b = read_run(second);
  Json rows = Json::array();
  for (const Signal& of : a.signals) {
    const auto other =
        std::find_if(b.signals.begin(), b.signals.end(), [&](const Signal& s) { return s.name == of.name; });
    if (other == b.signals.end() || other->units != of.units || b.time.size() < 2) continue;
    if (auto row = row_of(a, b, of, *other, options.from)) rows.push_back(std::move(*row));
  }
  return {{"first", first.filename().string()}, {"second", second.filename().string()}, {"rows", rows}};
}

}  // namespace froude::html
