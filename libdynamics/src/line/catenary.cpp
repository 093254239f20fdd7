#include "dynamics/line/catenary.hpp"

#include <Eigen/LU>

#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// V at the lower end of the part that hangs, and the length that rests.
struct Ends {
  double lower, resting;

  Ends(const LineProperties& line, double V) : lower(V - line.weight * line.length), resting(0) {
    if (!line.on_bed || lower >= 0) return;
    resting = -lower / line.weight;
    lower = 0;
  }
};

/// ∂(x, z)/∂(H, V): symmetric, since both are derivatives of the complementary energy.
Matrix2d flexibility(const LineProperties& line, double H, double V) {
  const Ends e(line, V);
  const double w = line.weight, EA = line.axial_stiffness;
  const double upper_tension = std::hypot(H, V), lower_tension = std::hypot(H, e.lower);
  const double xx = (std::asinh(V / H) - std::asinh(e.lower / H) - V / upper_tension + e.lower / lower_tension) / w +
                    line.length / EA;
  const double xz = (H / upper_tension - H / lower_tension) / w;
  const double zz = (V / upper_tension - e.lower / lower_tension) / w + (V - e.lower) / (w * EA);
  return (Matrix2d() << xx, xz, xz, zz).finished();
}

/// Elastic energy and weight times height, (D62). `span_x` is not needed: the integrals are closed in V.
double energy(const LineProperties& line, double H, double V) {
  const Ends e(line, V);
  const double w = line.weight, EA = line.axial_stiffness, v = e.lower;
  const auto area = [&](double at) {  // ∫ √(H² + v²) dv
    return 0.5 * (at * std::hypot(H, at) + (H > 0 ? H * H * std::asinh(at / H) : 0));
  };
  const double cubes = (V * V * V - v * v * v) / 3;
  const double elastic = (H * H * line.length + cubes / w) / (2 * EA);
  const double raised = (area(V) - area(v) - (V - v) * std::hypot(H, v)) / w + (cubes - v * v * (V - v)) / (2 * EA * w);
  return elastic + raised;
}

/// The line stands straight up from the bed to the fairlead, the rest lies about: no horizontal pull.
LineTension hanging(const LineProperties& line, double z) {
  const double EA = line.axial_stiffness, w = line.weight;
  const double up = EA / w * (std::sqrt(1 + 2 * w * z / EA) - 1);  // ℓ + wℓ²/2EA = z
  LineTension out{0, w * up, 0, line.length - up, 0, Matrix2d::Zero()};
  out.stored = energy(line, 0, out.vertical);
  out.stiffness(1, 1) = w / (1 + w * up / EA);
  return out;
}

/// Newton from the start of Jonkman (2007, app. B) for (H, V); false where it does not get there.
bool newton(const LineProperties& line, const Vector2d& span, Vector2d& tension) {
  const double chord = span.norm(), w = line.weight;
  double lambda = 0.2;
  if (line.length > chord && span.x() > 0)
    lambda = std::sqrt(3 * ((line.length * line.length - span.y() * span.y()) / (span.x() * span.x()) - 1));
  tension = {w * span.x() / (2 * lambda), w / 2 * (span.y() / std::tanh(lambda) + line.length)};
  const double tolerance = 1e-12 * line.length;
  Vector2d open = catenary_span(line, tension.x(), tension.y()) - span;
  for (int i = 0; i < 100; ++i) {
    if (open.norm() <= tolerance) return true;
    const Vector2d step = flexibility(line, tension.x(), tension.y()).inverse() * -open;
    double factor = 1;
    for (; factor > 1e-8; factor /= 2) {
      const Vector2d trial = tension + factor * step;
      if (!(trial.x() > 0)) continue;
      const Vector2d left = catenary_span(line, trial.x(), trial.y()) - span;
      if (!(left.norm() < open.norm())) continue;
      tension = trial;
      open = left;
      break;
    }
    // At round-off nothing falls any more: spans are differences of numbers as large as T/w.
    if (factor <= 1e-8) return open.norm() <= 100 * (tolerance + 2e-16 * tension.norm() / w);
  }
  return false;
}

template <class F>
double root(F rising, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (rising(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// z rises with V at any H, and x with H along that curve.
Vector2d bisection(const LineProperties& line, const Vector2d& span) {
  const double w = line.weight, EA = line.axial_stiffness,
               most = 4 * (EA * (1 + span.norm() / line.length) + w * line.length);
  const auto vertical = [&](double H) {
    return root([&](double V) { return catenary_span(line, H, V).y() - span.y(); }, line.on_bed ? 0.0 : -most, most);
  };
  const double log_H =
      root([&](double log) { return catenary_span(line, std::exp(log), vertical(std::exp(log))).x() - span.x(); },
           std::log(1e-12 * w * line.length), std::log(most));
  return {std::exp(log_H), vertical(std::exp(log_H))};
}

}  // namespace

double LineTension::fairlead() const { return std::hypot(horizontal, vertical); }
double LineTension::anchor() const { return std::hypot(horizontal, anchor_vertical); }

// (D60), and with `lower` = 0 and a part that rests (D61).
Vector2d catenary_span(const LineProperties& line, double H, double V) {
  const Ends e(line, V);
  const double w = line.weight, EA = line.axial_stiffness;
  const double x = e.resting + H / w * (std::asinh(V / H) - std::asinh(e.lower / H)) + H * line.length / EA;
  const double z = (std::hypot(H, V) - std::hypot(H, e.lower)) / w + (V * V - e.lower * e.lower) / (2 * EA * w);
  return {x, z};
}

LineTension catenary(const LineProperties& line, double x, double z) {
  hydro::require(line.length > 0 && line.weight > 0 && line.axial_stiffness > 0,
                 "a line needs length, weight in water and axial stiffness, got {} m, {} N/m, {} N", line.length,
                 line.weight, line.axial_stiffness);
  if (line.on_bed) {
    if (!(z >= 0))
      throw hydro::NumericsError(
          fmt::format("the fairlead of a line is {:.4g} m under the bed that its anchor lies on", -z));
    const LineTension slack = hanging(line, z);
    if (x <= slack.resting) return slack;
  }
  if (!(x > 0)) throw hydro::NumericsError("a line hangs with both ends above one another: its pull has no direction");
  const Vector2d span(x, z);
  Vector2d T;
  if (!newton(line, span, T)) T = bisection(line, span);
  const Ends e(line, T.y());
  return {T.x(), T.y(), e.lower, e.resting, energy(line, T.x(), T.y()), flexibility(line, T.x(), T.y()).inverse()};
}

}  // namespace dynamics
