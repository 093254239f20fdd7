#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bessel.hpp"
#include "hydro/base/parallel.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

double depth_function_at_surface(const VerticalModes& modes, int n) {
  return n == 0 ? modes.wave_at_surface()
                : modes.cos_at_surface(n) / std::sqrt(modes.norm(modes.kappa[static_cast<std::size_t>(n - 1)]));
}

}  // namespace

std::vector<Complex> outgoing(const VerticalModes& modes, int n, double r, double radius,
                              const std::vector<double>& scale) {
  std::vector<Complex> Q(scale.size());
  if (n == 0) {
    hankel_2_sequence(modes.k * r, Q);
    for (std::size_t m = 0; m < Q.size(); ++m) Q[m] /= scale[m];
    return Q;
  }
  const double kappa = modes.kappa[static_cast<std::size_t>(n - 1)], weaker = std::exp(-kappa * (r - radius));
  std::vector<double> K(scale.size());
  bessel_k_scaled_sequence(kappa * r, K);
  for (std::size_t m = 0; m < Q.size(); ++m) Q[m] = weaker * K[m] / scale[m];
  return Q;
}

int modes_that_reach(const VerticalModes& modes, double distance, int vertical) {
  constexpr double weakest = 37;  // e⁻³⁷: rounding
  int n = 1;
  while (n < vertical && modes.kappa[static_cast<std::size_t>(n - 1)] * distance < weakest) ++n;
  return n;
}

std::vector<bool> outside(const std::vector<Cylinder>& cylinders, const Eigen::MatrixX2d& point) {
  std::vector<bool> out;
  for (Index p = 0; p < point.rows(); ++p)
    out.push_back(std::none_of(cylinders.begin(), cylinders.end(), [&](const Cylinder& c) {
      return (point.row(p).transpose() - c.centre).norm() < c.radius;
    }));
  return out;
}

double nearest_outside(const std::vector<Cylinder>& cylinders, const Eigen::MatrixX2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Index p = 0; p < point.rows(); ++p)
    for (const Cylinder& c : cylinders)
      if (const double off = (point.row(p).transpose() - c.centre).norm() - c.radius; off >= 0)
        nearest = std::min(nearest, off);
  return nearest;
}

MatrixXcd potentials_at_surface(const std::vector<Cylinder>& cylinders, const VerticalModes& modes,
                                const Channels& channels, const Amplitudes& sent_out, const Eigen::MatrixX2d& point,
                                const std::vector<bool>& known, int from, int to, int threads) {
  const WaveIndex at(channels);
  std::vector<RadialScales> scale;
  for (const Cylinder& c : cylinders) scale.push_back(radial_scales(modes, c.radius, channels));
  MatrixXcd out = MatrixXcd::Zero(point.rows(), sent_out.cols());
  const auto waves_at = [&](std::size_t p) {
    const auto row = static_cast<Index>(p);
    Eigen::RowVectorXcd sum = Eigen::RowVectorXcd::Zero(sent_out.cols());
    for (std::size_t c = 0; c < cylinders.size(); ++c) {
      const Eigen::Vector2d away = point.row(row).transpose() - cylinders[c].centre;
      const double r = away.norm(), theta = std::atan2(away.y(), away.x());
      const int reach = modes_that_reach(modes, r - cylinders[c].radius, to);
      for (int n = from; n < reach; ++n) {
        const int M = channels.order[static_cast<std::size_t>(n)];
        std::vector<double> scales = scale[c][static_cast<std::size_t>(n)];
        scales.resize(static_cast<std::size_t>(M + 1));
        const std::vector<Complex> Q = outgoing(modes, n, r, cylinders[c].radius, scales);
        const double Z = depth_function_at_surface(modes, n);
        for (int m = -M; m <= M; ++m)
          sum += Z * Q[static_cast<std::size_t>(std::abs(m))] * std::polar(1.0, m * theta) * sent_out.row(at(c, n, m));
      }
    }
    out.row(row) = sum;
  };
  in_parallel(known.size(), threads, [&](std::size_t p) {
    if (known[p]) waves_at(p);
  });
  return out;
}

Eigen::MatrixXd velocities_of(const potential::FieldQuestion& question) {
  const Eigen::VectorXcd velocity = Complex(0, question.omega) * question.motion;
  Eigen::MatrixXd out(velocity.size(), 2);
  out.col(0) = velocity.real();
  out.col(1) = velocity.imag();
  return out;
}

// About the global origin, in which phases are told.
std::vector<double> angles_around(const std::vector<Cylinder>& cylinders, double heading, double k, int orders) {
  double extent = 0;
  for (const Cylinder& c : cylinders) extent = std::max(extent, c.centre.norm());
  return potential::angles_around(heading, k, extent, orders);
}

potential::FarField far_field_of(std::vector<double> angle, const MatrixXcd& f, const VerticalModes& modes,
                                 const Water& water, double omega) {
  const Complex elevation = Complex(0, -omega / water.gravity) * modes.wave_at_surface();
  return {
      .angle = std::move(angle), .scattered = f.col(0), .radiated = elevation * (f.col(1) + Complex(0, 1) * f.col(2))};
}

// η = −(iω/g) φ; the unit wave has the elevation Z_0(0) per iω/g.
potential::WaveField field_of(const MatrixXcd& at_surface, const VerticalModes& modes, const Water& water,
                              const potential::FieldQuestion& question, std::vector<bool> known) {
  const Complex elevation = Complex(0, -question.omega / water.gravity);
  return {.incident = potential::incident_elevation(question.point, modes.k, question.heading),
          .scattered = at_surface.col(0) / modes.wave_at_surface(),
          .radiated = elevation * (at_surface.col(1) + Complex(0, 1) * at_surface.col(2)),
          .known = std::move(known)};
}

}  // namespace hydro::cylinders
