#include "synth_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hydro::waves {
namespace {

// How far beyond z = 0 a tangent may go on, m.
double longest_tangent(Stretching stretching, const FieldBox& box, double crest) {
  if (stretching == Stretching::linear) return std::max(0.0, std::min(box.high.z(), crest));
  return stretching == Stretching::delta ? 0.3 * crest : 0;
}

}  // namespace

BinBand band_of(const HarmonicField& field) {
  BinBand out;
  for (const Harmonic& w : field.harmonics()) {
    out.omega = std::max(out.omega, std::abs(w.omega));
    if (const double k = std::hypot(w.kx, w.ky); k > out.kappa) {
      out.kappa = k;
      out.along = Eigen::Vector2d(w.kx, w.ky) / k;
    }
  }
  for (const Harmonic& w : field.harmonics())
    if (std::abs(w.kx * out.along.y() - w.ky * out.along.x()) > 1e-15 * out.kappa) out.long_crested = false;
  if (!out.long_crested) out.along = {0, 1};
  return out;
}

void require_box(const FieldBox& box, double depth) {
  require(std::isfinite(box.start_s) && std::isfinite(box.end_s) && box.start_s <= box.end_s,
          "a table needs a start before its end, got {} s and {} s", box.start_s, box.end_s);
  require(box.low.allFinite() && box.high.allFinite() && (box.low.array() <= box.high.array()).all(),
          "a table needs a low corner below its high one, got ({}, {}, {}) m and ({}, {}, {}) m", box.low.x(),
          box.low.y(), box.low.z(), box.high.x(), box.high.y(), box.high.z());
  require(box.low.z() >= -depth, "a table from z = {} m reaches below the bed at z = {} m", box.low.z(), -depth);
}

std::pair<double, double> profile_heights(const HarmonicField& field, const FieldBox& box, double crest, double kappa) {
  const double depth = field.water().depth.metres();
  double bottom = box.low.z(), top = box.high.z();
  if (field.options().stretching != Stretching::none) top = std::min(top, 0.0);
  if (field.options().stretching == Stretching::wheeler) bottom = (bottom - crest) / (1 + crest / depth);
  if (field.options().stretching == Stretching::delta)  // the layer's lower end is the lowest that a point can go
    bottom = std::min(bottom, std::max(-depth, std::min(bottom, -0.5 * field.options().hs_m)));
  bottom = std::max(-depth, std::min(bottom, top));
  const double thinnest = kappa > 0 ? std::min(0.1 / kappa, depth) : std::min(1.0, depth);
  if (top - bottom < thinnest) bottom = std::max(-depth, top - thinnest), top = std::max(top, bottom + thinnest);
  return {bottom, top};
}

double sum_of(const HarmonicField& field, std::complex<double> Harmonic::*member) {
  double sum = 0;
  for (const Harmonic& w : field.harmonics()) sum += std::abs(w.*member);
  return sum;
}

double rms_elevation(const HarmonicField& field) {
  double sum = 0;
  for (const Harmonic& w : field.harmonics()) sum += 0.5 * std::norm(w.elevation);
  return std::sqrt(sum);
}

VerticalBasis vertical_basis(const HarmonicField& field, const FieldBox& box, const BinBand& band, double crest,
                             double tolerance) {
  const auto [bottom, top] = profile_heights(field, box, crest, band.kappa);
  const Stretching stretching = field.options().stretching;
  const bool tangents = stretching == Stretching::linear || stretching == Stretching::delta;
  return {bottom, top, std::max(band.kappa, 1e-12), field.water().depth.metres(), tolerance, tangents};
}

FieldError elevation_bound(const HarmonicField& field, double relative) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {.elevation = relative * sum_of(field, &Harmonic::elevation),
          .velocity = none,
          .acceleration = none,
          .gradient = none,
          .dynamic_pressure = none};
}

// (W98)
FieldError bounds(const HarmonicField& field, const BinBand& band, double top, double relative, const FieldBox& box,
                  double crest) {
  const double depth = field.water().depth.metres(), rho = field.water().density;
  double potential = 0, current = 0;
  for (const Harmonic& w : field.harmonics())
    if (const double k = std::hypot(w.kx, w.ky); k > 0)
      potential += std::abs(w.potential) * depth_profile(k, depth, top).cosh;
  potential *= 1 + band.kappa * longest_tangent(field.options().stretching, box, crest);
  for (const double z : {box.low.z(), box.high.z(), 0.0}) current = std::max(current, field.current().at(z).norm());
  FieldError out = elevation_bound(field, relative);
  // Stretching reads the profile at a height that is off by the error of the elevation.
  const double e = relative + band.kappa * out.elevation, speed = std::numbers::sqrt2 * band.kappa * potential;
  out.velocity = e * speed;
  out.acceleration = band.omega * out.velocity;
  out.gradient = 2 * band.kappa * out.velocity;
  const double quadratic = field.options().pressure == PressureLaw::full ? 2 * speed : 0;
  out.dynamic_pressure = rho * (e * band.omega * potential + (current + quadratic) * out.velocity);
  return out;
}

}  // namespace hydro::waves
