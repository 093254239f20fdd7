#include "hydro/waves/synthesis/second_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "waves/imaginary.hpp"

namespace hydro::waves {
namespace {

using Complex = std::complex<double>;

FreeWave negated(const FreeWave& w) { return {-w.sigma, -w.kx, -w.ky}; }

FreeWave free_wave(const Component& c) { return {c.sigma, c.k * std::cos(c.heading), c.k * std::sin(c.heading)}; }

// (W66): the set-down under a long group, per |E|².
double set_down(double sigma, double kappa, const Water& water) {
  if (water.depth.is_infinite()) return 0;
  const double h = water.depth.metres(), g = water.gravity;
  const double c_g = group_velocity(std::abs(sigma), water), c = std::abs(sigma) / kappa;
  const double two_kh = 2 * kappa * h;
  return -g * (0.5 * two_kh / std::sinh(two_kh) + c_g / c) / (g * h - c_g * c_g);
}

// Two waves that are one but for rounding and turned round: their sum has neither frequency nor length.
bool cancel(const FreeWave& one, const FreeWave& two) {
  constexpr double rounding = 1e-12;
  return std::abs(one.sigma + two.sigma) <= rounding * std::abs(one.sigma) &&
         std::hypot(one.kx + two.kx, one.ky + two.ky) <= rounding * std::hypot(one.kx, one.ky);
}

}  // namespace

PairKernel pair_kernel(const FreeWave& one, const FreeWave& two, const Water& water) {
  require(std::isfinite(one.sigma) && std::isfinite(two.sigma) && one.sigma != 0 && two.sigma != 0,
          "waves that interact need frequencies that are finite and not zero, got {} and {} rad/s", one.sigma,
          two.sigma);
  if (cancel(one, two)) return {set_down(one.sigma, std::hypot(one.kx, one.ky), water), 0};
  const double g = water.gravity;
  const double R1 = one.sigma * one.sigma / g, R2 = two.sigma * two.sigma / g;
  const double kx = one.kx + two.kx, ky = one.ky + two.ky, kappa = std::hypot(kx, ky);
  const double sigma = one.sigma + two.sigma;
  const double dot = one.kx * two.kx + one.ky * two.ky;
  // (W64): right-hand sides of the dynamic and of the kinematic condition; the latter is −i times `flux`.
  const double dynamic = 0.5 * g * g / (one.sigma * two.sigma) * (R1 * R2 - dot) + 0.5 * g * (R1 + R2);
  const double flux =
      0.5 * g * (kx * (one.kx / one.sigma + two.kx / two.sigma) + ky * (one.ky / one.sigma + two.ky / two.sigma));
  const double stiffness = kappa == 0 ? 0.0 : g * kappa * std::tanh(kappa * water.depth.metres());
  const double potential = (sigma * dynamic - g * flux) / (stiffness - sigma * sigma);
  return {(dynamic + sigma * potential) / g, potential};  // (W65)
}

PairKernel sum_kernel(const FreeWave& one, const FreeWave& two, const Water& water) {
  return pair_kernel(one, two, water);
}

PairKernel difference_kernel(const FreeWave& one, const FreeWave& two, const Water& water) {
  return pair_kernel(one, negated(two), water);
}

namespace {

void require_no_shear(const Sea& sea) {
  if (!sea.current().is_none() && !sea.current().is_uniform())
    throw InputError("bound waves are known in still water and in a uniform current, not in a sheared one", {},
                     "use a uniform current, or leave out the second order");
}

/// A component with what the pairs need of it; E holds its phase.
struct Partner {
  FreeWave wave;
  double omega;
  Complex E;

  Partner conjugate() const { return {negated(wave), -omega, std::conj(E)}; }
};

std::vector<Partner> partners(const Sea& sea) {
  std::vector<Partner> out;
  for (const Component& c : sea.components()) out.push_back({free_wave(c), c.omega, std::polar(c.amplitude, c.phase)});
  return out;
}

// The bound harmonic of a pair, turned so that its frequency is not negative.
Harmonic bound(const Partner& one, const Partner& two, double ordering, const Water& water) {
  const PairKernel kernel = pair_kernel(one.wave, two.wave, water);
  const Complex product = ordering * one.E * two.E;
  Harmonic h{.omega = one.omega + two.omega,
             .kx = one.wave.kx + two.wave.kx,
             .ky = one.wave.ky + two.wave.ky,
             .elevation = kernel.elevation * product,
             .potential = imaginary * kernel.potential * product};
  if (h.omega < 0) h = {-h.omega, -h.kx, -h.ky, std::conj(h.elevation), std::conj(h.potential)};
  return h;
}

// Calls `use` with the bound harmonic of every pair (n, m >= n) that `parts` asks for. A wave with itself has half of
// the kernel, for it stands once in the double sum where pairs stand twice; its difference with itself is the mean
// (W67).
template <class Use>
void for_each_pair(const std::vector<Partner>& waves, const BoundParts& parts, const Water& water, const Use& use) {
  for (std::size_t n = 0; n < waves.size(); ++n)
    for (std::size_t m = n; m < waves.size(); ++m) {
      if (parts.sums) use(n, m, +1, bound(waves[n], waves[m], m == n ? 0.5 : 1.0, water));
      if (!parts.differences || m == n) continue;
      const Partner turned = waves[m].conjugate();
      if (!cancel(waves[n].wave, turned.wave)) use(n, m, -1, bound(waves[n], turned, 1.0, water));
    }
}

}  // namespace

BoundWaves bound_harmonics(const Sea& sea, const BoundOptions& options) {
  require_no_shear(sea);
  require(options.energy_left_out >= 0 && options.energy_left_out < 1,
          "the share of energy left out must lie between 0 and 1, got {}", options.energy_left_out);
  BoundWaves out{};
  for_each_pair(partners(sea), options.parts, sea.water(), [&](std::size_t, std::size_t, int, const Harmonic& h) {
    out.harmonics.push_back(h);
    out.variance += std::norm(h.elevation) / 2;
  });
  out.pairs = out.harmonics.size();
  if (options.energy_left_out == 0 || out.variance == 0) return out;
  std::ranges::stable_sort(out.harmonics, std::ranges::greater{},
                           [](const Harmonic& h) { return std::norm(h.elevation); });
  double left = 0;
  while (!out.harmonics.empty()) {
    const double weakest = std::norm(out.harmonics.back().elevation) / 2;
    if (left + weakest > options.energy_left_out * out.variance) break;
    left += weakest;
    out.harmonics.pop_back();
  }
  out.energy_left_out = left / out.variance;
  return out;
}

double second_order_bernoulli(const Sea& sea) {
  double K = 0;
  for (const Component& c : sea.components()) {
    if (sea.water().depth.is_infinite()) continue;
    const double two_kh = 2 * c.k * sea.water().depth.metres();
    K += 0.5 * sea.water().gravity * c.k * c.amplitude * c.amplitude / std::sinh(two_kh);
  }
  return K;
}

double second_order_skewness(const Sea& sea) {
  require_no_shear(sea);
  const auto& components = sea.components();
  double third = 0;
  for_each_pair(partners(sea), {}, sea.water(), [&](std::size_t n, std::size_t m, int sign, const Harmonic& h) {
    // (W68): 3 E[ζ₁²ζ₂]; h.elevation times the pair in ζ₁², in phase with it.
    const Complex one = std::polar(components[n].amplitude, components[n].phase);
    Complex two = std::polar(components[m].amplitude, components[m].phase);
    if (sign < 0) two = std::conj(two);
    Complex product = one * two * (m == n ? 0.5 : 1.0);
    if (sign < 0 && components[n].omega < components[m].omega) product = std::conj(product);
    third += 1.5 * (h.elevation * std::conj(product)).real();
  });
  const double sigma = sea.hs() / 4;
  return third / (sigma * sigma * sigma);
}

HarmonicField second_order_field(const Sea& sea, const BoundOptions& bound, HarmonicField::Options options) {
  std::vector<Harmonic> all = harmonics(sea);
  const BoundWaves second = bound_harmonics(sea, bound);
  all.insert(all.end(), second.harmonics.begin(), second.harmonics.end());
  options.pressure = PressureLaw::full;
  options.bernoulli_constant = second_order_bernoulli(sea);
  if (std::isnan(options.hs_m)) options.hs_m = sea.hs();
  return {std::move(all), sea.water(), options, sea.current()};
}

BoundAtPoint bound_at_point(const Sea& sea, const Eigen::Vector3d& point, const BoundParts& parts) {
  require_no_shear(sea);
  const double h = sea.water().depth.metres();
  require(point.allFinite() && point.z() <= 0 && point.z() >= -h,
          "bound waves are summed at heights from the bed at {} m to the still water, got z = {} m", -h, point.z());
  const auto index = sea.grid_index();
  if (index.empty())
    throw InputError("the bound waves of a sea that never repeats have no grid to be summed on", {},
                     "discretise the sea on an FFT grid, or use bound_harmonics()");
  const std::size_t bins = 2 * *std::ranges::max_element(index) + 1;
  BoundAtPoint out{.repetition_s = sea.repetition_s(),
                   .elevation = std::vector<Complex>(bins),
                   .u = std::vector<Complex>(bins),
                   .v = std::vector<Complex>(bins),
                   .w = std::vector<Complex>(bins)};
  const auto add = [&](std::size_t n, std::size_t m, int sign, const Harmonic& b) {
    const std::size_t low = std::min(index[n], index[m]), high = std::max(index[n], index[m]);
    const std::size_t bin = sign > 0 ? low + high : high - low;
    const Complex turn = std::polar(1.0, -b.kx * point.x() - b.ky * point.y());
    out.elevation[bin] += b.elevation * turn;
    const double kappa = std::hypot(b.kx, b.ky);
    if (kappa == 0) return;
    const DepthProfile profile = depth_profile(kappa, h, point.z());
    const Complex phi = b.potential * turn;
    out.u[bin] += -imaginary * b.kx * profile.cosh * phi;
    out.v[bin] += -imaginary * b.ky * profile.cosh * phi;
    out.w[bin] += kappa * profile.sinh * phi;
  };
  for_each_pair(partners(sea), parts, sea.water(), add);
  return out;
}

std::vector<double> BoundAtPoint::series(std::span<const Complex> bins, const TimeGrid& grid) const {
  require(grid.dt_s > 0 && std::isfinite(grid.dt_s), "a time step must be finite and positive, got {} s", grid.dt_s);
  require(std::isfinite(grid.start_s), "the first instant of a series must be finite, got {} s", grid.start_s);
  const double steps = std::round(repetition_s / grid.dt_s);
  require(std::abs(steps * grid.dt_s - repetition_s) <= 1e-12 * repetition_s,
          "a step of {} s does not divide the repetition of {} s", grid.dt_s, repetition_s);
  const auto m = static_cast<std::size_t>(steps);
  require(
      2 * (bins.size() - 1) < m,
      "bound waves reach up to {} per repetition, at or above the Nyquist frequency of {} steps: take a smaller step",
      bins.size() - 1, m);
  std::vector<Complex> half(m / 2 + 1);
  for (std::size_t j = 0; j < bins.size(); ++j) {
    const double turns = std::fmod(static_cast<double>(j) * grid.start_s / repetition_s, 1.0);
    half[j] = (j == 0 ? 1.0 : 0.5) * bins[j] * std::polar(1.0, 2 * std::numbers::pi * turns);
  }
  const std::vector<double> once = signal::inverse_real_fft(half, m);
  std::vector<double> out(grid.samples);
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = once[n % m];
  return out;
}

}  // namespace hydro::waves
