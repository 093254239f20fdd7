#include "fit/problem/radiation.hpp"

#include <algorithm>
#include <cmath>

#include "telling.hpp"

namespace fit::radiation {
namespace {

constexpr std::size_t least_for_poles = 5;

/// What the record's own force makes of the motion, |C − ω²(M + A)| and ωB together, over the larger of what stiffness
/// and mass make of it.
double share_of_load(const RadiationPoint& p, const RestoredBody& body) {
  const double squared = p.omega * p.omega, inertia = squared * (body.mass + middle(p.added_mass));
  return std::hypot(body.stiffness - inertia, p.omega * middle(p.damping)) /
         std::max(body.stiffness, squared * body.mass);
}

/// (F119) A load cell that feels next to nothing of what mass and stiffness ask for, away from the one frequency where
/// they balance, or a body that is lighter than nothing in the water, has other units than the table says.
void require_units_that_agree(const Problem& problem, const std::vector<Point>& points) {
  constexpr double nothing = 0.05;  // of stiffness and mass: within 3 % of the natural frequency alone
  constexpr double apart = 1.2;     // of two frequencies, which then cannot both be natural ones
  const RestoredBody& body = problem.body;
  if (!(body.mass > 0)) return;  // of a force without the body's inertia A is what it is
  const auto wrong = [&](const Point& p, const std::string& what) {
    throw hydro::InputError(
        fmt::format("{}: motion and force do not go together with the body's mass and stiffness", what),
        {.file = p.source.file.string()},
        "look at the units of motion and force in the header, cm under [m] or kN under [N], and at mass and stiffness");
  };
  const bool all_small =
      std::all_of(points.begin(), points.end(), [&](const Point& p) { return share_of_load(p.point, body) < nothing; });
  for (const Point& p : points) {
    const auto& [low, high] = p.point.added_mass.interval;
    const bool negative = is_surely_negative(p.point.added_mass.interval);
    if (high + body.mass < 0)
      wrong(p, fmt::format("mass and added mass together come out negative at {:.4g} rad/s ({:.5g} at most)",
                           p.point.omega, high + body.mass));
    if (all_small && (negative || points.back().point.omega > apart * points.front().point.omega))
      wrong(p, fmt::format("the force is {:.2g} % of what mass and stiffness ask for at {:.4g} rad/s, and added mass "
                           "comes out as {:.5g} to {:.5g}",
                           100 * share_of_load(p.point, body), p.point.omega, low, high));
  }
}

/// (F79) Still water takes energy from a motion, and gives none back.
std::optional<Refusal> refusal_of(const std::vector<Point>& points) {
  for (const Point& p : points) {
    const auto& [low, high] = p.point.damping.interval;
    if (!is_surely_negative(p.point.damping.interval)) continue;
    return drives_the_motion(
        fmt::format("damping comes out negative at {:.4g} rad/s ({:.3g} to {:.3g})", p.point.omega, low, high),
        p.source);
  }
  return {};
}

/// (F105) A − C/ω² + M and B are proportional to force over motion.
RadiationPoint with_slopes(const Problem& problem, RadiationPoint p) {
  const SlopeError slope = slope_error_of({{problem.force_slope, 1}, {problem.motion_slope, -1}});
  const RestoredBody& body = problem.body;
  count_slope(slope, middle(p.added_mass) + body.mass - body.stiffness / (p.omega * p.omega), p.added_mass);
  count_slope(slope, middle(p.damping), p.damping);
  return p;
}

std::optional<RadiationMemory> memory_of(const std::vector<Point>& points, double confidence) {
  if (points.size() < least_for_poles) return {};
  std::vector<RadiationPoint> all;
  for (const Point& p : points) all.push_back(p.point);
  return fit_radiation_memory(all, confidence);
}

Report told(const Point& of, const Units& unit) {
  const RadiationPoint& p = of.point;
  Report report = begin_run(of.source);
  report.heading = fmt::format(
      "{}: {:.4g} rad/s, amplitude {:.4g} {}; harmonics of the force: second {:.2g} %, third {:.2g} %; rest {:.3g} {} "
      "rms",
      of.source.name(), p.omega, p.amplitude, unit.motion, 100 * p.second_harmonic, 100 * p.third_harmonic,
      p.residual_rms, unit.force);
  append(report.facts, {{"omega_rad_s", p.omega},
                        {"amplitude", p.amplitude},
                        {"second_harmonic", p.second_harmonic},
                        {"third_harmonic", p.third_harmonic},
                        {"residual_rms", p.residual_rms}});
  report.estimates = {{p.added_mass, unit.added_mass}, {p.damping, unit.damping}};
  report.warn(p.caution);
  return report;
}

void add_poles(const hydro::radiation::PoleModel& kernel, Report& report) {
  std::vector<Facts> all;
  for (std::size_t k = 0; k < kernel.poles.size(); ++k) {
    const auto& [decay, omega] = kernel.poles[k];
    all.push_back(
        {{"decay_1_s", decay}, {"omega_rad_s", omega}, {"cosine", kernel.C[k](0, 0)}, {"sine", kernel.S[k](0, 0)}});
    report.say("pole: decays by {:.4g}/s, turns by {:.4g} rad/s", decay, omega);
  }
  if (!all.empty()) report.facts.emplace_back("pole", std::move(all));
}

Report told(const RadiationMemory& m, const Units& unit, double confidence) {
  Report report{.key = "memory"};
  if (!m.refused.empty()) {
    report.heading = "memory: none: " + m.refused;
    report.facts = {{"why_not", m.refused}};
    return report;
  }
  const auto& r = m.poles.report;
  const double limit = m.poles.A_inf(0, 0);
  report.heading = fmt::format(
      "memory: order {}, {}; differs from the points by {:.2g} of the largest damping, they are known to {:.2g}; {}",
      r.order, r.why, r.error, m.tolerance, r.passive ? "passive" : "not certified passive");
  report.facts = {{"order", r.order},     {"error", r.error},          {"known_to", m.tolerance},
                  {"passive", r.passive}, {"added_mass_limit", limit}, {"why", r.why}};
  if (m.limit.value) report.facts.emplace_back("added_mass_limit_interval", m.limit.interval);
  report.say("added mass at infinite frequency {:.5g} {}, {}", limit, unit.added_mass,
             m.limit.value ? fmt::format("{:g} % interval {:.5g} to {:.5g}", 100 * confidence, m.limit.interval.low,
                                         m.limit.interval.high)
                           : "without interval: " + m.limit.why_not);
  add_poles(m.poles.model, report);
  return report;
}

}  // namespace

Units units_of(bool turns) {
  if (turns) return {"rad", "N m", "kg m^2", "N m s/rad"};
  return {"m", "N", "kg", "N s/m"};
}

Solution solve(const Problem& problem) {
  const double confidence = problem.options.confidence;
  const Units unit = units_of(problem.turns);
  Solution out;
  for (const Run& run : problem.runs)
    out.points.push_back({run.source, of_run(run.source, [&] {
                            if (problem.turns) require_within_half_a_turn(run.motion);
                            return with_slopes(
                                problem, fit_radiation(run.time, run.motion, run.force, problem.body, confidence));
                          })});
  std::sort(out.points.begin(), out.points.end(),
            [](const Point& a, const Point& b) { return a.point.omega < b.point.omega; });
  require_units_that_agree(problem, out.points);
  Report& report = out.report;
  report.refused = refusal_of(out.points);
  if (report.refused) return out;
  out.memory = memory_of(out.points, confidence);
  report.heading = "F = -(M + A) a - B v - C x, what the load cells carry of a body moved in still water";
  if (out.points.size() == 1) {  // what a scene of motion may include
    const RadiationPoint& p = out.points[0].point;
    report.facts = {{"coefficients", Facts{{"added_mass", *p.added_mass.value}, {"damping", *p.damping.value}}}};
  }
  for (const Point& p : out.points) report.parts.push_back(told(p, unit));
  if (out.memory) report.parts.push_back(told(*out.memory, unit, confidence));
  return out;
}

}  // namespace fit::radiation
