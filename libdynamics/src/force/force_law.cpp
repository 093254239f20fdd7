#include "dynamics/force/force_law.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/force/damper.hpp"

namespace dynamics {
namespace {

/// Of the table, straight between its points and beyond its ends; energy from x = 0.
SpringDamperForce tabulated(const std::vector<double>& xs, const std::vector<double>& fs, double x) {
  const auto segment = [&](double at) {
    const auto above = std::upper_bound(xs.begin() + 1, xs.end() - 1, at) - xs.begin();
    return static_cast<std::size_t>(above) - 1;
  };
  const auto slope = [&](std::size_t i) { return (fs[i + 1] - fs[i]) / (xs[i + 1] - xs[i]); };
  const auto force = [&](double at) {
    const std::size_t i = segment(at);
    return fs[i] + slope(i) * (at - xs[i]);
  };
  SpringDamperForce out{.force = force(x), .by_x = slope(segment(x))};
  // ∫ from 0 to x by trapezia, exact between corners.
  double from = std::min(0.0, x), sum = 0;
  const double to = std::max(0.0, x);
  for (const double corner : xs) {
    if (corner <= from || corner >= to) continue;
    sum += (force(from) + force(corner)) / 2 * (corner - from);
    from = corner;
  }
  sum += (force(from) + force(to)) / 2 * (to - from);
  out.stored = x >= 0 ? sum : -sum;
  return out;
}

SpringDamperForce spring(const LineLaw& law, double x, double k1) {
  if (!law.table_x.empty()) return tabulated(law.table_x, law.table_force, x);
  const double x2 = x * x;
  return {.force = (k1 + law.cubic * x2) * x,
          .by_x = k1 + 3 * law.cubic * x2,
          .stored = (k1 / 2 + law.cubic / 4 * x2) * x2};
}

}  // namespace

double LineLaw::stiffest() const {
  if (table_x.empty()) return stiffness;
  double out = 0;
  for (std::size_t i = 0; i + 1 < table_x.size(); ++i)
    out = std::max(out, (table_force[i + 1] - table_force[i]) / (table_x[i + 1] - table_x[i]));
  return out;
}

double PtoLaw::stiffest() const {
  return line.stiffest() + std::max(lower ? lower->stiffness : 0, upper ? upper->stiffness : 0);
}

SpringDamperForce LineLaw::at(double x, double rate, double k1) const {
  if (tension_only && x <= 0) return {};
  SpringDamperForce out = spring(*this, x, k1);
  const double damper = damper_force(damping, quadratic_damping, rate, std::abs(rate));
  const double damper_by_rate = damping + 2 * quadratic_damping * std::abs(rate);
  if (!tension_only) {
    out.force += damper;
    out.by_rate = damper_by_rate;
    out.dissipated = damper * rate;
    return out;
  }
  // (D51): as large as the damper's own force, but never above the spring's, so that the sum never pushes.
  const double pull = out.force, sum = pull + std::abs(damper);
  const double taken = sum > 0 ? pull * damper / sum : 0;
  out.dissipated = taken * rate;
  out.force += taken;
  if (sum > 0) {
    out.by_x *= 1 + damper * std::abs(damper) / (sum * sum);
    out.by_rate = damper_by_rate * pull * pull / (sum * sum);
  }
  return out;
}

namespace {

/// Behind a stop, seen along `side` = ±1.
void add_stop(const EndStop& stop, double side, double x, double rate, SpringDamperForce& out) {
  const LineLaw law{.stiffness = stop.stiffness, .damping = stop.damping, .tension_only = true};
  const SpringDamperForce a = law.at(side * (x - stop.at), side * rate);
  out.force += side * a.force;
  out.by_x += a.by_x;
  out.by_rate += a.by_rate;
  out.stored += a.stored;
  out.dissipated += a.dissipated;
}

}  // namespace

PtoLaw::Working PtoLaw::at(double x, double rate) const {
  Working out;
  static_cast<SpringDamperForce&>(out) = line.at(x, rate);
  const double elastic = out.force + preload - (rate != 0 ? out.dissipated / rate : 0);
  out.force += preload;
  out.stored += preload * x;
  if (std::abs(out.force) > force_limit) {
    out.force = std::copysign(force_limit, out.force);
    out.by_x = out.by_rate = 0;
    const double lost = (out.force - elastic) * rate;  // (D52)
    out.dissipated = std::max(0.0, lost);
    out.supplied = std::max(0.0, -lost);
  }
  if (upper) add_stop(*upper, 1, x, rate, out);
  if (lower) add_stop(*lower, -1, x, rate, out);
  return out;
}

}  // namespace dynamics
