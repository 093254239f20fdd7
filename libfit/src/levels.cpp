#include "fit/levels.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "dynamics/line/path.hpp"
#include "fit/sensor.hpp"

namespace fit {
namespace {

/// Samples first … last on one level.
struct FlatPart {
  std::size_t first, last;
  double level;
};

std::vector<FlatPart> flat_parts(std::span<const double> values, double step) {
  std::vector<FlatPart> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (out.empty() || std::abs(values[i] - out.back().level) > step / 2) out.push_back({i, i, values[i]});
    out.back().last = i;
  }
  return out;
}

/// What is known of the signal: its value by the place among the samples.
using Knots = std::map<double, double>;

double middle_of(const FlatPart& part) { return 0.5 * static_cast<double>(part.first + part.last); }

Knots known_places(const std::vector<FlatPart>& parts) {
  Knots out{{static_cast<double>(parts.front().first), parts.front().level},
            {static_cast<double>(parts.back().last), parts.back().level}};
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    const FlatPart &here = parts[k], &next = parts[k + 1];
    out[static_cast<double>(here.last) + 0.5] = (here.level + next.level) / 2;
    const bool goes_through = k > 0 && (here.level > parts[k - 1].level) == (next.level > here.level);
    if (goes_through) out[middle_of(here)] = here.level;
  }
  return out;
}

std::vector<double> spline_at_samples(const Knots& knots, std::size_t samples) {
  std::vector<double> places;
  std::vector<Eigen::Vector3d> values;
  for (const auto& [place, value] : knots) {
    places.push_back(place);
    values.emplace_back(value, 0, 0);
  }
  const dynamics::line::SplinePath spline(std::move(places), values);
  std::vector<double> out;
  for (std::size_t i = 0; i < samples; ++i) out.push_back(spline.at(static_cast<double>(i)).position.x());
  return out;
}

/// Holds the spline at the level amid each stretch between knots in which it leaves the level by more than half a step.
void hold_at_levels(const std::vector<FlatPart>& parts, const std::vector<double>& curve, double step, Knots& knots) {
  constexpr double rounding = 1 + 1e-9;
  Knots more;
  for (const FlatPart& part : parts)
    for (std::size_t i = part.first; i <= part.last; ++i) {
      if (std::abs(curve[i] - part.level) <= rounding * step / 2) continue;
      const auto after = knots.upper_bound(static_cast<double>(i));
      if (after == knots.begin() || after == knots.end()) continue;
      const double amid = (std::prev(after)->first + after->first) / 2;
      const bool apart = after->first - std::prev(after)->first > 1;  // closer than samples they tell nothing
      if (apart && amid >= static_cast<double>(part.first) && amid <= static_cast<double>(part.last))
        more.emplace(amid, part.level);
    }
  knots.merge(more);
}

}  // namespace

std::optional<LevelCurve> through_levels(std::span<const double> values) {
  const auto quantisation = find_quantisation(values);
  if (!quantisation) return {};
  const double step = quantisation->step;
  const std::vector<FlatPart> parts = flat_parts(values, step);
  Knots knots = known_places(parts);
  LevelCurve out{spline_at_samples(knots, values.size()), step, parts.size(), 0, 0};
  for (std::size_t before = 0; before != knots.size();) {
    before = knots.size();
    hold_at_levels(parts, out.values, step, knots);
    if (knots.size() != before) out.values = spline_at_samples(knots, values.size());
  }
  out.knots = knots.size();
  for (std::size_t i = 0; i < values.size(); ++i)
    out.largest_change = std::max(out.largest_change, std::abs(out.values[i] - values[i]) / step);
  return out;
}

}  // namespace fit
