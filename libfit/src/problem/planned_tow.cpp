#include "fit/problem/planned_tow.hpp"

#include <limits>
#include <utility>

#include "fit/problem/towing.hpp"
#include "planned.hpp"

namespace fit {
namespace {

constexpr int fewest_at_speed = 128;  // the half of a steady part that may be cut still holds 64

void check(const PlannedTow& plan) {
  check_noise(plan.noise, plan.memory);
  hydro::require(plan.speed > 0 && std::isfinite(plan.speed), "the speed must be positive, got {} m/s", plan.speed);
  hydro::require(plan.acceleration > 0 && std::isfinite(plan.acceleration),
                 "the acceleration must be positive, got {} m/s²", plan.acceleration);
  hydro::require(plan.step > 0 && std::isfinite(plan.step), "samples must be a time apart, got {} s", plan.step);
}

/// A tow from rest to rest as it would be recorded, so long at one speed.
RawTow made(const PlannedTow& plan, int seconds, const hydro::RandomStream& random) {
  const double rest = 1, ramp = plan.speed / plan.acceleration, whole = 2 * (rest + ramp) + seconds;
  const auto n = static_cast<std::size_t>(std::llround(whole / plan.step));
  const std::vector<double> noise = noise_with_memory(n, plan.noise, plan.memory, plan.step, random);
  const double drag = towing_point(plan.cylinder, {plan.speed, 0, 1, 0}).cd;  // of one newton
  RawTow out;
  out.force.push_back({"force", {}, {}});
  for (std::size_t i = 0; i < n; ++i) {
    const double t = plan.step * static_cast<double>(i), moving = std::min(t, whole - t) - rest,
                 share = std::clamp(moving / ramp, 0.0, 1.0);
    out.time.push_back(t);
    out.speed.push_back(plan.speed * share);
    out.force[0].values.push_back(plan.cd / drag * share * share + noise[i]);
  }
  return out;
}

}  // namespace

PlannedTime told_by(const PlannedTow& plan, int seconds, int seeds, std::uint64_t seed) {  // (F99)
  check(plan);
  hydro::require(seconds >= fewest_at_speed * plan.step,
                 "a planned tow needs {} samples at one speed, and {} s hold {:.0f}", fewest_at_speed, seconds,
                 seconds / plan.step);
  hydro::require(seeds >= 1, "a plan needs one made record at least, got {}", seeds);
  std::vector<double> widths;
  double held = 0, refused = 0;
  for (int s = 0; s < seeds; ++s) {
    towing::Problem problem{.cylinder = plan.cylinder,
                            .runs = {},
                            .records = {{{"made"}, made(plan, seconds, {seed, static_cast<std::uint64_t>(s)})}},
                            .options = {.confidence = plan.confidence}};
    try {
      const Interval cd = towing::solve(problem).records[0].cd.interval;
      widths.push_back((cd.high - cd.low) / 2);
      held += cd.low < plan.cd && plan.cd < cd.high;
    } catch (const hydro::InputError&) {  // the plan itself was checked: this noise is taken for a force that settles
      widths.push_back(std::numeric_limits<double>::infinity());
      ++refused;
    }
  }
  const double told = seeds - refused, share = told > 0 ? held / told : 0, level = plan.confidence,
               chance = std::sqrt(level * (1 - level) / std::max(told, 1.0));
  return {seconds, median_of_widths(widths), share, refused / seeds, share >= level - 2 * chance};
}

std::vector<PlannedTime> times_for(const PlannedTow& plan, double width, int most, int seeds) {  // (F99)
  check(plan);
  hydro::require(width > 0 && std::isfinite(width), "the half width of an interval must be positive, got {}", width);
  const int first = std::max(3, static_cast<int>(std::ceil(fewest_at_speed * plan.step)));
  hydro::require(most >= first, "a time is looked for from {} s on, and {} s are the most", first, most);
  return lengths_until(
      first, most, [&](int seconds) { return told_by(plan, seconds, seeds); },
      [&](const PlannedTime& t) { return t.holds && t.half_width <= width; },
      [](const PlannedTime& t) { return t.seconds; });
}

}  // namespace fit
