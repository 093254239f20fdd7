#include "hydro/waves/kinematics/field.hpp"

#include <algorithm>
#include <cmath>

#include "waves/imaginary.hpp"

namespace hydro::waves {

DepthProfile depth_profile(double kappa, double depth, double z) {
  // cosh κ(z+h)/cosh κh and sinh κ(z+h)/cosh κh with e^{κh} divided out, (W12).
  const double growth = std::exp(kappa * z);
  const double mirrored = std::exp(-2 * kappa * (z + depth));  // 0 in infinitely deep water
  const double denominator = 1 + std::exp(-2 * kappa * depth);
  return {growth * (1 + mirrored) / denominator, -growth * std::expm1(-2 * kappa * (z + depth)) / denominator};
}

void WaveField::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  require(points.size() == out.size(), "{} points need as many places for the answer, got {}", points.size(),
          out.size());
  for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(t, points[i]);
}

StretchedHeight stretched_height(Stretching stretching, double z, double elevation, double depth, double hs) {
  switch (stretching) {
    case Stretching::none:
      return {z, 0};
    case Stretching::vertical:
      return {std::min(z, 0.0), 0};
    case Stretching::wheeler:  // ζ/h = 0 in infinite depth
      return {std::min((z - elevation) / (1 + elevation / depth), 0.0), 0};
    case Stretching::linear:
      return {std::min(z, 0.0), std::max(z, 0.0)};
    case Stretching::delta:
      break;
  }
  // (W15): the layer from −d to the surface is mapped onto −d … 0.3 ζ; below it nothing changes.
  const double layer = std::min(hs / 2, depth);
  if (z <= -layer || elevation <= -layer) return {std::min(z, 0.0), 0};
  const double mapped = (z + layer) * (layer + 0.3 * elevation) / (layer + elevation) - layer;
  return {std::min(mapped, 0.0), std::max(mapped, 0.0)};
}

HarmonicField::HarmonicField(std::vector<Harmonic> harmonics, const Water& water, const Options& options,
                             Current current)
    : harmonics_(std::move(harmonics)), water_(water), options_(options), current_(std::move(current)) {
  for (const Harmonic& w : harmonics_)
    require(std::isfinite(w.omega) && std::isfinite(w.kx) && std::isfinite(w.ky) &&
                std::isfinite(std::abs(w.elevation)) && std::isfinite(std::abs(w.potential)),
            "a wave with omega {} rad/s and wave vector ({}, {}) rad/m is not finite", w.omega, w.kx, w.ky);
  require(options_.stretching != Stretching::delta || options_.hs_m > 0,
          "delta stretching needs the significant wave height of the sea");
}

double HarmonicField::elevation(double t, double x, double y) const {
  double sum = 0;
  for (const Harmonic& w : harmonics_) {
    const double angle = w.omega * t - w.kx * x - w.ky * y;
    sum += w.elevation.real() * std::cos(angle) - w.elevation.imag() * std::sin(angle);
  }
  return sum;
}

namespace {

using Complex = std::complex<double>;

// One harmonic's part of ∇φ, ∂∇φ/∂t, ∇∇φ and ∂φ/∂t at the height that stretching has chosen, (W17).
struct Sums {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), acceleration = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  double potential_rate = 0;

  void add(const Harmonic& w, double kappa, const DepthProfile& profile, Complex turn) {
    const Complex phi = w.potential * turn;
    const Complex c = phi * profile.cosh, s = phi * profile.sinh;
    const Complex ux = -imaginary * w.kx * c, uy = -imaginary * w.ky * c, uz = kappa * s;
    velocity += Eigen::Vector3d(ux.real(), uy.real(), uz.real());
    const Complex rate = imaginary * w.omega;
    acceleration += Eigen::Vector3d((rate * ux).real(), (rate * uy).real(), (rate * uz).real());
    potential_rate += (rate * c).real();
    const double xx = -w.kx * w.kx * c.real(), yy = -w.ky * w.ky * c.real(), xy = -w.kx * w.ky * c.real();
    const double xz = (-imaginary * w.kx * kappa * s).real(), yz = (-imaginary * w.ky * kappa * s).real();
    gradient += (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, -xx - yy).finished();
  }
};

}  // namespace

Kinematics HarmonicField::at(double t, const Eigen::Vector3d& point) const {
  const double h = water_.depth.metres();
  require(point.z() >= -h, "a point at z = {} m lies below the bed at z = {} m", point.z(), -h);
  thread_local std::vector<Complex> turn;  // its room is kept, so that the steps of a run ask for none
  turn.resize(harmonics_.size());
  Kinematics out{};
  for (std::size_t n = 0; n < turn.size(); ++n) {
    const Harmonic& w = harmonics_[n];
    turn[n] = std::polar(1.0, w.omega * t - w.kx * point.x() - w.ky * point.y());
    out.elevation += (w.elevation * turn[n]).real();
  }
  const StretchedHeight height = stretched_height(options_.stretching, point.z(), out.elevation, h, options_.hs_m);
  Sums sums;
  for (std::size_t n = 0; n < turn.size(); ++n) {
    const Harmonic& w = harmonics_[n];
    const double kappa = std::hypot(w.kx, w.ky);
    // Without a wave vector there is no flow, but a pressure: the bound wave of two that run against each other.
    DepthProfile profile = kappa == 0 ? DepthProfile{1, 0} : depth_profile(kappa, h, height.z);
    if (height.tangent > 0)  // the profile goes on as its tangent at z = 0
      profile = {profile.cosh + height.tangent * kappa * profile.sinh,
                 profile.sinh + height.tangent * kappa * profile.cosh};
    sums.add(w, kappa, profile, turn[n]);
  }
  const Eigen::Vector2d U = current_.at(point.z()), shear = current_.gradient(point.z());
  const Eigen::Vector3d wave = sums.velocity;
  out.velocity = wave + Eigen::Vector3d(U.x(), U.y(), 0);
  out.acceleration = sums.acceleration;
  out.gradient = sums.gradient;
  out.gradient.col(2) += Eigen::Vector3d(shear.x(), shear.y(), 0);
  const double convection = U.x() * wave.x() + U.y() * wave.y();
  out.dynamic_pressure = -water_.density * (sums.potential_rate + convection);
  if (options_.pressure == PressureLaw::full)
    out.dynamic_pressure += water_.density * (options_.bernoulli_constant - 0.5 * wave.squaredNorm());
  return out;
}

}  // namespace hydro::waves
