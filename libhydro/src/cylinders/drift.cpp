#include "cylinders/drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/base/parallel.hpp"
#include "potential/control_surface.hpp"
#include "surface.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::Vector2cd;
using Eigen::Vector2d;
using potential::ControlPoint;

/// A mode's share of φ, of which Z_n(z) is left out, with its slopes along the water.
struct Local {
  Complex potential = 0;
  Vector2cd slope = Vector2cd::Zero();
};

/// The free way from a circle to the next, m; +∞ if it is alone.
double way_to_next(const std::vector<Cylinder>& circles, std::size_t of) {
  double way = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < circles.size(); ++c)
    if (c != of)
      way = std::min(way, (circles[c].centre - circles[of].centre).norm() - circles[c].radius - circles[of].radius);
  return way;
}

/// Where momentum is counted: half way to the next circle, but not farther than a radius.
double distance_counted(const std::vector<Cylinder>& circles, std::size_t of) {
  return std::min(circles[of].radius, way_to_next(circles, of) / 2);
}

/// So many that products of what arrives, which has its origin beyond the way to the next circle, are summed to 1e-9.
int points_counted(const std::vector<Cylinder>& circles, std::size_t of, double k, int orders) {
  constexpr double digits = 20;  // e⁻²⁰
  const double radius = circles[of].radius + distance_counted(circles, of);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < circles.size(); ++c)
    if (c != of) nearest = std::min(nearest, (circles[c].centre - circles[of].centre).norm());
  const double of_others = std::isinf(nearest) ? 0 : (digits + orders) / std::log(nearest / radius);
  return 2 * static_cast<int>(std::ceil(orders + k * radius + 10 * std::cbrt(k * radius) + of_others + 8));
}

/// Slopes of the functions Q_m(r) of (C4) from their neighbours of lower order, of order 0 from the next:
/// H⁽²⁾′_m = H⁽²⁾_{m−1} − (m/x) H⁽²⁾_m and K′_m = −K_{m−1} − (m/x) K_m, scaled as they are.
std::vector<Complex> slopes_of(const std::vector<Complex>& Q, const std::vector<double>& scale, double rate, bool wave,
                               double r) {
  std::vector<Complex> out(Q.size());
  out[0] = -rate * Q[1] * scale[1] / scale[0];
  for (std::size_t m = 1; m < Q.size(); ++m)
    out[m] = (wave ? rate : -rate) * Q[m - 1] * scale[m - 1] / scale[m] - static_cast<double>(m) / r * Q[m];
  return out;
}

/// What one circle sends out in mode n, `b` by order from −M to M, at a place `away` from its centre.
Local sent_by(const VerticalModes& modes, int n, double radius, std::vector<double> scale, int M,
              const Eigen::Ref<const Eigen::VectorXcd>& b, const Vector2d& away) {
  const double r = away.norm(), rate = n == 0 ? modes.k : modes.kappa[static_cast<std::size_t>(n - 1)];
  scale.resize(static_cast<std::size_t>(M + 1));
  scale.push_back(1);  // order 0 asks for the slope of the next
  const std::vector<Complex> Q = outgoing(modes, n, r, radius, scale), slope = slopes_of(Q, scale, rate, n == 0, r);
  const Complex turn(away.x() / r, away.y() / r);
  Local out;
  Complex along = 0, across = 0;  // ∂φ/∂r and ∂φ/∂θ/r
  Complex e = std::pow(turn, -M);
  for (int m = -M; m <= M; ++m, e *= turn) {
    const auto order = static_cast<std::size_t>(std::abs(m));
    const Complex amplitude = b(m + M) * e;
    out.potential += amplitude * Q[order];
    along += amplitude * slope[order];
    across += amplitude * Q[order] * Complex(0, m / r);
  }
  out.slope = {along * turn.real() - across * turn.imag(), along * turn.imag() + across * turn.real()};
  return out;
}

/// A unit wave less Z_0(z), of amplitude `amplitude`.
Local incident(double k, double heading, Complex amplitude, const Vector2d& at) {
  const Vector2d towards(std::cos(heading), std::sin(heading));
  const Complex phi = amplitude * std::polar(1.0, -k * at.dot(towards));
  return {phi, Complex(0, -k) * phi * towards};
}

/// ¼ρ(|∇φ|² − s|φ|²), s = k² or −κ²: all that pushes, as the rest of a mode's pressure and what the surface's rise
/// adds cancel.
double normal_part(const Local& at, double s, double density) {
  return density / 4 * (at.slope.squaredNorm() - s * std::norm(at.potential));
}

/// The wave that comes and all that the circles send out.
class PassingWaves {
 public:
  PassingWaves(const std::vector<Cylinder>& circles, const VerticalModes& modes, const Channels& channels,
               const Amplitudes& sent_out, const potential::FieldQuestion& question, const Water& water)
      : circles_(circles),
        modes_(modes),
        channels_(channels),
        at_(channels),
        heading_(question.heading),
        per_metre_(Complex(0, water.gravity / question.omega) / modes.wave_at_surface()),
        b_(per_metre_ * sent_out.col(0) + sent_out.col(1) + Complex(0, 1) * sent_out.col(2)) {
    for (const Cylinder& c : circles) scale_.push_back(radial_scales(modes, c.radius, channels));
  }

  /// By mode.
  std::vector<Local> at(const Vector2d& place) const {
    std::vector<Local> out(static_cast<std::size_t>(channels_.vertical()));
    out[0] = incident(modes_.k, heading_, per_metre_, place);
    for (std::size_t c = 0; c < circles_.size(); ++c) {
      const Vector2d away = place - circles_[c].centre;
      const int reach = modes_that_reach(modes_, away.norm() - circles_[c].radius, channels_.vertical());
      for (int n = 0; n < reach; ++n) {
        const auto mode = static_cast<std::size_t>(n);
        const int M = channels_.order[mode];
        const Local one =
            sent_by(modes_, n, circles_[c].radius, scale_[c][mode], M, b_.segment(at_(c, n, -M), 2 * M + 1), away);
        out[mode].potential += one.potential;
        out[mode].slope += one.slope;
      }
    }
    return out;
  }

 private:
  const std::vector<Cylinder>& circles_;
  const VerticalModes& modes_;
  const Channels& channels_;
  WaveIndex at_;
  double heading_;
  Complex per_metre_;
  Eigen::VectorXcd b_;
  std::vector<RadialScales> scale_;
};

/// What goes through a point, from the surface to the bed.
Eigen::Vector3d through(const ControlPoint& point, const Vector2d& about, const std::vector<Local>& here,
                        const VerticalModes& modes, double density) {
  const double mass = density * modes.depth;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < here.size(); ++n) {
    const double s = n == 0 ? modes.k * modes.k : -modes.kappa[n - 1] * modes.kappa[n - 1];
    sum += load_through(point, about, mass, here[n].slope, normal_part(here[n], s, mass));
  }
  return sum;
}

}  // namespace

double nearest_counted(const std::vector<Cylinder>& circles) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < circles.size(); ++c) nearest = std::min(nearest, distance_counted(circles, c));
  return nearest;
}

potential::BodyDrift body_drift(const std::vector<Cylinder>& circles, const std::vector<CircleOwner>& owner,
                                const VerticalModes& modes, const Channels& channels, const Amplitudes& sent_out,
                                const potential::FieldQuestion& question, const Water& water, int threads) {
  const PassingWaves waves(circles, modes, channels, sent_out, question, water);
  Eigen::MatrixX3d of_circle = Eigen::MatrixX3d::Zero(static_cast<Index>(circles.size()), 3);
  in_parallel(circles.size(), threads, [&](std::size_t of) {
    const double radius = circles[of].radius + distance_counted(circles, of);
    const int points = points_counted(circles, of, modes.k, channels.highest_order());
    for (const ControlPoint& point : potential::circle(circles[of].centre, radius, points))
      of_circle.row(static_cast<Index>(of)) +=
          through(point, owner[of].about, waves.at(point.at), modes, water.density).transpose();
  });

  potential::BodyDrift out{.load = Eigen::MatrixX3d::Zero(question.motion.size() / 6, 3)};
  for (std::size_t c = 0; c < circles.size(); ++c) {
    out.load.row(static_cast<Index>(owner[c].body)) += of_circle.row(static_cast<Index>(c));
    out.length = std::max(
        out.length, (circles[c].centre - owner[c].about).norm() + circles[c].radius + distance_counted(circles, c));
  }
  return out;
}

}  // namespace hydro::cylinders
