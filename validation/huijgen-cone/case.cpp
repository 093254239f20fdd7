#include <cmath>
#include <numbers>

#include "dynamics/line/stepper.hpp"
#include "harness/case.hpp"
#include "support/line_models.hpp"

namespace froude::validation::huijgen_cone {
namespace {

namespace dl = dynamics::line;
constexpr double g = 9.81, polar = std::numbers::pi / 8, pi = std::numbers::pi;

struct Path {
  std::vector<double> x, y, radius;
  double period = 0, apsidal = 0;  ///< between two outermost places
};

/// 40 s from the outermost place; what nods is timed by where the bob's vertical velocity passes zero downwards.
Path run(double rate, double h, double duration) {
  const dl::Line line(support::pendulums(1));
  dl::State s = support::in_plane(line, {pi / 2 - polar});
  s.velocity(1, 1) = rate * std::sin(polar);
  dl::Stepper stepper(line, {});
  stepper.start(s);
  Path out;
  const auto vertical = [&] { return stepper.balance(s)->acceleration(2, 1); };
  double turned = 0, before_v = 0, before_a = vertical();
  const auto steps = static_cast<int>(std::lround(duration / h));
  for (int i = 0; i < steps; ++i) {
    stepper.step(s, h);
    const double a = vertical();
    const double angle = std::atan2(s.position(1, 1), s.position(0, 1)), v = s.velocity(2, 1);
    const double now = turned + std::remainder(angle - turned, 2 * pi);
    const double r = std::hypot(s.position(0, 1), s.position(1, 1));
    out.x.push_back(s.position(0, 1));
    out.y.push_back(s.position(1, 1));
    out.radius.push_back(r);
    if (out.period == 0 && before_v > 0 && v <= 0) {
      // Hermite's cubic of the vertical velocity, its zero by bisection; the angle runs by its own rate L_z/r².
      double low = 0, high = 1;
      for (int k = 0; k < 60; ++k) {
        const double q = (low + high) / 2, p = 1 - q;
        const double value =
            p * p * (1 + 2 * q) * before_v + q * p * p * h * before_a + q * q * (3 - 2 * q) * v - q * q * p * h * a;
        (value > 0 ? low : high) = q;
      }
      // At the outermost place the radius is stationary, so the rate of the angle is constant to second order.
      out.period = (i + low) * h;
      const double turn_rate = rate * std::sin(polar) * std::sin(polar) / (r * r);
      out.apsidal = now - turn_rate * (1 - low) * h;
    }
    turned = now;
    before_v = v;
    before_a = a;
  }
  return out;
}

struct Exact {
  double period, apsidal;
};

/// u = z/L: u̇² = (2g/L)(ε − u)(1 − u²) − l², l = sin²θ φ̇, with roots u₁ < u₂ < 1 < u₃; u = u₁ + (u₂ − u₁) sin²ψ.
Exact elliptic(double rate) {
  const double l = std::sin(polar) * std::sin(polar) * rate, start = -std::cos(polar);
  const double energy = l * l / (1 - start * start) / (2 * g) + start;  // ε, L = 1
  // One root is the start; the other two solve u² + (start − ε) u − 1 − ... = 0 by division of the cubic.
  const double b = start - energy, c = start * start - energy * start - 1;
  const double root = std::sqrt(b * b / 4 - c), other = -b / 2 - root, u3 = -b / 2 + root;
  const double u1 = std::min(start, other), u2 = std::max(start, other);
  const double k = std::sqrt((u2 - u1) / (u3 - u1)), scale = 4 / std::sqrt(2 * g * (u3 - u1));
  return {scale * std::comp_ellint_1(k), scale * l / 2 *
                                             (std::comp_ellint_3(k, (u2 - u1) / (1 - u1)) / (1 - u1) +
                                              std::comp_ellint_3(k, -(u2 - u1) / (1 + u1)) / (1 + u1))};
}

double extrapolated(double coarse, double fine) { return (4 * fine - coarse) / 3; }

}  // namespace

Outcome outcome(const Folders&) {
  const double cone = std::sqrt(g / std::cos(polar)), rosette = std::sqrt(g * std::cos(polar));
  const Path circle = run(cone, 0.01, 40), rose = run(rosette, 0.01, 8);
  double off = 0, least = 1;
  for (const double r : circle.radius) off = std::max(off, std::abs(r - std::sin(polar)));
  for (const double r : rose.radius) least = std::min(least, r / std::sin(polar));
  const Path coarse = run(rosette, 2e-3, 3), fine = run(rosette, 1e-3, 3);
  const Exact exact = elliptic(rosette);
  return {.numbers = {{"radius of the circle at 3.25857 rad/s, largest change in 40 s, step 0.01 s", off, "m"},
                      {"period of nodding at 3.0105 rad/s, relative to elliptic integrals",
                       extrapolated(coarse.period, fine.period) / exact.period - 1, ""},
                      {"apsidal angle at 3.0105 rad/s, relative to elliptic integrals",
                       extrapolated(coarse.apsidal, fine.apsidal) / exact.apsidal - 1, ""},
                      {"smallest radius of the rosette, relative to the largest", least, ""},
                      {"period of nodding at 3.0105 rad/s", exact.period, "s"},
                      {"apsidal angle at 3.0105 rad/s", exact.apsidal, "rad"}},
          .pictures = {{"path",
                        "Seen from above: a circle at 3.25857 rad/s, a rosette at the rate of the source.",
                        {.title = "A pendulum at 22.5 deg",
                         .panels = {{.x = {.label = "x", .unit = "m"},
                                     .y = {.label = "y", .unit = "m"},
                                     .series = {{.name = "3.0105 rad/s, 8 s", .x = rose.x, .y = rose.y},
                                                {.name = "3.25857 rad/s, 40 s", .x = circle.x, .y = circle.y}}}},
                         .width = 700,
                         .panel_height = 540}}}};
}

}  // namespace froude::validation::huijgen_cone
