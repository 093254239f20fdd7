#include "synth_window.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hydro/base/error.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;

// The window is fitted in extended precision: noise of 1e-16 in a polynomial of degree 22 would be 1e-10 in its second
// derivative.
using Extended = long double;
constexpr Extended pi_extended = std::numbers::pi_v<Extended>;

// I₀ by its series Σ (x/2)^{2k}/k!²: all terms are positive, so nothing cancels.
Extended bessel_i0(Extended x) {
  Extended term = 1, sum = 1;
  for (int k = 1; term > 1e-21L * sum; ++k) {
    term *= x * x / static_cast<Extended>(4 * k * k);
    sum += term;
  }
  return sum;
}

// Coefficients in powers of y of the polynomial through f at the Chebyshev points of [−1, 1].
template <class Function>
std::vector<Extended> polynomial_through(const Function& f, std::size_t degree) {
  const std::size_t n = degree + 1;
  std::vector<Extended> cosines(4 * n);  // of whole numbers of π/2n, one turn
  for (std::size_t i = 0; i < cosines.size(); ++i)
    cosines[i] = std::cos(pi_extended * static_cast<Extended>(i) / static_cast<Extended>(2 * n));
  std::vector<Extended> value(n), power(n, 0), older(n, 0), old(n, 0), next(n, 0);
  for (std::size_t k = 0; k < n; ++k) value[k] = f(cosines[2 * k + 1]);
  older[0] = old[1] = 1;  // T_0, T_1, then T_2, …, each in powers of y
  for (std::size_t q = 0; q < n; ++q) {
    Extended c = 0;
    for (std::size_t k = 0; k < n; ++k) c += value[k] * cosines[q * (2 * k + 1) % (4 * n)];
    c *= static_cast<Extended>(q == 0 ? 1 : 2) / static_cast<Extended>(n);
    for (std::size_t p = 0; p < n; ++p) {
      power[p] += c * older[p];
      next[p] = (p > 0 ? 2 * old[p - 1] : 0) - older[p];
    }
    older.swap(old);
    old.swap(next);
  }
  return power;
}

// Values, slopes and bends of the pieces in `packs` packs, all at once: each waits for its own sum before.
template <std::size_t packs>
FROUDE_INLINE void horner_packs(const double* polynomial, std::size_t degree, double y, double dy, double* value,
                                double* slope, double* bend) {
  simd::Pack p[packs] = {}, d[packs] = {}, h[packs] = {}, c;  // p, p′, p″/2
  for (std::size_t k = 0; k <= degree; ++k, polynomial += Window::stride)
#pragma GCC unroll 3
    for (std::size_t i = 0; i < packs; ++i) {
      simd::load(polynomial + i * simd::lanes, c);
      h[i] = h[i] * y + d[i];
      d[i] = d[i] * y + p[i];
      p[i] = p[i] * y + c;
    }
#pragma GCC unroll 3
  for (std::size_t i = 0; i < packs; ++i) {
    simd::store(p[i], value + i * simd::lanes);
    simd::store(dy * d[i], slope + i * simd::lanes);
    simd::store(2 * dy * dy * h[i], bend + i * simd::lanes);
  }
}

FROUDE_KERNEL void horner(const double* polynomial, std::size_t degree, std::size_t width, double y, double dy,
                          double* value, double* slope, double* bend) {
  if (width <= simd::lanes) return horner_packs<1>(polynomial, degree, y, dy, value, slope, bend);
  if (width <= 2 * simd::lanes) return horner_packs<2>(polynomial, degree, y, dy, value, slope, bend);
  horner_packs<3>(polynomial, degree, y, dy, value, slope, bend);
}

FROUDE_KERNEL void horner(const double* polynomial, std::size_t degree, double y, double* out) {
  simd::Pack v0{}, v1{}, v2{}, c0, c1, c2;
  for (std::size_t k = 0; k <= degree; ++k, polynomial += Window::stride) {
    simd::load(polynomial, c0);
    simd::load(polynomial + simd::lanes, c1);
    simd::load(polynomial + 2 * simd::lanes, c2);
    v0 = v0 * y + c0;
    v1 = v1 * y + c1;
    v2 = v2 * y + c2;
  }
  simd::store(v0, out);
  simd::store(v1, out + simd::lanes);
  simd::store(v2, out + 2 * simd::lanes);
}

// out = scale · r e^{−r} with r = √(β² − ξ²): 1/ψ̂ where e^{−2r} is below rounding.
FROUDE_KERNEL void reciprocal_transform(double beta, double scale, double xi_step, std::size_t count, double* out) {
  for (std::size_t n = 0; n < count; n += simd::lanes) {
    double values[simd::lanes];
    for (std::size_t i = 0; i < simd::lanes; ++i) {
      const double xi = xi_step * static_cast<double>(n + i);
      values[i] = std::sqrt(std::max(0.0, beta * beta - xi * xi));
    }
    simd::Pack r, e;
    simd::load(values, r);
    simd::exponential(-r, e);
    simd::store(scale * r * e, values);
    for (std::size_t i = 0; i < std::min(simd::lanes, count - n); ++i) out[n + i] = values[i];
  }
}

}  // namespace

Window::Window(std::size_t width, double oversampling)
    : width_(width),
      oversampling_(oversampling),
      beta_(pi * static_cast<double>(width) * (1 - 0.5 / oversampling)),
      peak_(static_cast<double>(bessel_i0(beta_))) {
  ensure(width % 2 == 0 && width >= 4 && width <= largest_width && oversampling > 1, "window: width or oversampling");
  polynomial_.assign((degree + 1) * stride, 0.0);
  for (std::size_t i = 0; i < width_; ++i) {
    const double shift = static_cast<double>(width_) / 2 - 1 - static_cast<double>(i);
    const Extended b = beta_, peak = bessel_i0(b), half_width = static_cast<Extended>(width_) / 2;
    const auto piece = [&](Extended y) {
      const Extended s = ((y + 1) / 2 + static_cast<Extended>(shift)) / half_width;
      return bessel_i0(b * std::sqrt(std::max<Extended>(0, 1 - s * s))) / peak;
    };
    const auto power = polynomial_through(piece, degree);
    for (std::size_t p = 0; p <= degree; ++p) polynomial_[(degree - p) * stride + i] = static_cast<double>(power[p]);
  }
}

Window Window::of_tolerance(double tolerance, double oversampling) {
  for (std::size_t width = 4; width <= largest_width; width += 2) {
    // The estimate of (W94), less what second derivatives never gain: no need to try windows that are far too narrow.
    const double r = pi * static_cast<double>(width) * std::sqrt(1 - 1 / oversampling);
    if (2 * r * std::exp(-r) > tolerance) continue;
    Window window(width, oversampling);
    if (window.error(pi / oversampling) <= tolerance) return window;
  }
  throw InputError(fmt::format("a relative error of {} cannot be reached by interpolation", tolerance), {},
                   "ask for 1e-11 or more, or sum the components directly");
}

double Window::transform(double theta) const {
  const double w = static_cast<double>(width_), half = 0.5 * w * theta;
  const double r = std::sqrt(beta_ * beta_ - half * half);
  return w * std::sinh(r) / r / peak_;
}

void Window::inverse_transforms(double step, std::span<double> out) const {
  const auto w = static_cast<double>(width_);
  reciprocal_transform(beta_, 2 * peak_ / w, 0.5 * w * step, out.size(), out.data());
}

std::ptrdiff_t Window::first(double position) const {
  return static_cast<std::ptrdiff_t>(std::ceil(position)) - static_cast<std::ptrdiff_t>(width_ / 2);
}

void Window::weights(double position, double per_unit, Weights& out) const {
  const double fraction = position - std::ceil(position) + 1;  // (0, 1], so y goes by 2 a step
  horner(polynomial_.data(), degree, width_, 2 * fraction - 1, 2 * per_unit, out[0].data(), out[1].data(),
         out[2].data());
}

void Window::weights(double position, double* out) const {
  const double fraction = position - std::ceil(position) + 1;
  horner(polynomial_.data(), degree, 2 * fraction - 1, out);
}

double Window::error(double theta, std::size_t orders) const {
  double worst = 0;
  Weights weight;
  const std::complex<double> i(0, 1);
  for (int k = 0; k < 64; ++k) {
    const double x = (k + 0.37) / 64;
    weights(x, 1, weight);
    std::complex<double> derivative = std::polar(1.0, theta * x);
    for (std::size_t order = 0; order < orders; ++order, derivative *= i * theta) {
      std::complex<double> sum = 0;
      for (std::size_t l = 0; l < width_; ++l)
        sum +=
            weight[order][l] * std::polar(1.0, theta * static_cast<double>(first(x) + static_cast<std::ptrdiff_t>(l)));
      worst = std::max(worst, std::abs(sum / transform(theta) - derivative));
    }
  }
  return worst;
}

}  // namespace hydro::waves
