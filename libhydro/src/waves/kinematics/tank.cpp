#include "hydro/waves/kinematics/tank.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/signal/fft.hpp"
#include "hydro/waves/dispersion.hpp"
#include "waves/imaginary.hpp"

namespace hydro::waves {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

void check(const Tank& tank) {
  require(std::isfinite(tank.length_m) && tank.length_m > 0,
          "the length of a tank must be finite and positive, got {} m", tank.length_m);
  require(!tank.water.depth.is_infinite(), "a wave tank has a bed: its depth must be finite");
  const double r = tank.reflections.far_end;
  require(r >= 0 && r <= 1, "the reflection of a beach lies between 0 and 1, got {}", r);
  require(tank.reflections.round_trips >= 0, "the number of round trips must not be negative, got {}",
          tank.reflections.round_trips);
  require(tank.evanescent_modes >= 0, "the number of evanescent modes must not be negative, got {}",
          tank.evanescent_modes);
  require(tank.stretching != Stretching::delta,
          "a wave tank offers no delta stretching, which needs the Hs of a sea; use vertical, wheeler or linear");
}

// ∫ s Z dz and ∫ Z² dz over the depth, (W72).
struct Projection {
  double onto_shape, norm;
  double coefficient() const { return onto_shape / norm; }
};

// Z = cosh k(z+h)/cosh kh. With b the moving height of the paddle and l its arm,
//   ∫ s Z dz = [tanh kh − (1 − b/l) sinh k(h−b)/cosh kh]/k − (1 − cosh k(h−b)/cosh kh)/(l k²).
Projection travelling_projection(double k, double h, double arm) {
  const double b = std::min(arm, h), kh = k * h;
  const double T = std::tanh(kh), sech2 = (1 - T) * (1 + T);
  // 1 − cosh k(h−b)/cosh kh = 2 sinh(kh − kb/2) sinh(kb/2)/cosh kh, which has no cancellation.
  const double drop = std::expm1(-2 * kh + k * b) * std::expm1(-k * b) / (1 + std::exp(-2 * kh));
  const double sill = (1 - b / arm) * depth_profile(k, h, -b).sinh;
  return {(T - sill) / k - drop / (arm * k * k), 0.5 * (h * sech2 + T / k)};
}

// Z = cos κ(z+h); the same integral with k = iκ.
Projection evanescent_projection(double kappa, double h, double arm) {
  const double b = std::min(arm, h);
  const double shape = (std::sin(kappa * h) - (1 - b / arm) * std::sin(kappa * (h - b))) / kappa +
                       (std::cos(kappa * h) - std::cos(kappa * (h - b))) / (arm * kappa * kappa);
  return {shape, 0.5 * h * (1 + std::sin(2 * kappa * h) / (2 * kappa * h))};
}

// The n-th root of κh tan κh = −ω²h/g, (W71): κh = nπ − δ with tan δ = X/(nπ − δ), 0 < δ < π/2.
double evanescent_wavenumber(int n, double omega, const Water& water) {
  const double h = water.depth.metres(), X = omega * omega * h / water.gravity, middle = n * pi;
  double low = 0, high = pi / 2;
  double delta = std::atan(X / middle);
  for (int step = 0; step < 60; ++step) {
    const double f = (middle - delta) * std::sin(delta) - X * std::cos(delta);  // rises with δ
    (f < 0 ? low : high) = delta;
    const double slope = (middle - delta) * std::cos(delta) + (X - 1) * std::sin(delta);
    double next = delta - f / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - delta) <= 1e-16 * middle) break;
    delta = next;
  }
  return (middle - delta) / h;
}

}  // namespace

Paddle Paddle::flap(double hinge_z) {
  require(std::isfinite(hinge_z) && hinge_z < 0, "the hinge of a flap lies below the still water, got z = {} m",
          hinge_z);
  return Paddle(-hinge_z);
}

double Paddle::shape(double z) const noexcept { return std::max(0.0, 1 + z / arm_); }

TankMode::TankMode(const Tank& tank, double omega)
    : omega_(omega),
      k_(wavenumber(omega, tank.water)),
      depth_(tank.water.depth.metres()),
      length_(tank.length_m),
      gravity_(tank.water.gravity),
      far_end_(tank.reflections.far_end) {
  check(tank);
  // (W74): u at the paddle is iω c₀ Z₀ for one metre of it; −ik A = iω c₀ without reflection.
  unreflected_ = -omega_ / k_ * travelling_projection(k_, depth_, tank.paddle.arm()).coefficient();
  const Complex loop = far_end_ * std::polar(1.0, -2 * k_ * length_);  // there and back
  Complex trips = 1;
  if (tank.reflections.paddle == PaddleMode::reflecting) {
    const double resonance = std::abs(1.0 - loop);
    if (tank.reflections.round_trips == std::numeric_limits<int>::max()) {
      require(resonance > 1e-9, "a tank of {} m resonates at {} rad/s: with a wall at its end there is no steady state",
              tank.length_m, omega_);
      trips = 1.0 / (1.0 - loop);
    } else {
      trips = resonance > 1e-9 ? (1.0 - std::pow(loop, tank.reflections.round_trips + 1)) / (1.0 - loop)
                               : Complex(tank.reflections.round_trips + 1);
    }
  }
  outgoing_ = unreflected_ * trips;
  returning_ = far_end_ * outgoing_ * std::polar(1.0, -k_ * length_);
  for (int n = 1; n <= tank.evanescent_modes; ++n) {
    const double kappa = evanescent_wavenumber(n, omega_, tank.water);
    const double c = evanescent_projection(kappa, depth_, tank.paddle.arm()).coefficient();
    kappa_.push_back(kappa);
    // (W75): reflected by the far end as the travelling mode is; exact for a wall.
    amplitude_.push_back(-imaginary * omega_ * c / (kappa * (1 - far_end_ * std::exp(-2 * kappa * length_))));
  }
}

Complex TankMode::elevation(double x) const {
  // ζ = −(1/g) ∂φ/∂t at z = 0.
  return -imaginary * omega_ / gravity_ * flow(x, 0).phi;
}

Complex TankMode::biesel() const { return -imaginary * omega_ / gravity_ * unreflected_; }

TankMode::Flow TankMode::flow(double x, double z, double tangent) const {
  const Complex out = outgoing_ * std::polar(1.0, -k_ * x), back = returning_ * std::polar(1.0, -k_ * (length_ - x));
  DepthProfile p = depth_profile(k_, depth_, z);
  if (tangent > 0) p = {p.cosh + tangent * k_ * p.sinh, p.sinh + tangent * k_ * p.cosh};
  const Complex sum = out + back, difference = -imaginary * k_ * (out - back);
  Flow f{sum * p.cosh, difference * p.cosh, k_ * sum * p.sinh, -k_ * k_ * sum * p.cosh, k_ * difference * p.sinh};
  for (std::size_t n = 0; n < kappa_.size(); ++n) {
    const double kappa = kappa_[n];
    if (kappa * std::min(x, 2 * length_ - x) > 45) break;  // e^{−45} = 3e-20, and the next are smaller still
    const double near = std::exp(-kappa * x), far = far_end_ * std::exp(-kappa * (2 * length_ - x));
    double c = std::cos(kappa * (z + depth_)), s = std::sin(kappa * (z + depth_));
    if (tangent > 0) {
      const double c0 = c;
      c -= tangent * kappa * s;
      s += tangent * kappa * c0;
    }
    const Complex even = amplitude_[n] * (near + far), odd = -kappa * amplitude_[n] * (near - far);
    f.phi += even * c;
    f.u += odd * c;
    f.w -= kappa * even * s;
    f.u_x += kappa * kappa * even * c;
    f.u_z -= kappa * odd * s;
  }
  return f;
}

WaveTank::WaveTank(const Tank& tank, std::vector<RecordHarmonic> paddle_motion)
    : tank_(tank), motion_(std::move(paddle_motion)) {
  check(tank_);
  require(!motion_.empty(), "the motion of a paddle needs at least one harmonic, got none");
  for (const RecordHarmonic& h : motion_) {
    require(std::isfinite(h.amplitude.real()) && std::isfinite(h.amplitude.imag()),
            "the paddle's amplitude at {} rad/s is not finite", h.omega);
    modes_.emplace_back(tank_, h.omega);
  }
}

namespace {

void require_inside(double x, double length) {
  require(x >= 0 && x <= length, "x = {} m lies outside the tank, which goes from 0 to {} m", x, length);
}

}  // namespace

double WaveTank::elevation(double t, double x, double) const {
  require_inside(x, tank_.length_m);
  double sum = 0;
  for (std::size_t n = 0; n < modes_.size(); ++n)
    sum += (modes_[n].elevation(x) * motion_[n].amplitude * std::polar(1.0, motion_[n].omega * t)).real();
  return sum;
}

Kinematics WaveTank::at(double t, const Eigen::Vector3d& point) const {
  const double h = tank_.water.depth.metres();
  require_inside(point.x(), tank_.length_m);
  require(point.z() >= -h, "a point at z = {} m lies below the bed at z = {} m", point.z(), -h);
  Kinematics out{};
  out.velocity.setZero();
  out.acceleration.setZero();
  out.gradient.setZero();
  out.elevation = elevation(t, point.x());
  const StretchedHeight height = stretched_height(tank_.stretching, point.z(), out.elevation, h, 0);
  for (std::size_t n = 0; n < modes_.size(); ++n) {
    const Complex motion = motion_[n].amplitude * std::polar(1.0, motion_[n].omega * t);
    const TankMode::Flow f = modes_[n].flow(point.x(), height.z, height.tangent);
    const Complex rate = imaginary * motion_[n].omega * motion;
    out.velocity += Eigen::Vector3d((f.u * motion).real(), 0, (f.w * motion).real());
    out.acceleration += Eigen::Vector3d((f.u * rate).real(), 0, (f.w * rate).real());
    const double xx = (f.u_x * motion).real(), xz = (f.u_z * motion).real();
    out.gradient += (Eigen::Matrix3d() << xx, 0, xz, 0, 0, 0, xz, 0, -xx).finished();
    out.dynamic_pressure -= tank_.water.density * (f.phi * rate).real();
  }
  return out;
}

double WaveTank::paddle(double t) const {
  double sum = 0;
  for (const RecordHarmonic& h : motion_) sum += (h.amplitude * std::polar(1.0, h.omega * t)).real();
  return sum;
}

RecordSpectrum record_spectrum(std::span<const double> samples, double dt, double rest, const Band& band) {
  require(!samples.empty(), "a record needs at least one sample, got none");
  require(std::isfinite(dt) && dt > 0, "a time step must be finite and positive, got {} s", dt);
  require(std::isfinite(rest) && rest >= 0, "the rest after a record must be finite and not negative, got {} s", rest);
  require(band.omega_min >= 0 && band.omega_min < band.omega_max && band.omega_max < pi / dt,
          "a band needs 0 <= omega_min < omega_max < pi/dt = {} rad/s, got {} and {} rad/s", pi / dt, band.omega_min,
          band.omega_max);
  for (std::size_t n = 0; n < samples.size(); ++n)
    require(std::isfinite(samples[n]), "sample {} of the record is not finite", n + 1);
  std::vector<double> padded(samples.begin(), samples.end());
  padded.resize(samples.size() + static_cast<std::size_t>(std::ceil(rest / dt)), 0.0);
  const auto count = static_cast<double>(padded.size());
  const std::vector<Complex> X = signal::real_fft(padded);
  RecordSpectrum out{.harmonics = {}, .repetition_s = count * dt, .fraction_left_out = 0};
  double all = 0, kept = 0;
  for (std::size_t j = 0; j < X.size(); ++j) {
    const bool once = j == 0 || 2 * j == padded.size();
    const double energy = std::norm(X[j]) * (once ? 1 : 2), omega = 2 * pi * static_cast<double>(j) / (count * dt);
    all += energy;
    if (j == 0 || omega < band.omega_min || omega > band.omega_max) continue;
    kept += energy;
    out.harmonics.push_back({omega, 2.0 / count * X[j]});
  }
  require(!out.harmonics.empty(), "no frequency of a record of {} s lies between {} and {} rad/s", count * dt,
          band.omega_min, band.omega_max);
  out.fraction_left_out = all > 0 ? 1 - kept / all : 0;
  return out;
}

double arrival_time(const Water& water, const Band& band, double x) {
  return x / std::min(group_velocity(band.omega_max, water),
                      group_velocity(std::max(band.omega_min, 1e-6 * band.omega_max), water));
}

std::vector<RecordHarmonic> paddle_motion_for(const Tank& tank, std::span<const RecordHarmonic> elevation, double x) {
  require_inside(x, tank.length_m);
  std::vector<RecordHarmonic> motion;
  for (const RecordHarmonic& wanted : elevation) {
    const Complex transfer = TankMode(tank, wanted.omega).elevation(x);
    if (!(std::abs(transfer) > 1e-6))
      throw InputError(fmt::format("at {} rad/s the paddle raises the water at x = {} m by only {:.2g} m per metre",
                                   wanted.omega, x, std::abs(transfer)),
                       {}, "leave out this frequency, or look at another place");
    motion.push_back({wanted.omega, wanted.amplitude / transfer});
  }
  return motion;
}

}  // namespace hydro::waves
