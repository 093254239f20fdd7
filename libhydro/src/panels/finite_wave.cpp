#include "finite_wave.hpp"

#include <algorithm>
#include <complex>

#include "cylinders/bessel.hpp"
#include "deep_wave.hpp"
#include "gauss.hpp"
#include "hydro/cylinders/vertical_modes.hpp"
#include "hydro/waves/dispersion.hpp"

namespace hydro::panels {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr double longest = 18;     // of kh: e^{−36} is rounding
constexpr double switch_at = 0.5;  // R/h from which the series of modes is taken: 24 of them reach e^{−37}

struct ComplexPair {
  Complex order0, order1;
};

/// J₀ and J₁ by their power series: |z| <= 10 loses three digits of sixteen.
ComplexPair bessel_j_complex(Complex z) {
  const Complex q = -z * z / 4.0;
  Complex t0 = 1, t1 = z / 2.0, J0 = t0, J1 = t1;
  for (int n = 1; n < 40; ++n) {
    t0 *= q / static_cast<double>(n * n);
    t1 *= q / static_cast<double>(n * (n + 1));
    J0 += t0;
    J1 += t1;
  }
  return {J0, J1};
}

struct PathPoint {
  Complex k, dk;
};

void add_segment(Complex a, Complex b, std::vector<PathPoint>& path) {
  const auto& rule = gauss_rule();
  for (std::size_t n = 0; n < rule.point.size(); ++n)
    path.push_back({a + (b - a) * ((rule.point[n] + 1) / 2), (b - a) * (rule.weight[n] / 2)});
}

/// From 0 up at 45° in steps that double, then level above the poles of the real axis (G9).
std::vector<PathPoint> path_above(double K, double depth) {
  const double top = 0.8 / depth;
  const Complex ray(1, 1);
  std::vector<PathPoint> path;
  double at = std::min(std::isinf(K) ? top : K / 4, top);
  add_segment(0, at * ray, path);
  while (at < top) {
    const double next = std::min(2 * at, top);
    add_segment(at * ray, next * ray, path);
    at = next;
  }
  constexpr int level = 12;
  const double step = (longest / depth - top) / level;
  for (int i = 0; i < level; ++i) add_segment(Complex(top + i * step, top), Complex(top + (i + 1) * step, top), path);
  return path;
}

/// M and M − M_∞ of (G7).
struct Kernel {
  Complex M, less_deep;
};
Kernel kernel(Complex k, double K, double depth) {
  const Complex e = std::exp(-2.0 * k * depth);
  if (std::isinf(K)) return {-1.0 / (1.0 + e), e / (1.0 + e)};
  const Complex D = (k - K) - (k + K) * e;
  return {(k + K) / D, (k + K) * (k + K) * e / ((k - K) * D)};
}

/// 1/√(R² + Y²) with its sign, and the principal value, of the surface as it is in deep water: value, slopes in R and
/// Y.
BedWave deep_part(double K, double R, double Y) {
  const double r = std::hypot(R, Y), sign = std::isinf(K) ? -1 : 1, cube = r * r * r;
  BedWave out{sign / r, -sign * R / cube, -sign * Y / cube, false};
  if (std::isinf(K)) return out;
  const DeepWave w = deep_wave(K * R, K * Y);
  out.d += 2 * K * w.F;
  out.d_R += 2 * K * K * w.F_X;
  out.d_V += 2 * K * K * w.F_Y;
  return out;
}

}  // namespace

FiniteWave::FiniteWave(double K, double depth, double reach) : K_(K), h_(depth) {
  if (!std::isinf(K)) {
    const double g = 1;
    k_ = waves::wavenumber(std::sqrt(K * g), {.density = 1, .gravity = g, .depth = WaterDepth::from_metres(depth)});
    strength_ = std::sqrt(wave_scaled());
  }
  constexpr int modes = 24;
  for (int n = 1; n <= modes; ++n) kappa_.push_back(cylinders::evanescent_root(n, K_, h_));
  tabulate(reach);
}

double FiniteWave::wave_scaled() const {
  // k² − K² = k²/cosh² kh; C₀ = (k² − K²)/(h(k² − K²) + K)
  const double e = std::exp(-2 * k_ * h_), sech = 4 * e / ((1 + e) * (1 + e));
  const double difference = k_ * k_ * sech;
  return k_ * k_ / ((1 + e) * (1 + e)) / (h_ * difference + K_);
}

double FiniteWave::profile(double down) const {
  return strength_ * std::exp(-k_ * down) * (1 + std::exp(-2 * k_ * (h_ - down)));
}

std::vector<BedWave> FiniteWave::near(const std::vector<double>& R, const std::vector<double>& V) const {
  std::vector<BedWave> out(R.size() * V.size(), BedWave{0, 0, 0, false});
  std::vector<Complex> value(V.size()), slope(V.size());
  for (const auto& [k, dk] : path_above(K_, h_)) {
    const Kernel M = kernel(k, K_, h_);
    for (std::size_t j = 0; j < V.size(); ++j) {
      const Complex up = dk * M.less_deep * std::exp(-k * (2 * h_ - V[j])),
                    down = dk * M.M * std::exp(-k * (2 * h_ + V[j]));
      value[j] = up + down;
      slope[j] = k * (up - down);
    }
    for (std::size_t i = 0; i < R.size(); ++i) {
      const ComplexPair J = bessel_j_complex(k * R[i]);
      for (std::size_t j = 0; j < V.size(); ++j) {
        BedWave& o = out[i * V.size() + j];
        o.d += (value[j] * J.order0).real();
        o.d_R -= (value[j] * k * J.order1).real();
        o.d_V += (slope[j] * J.order0).real();
      }
    }
  }
  return out;
}

std::vector<BedWave> FiniteWave::far(const std::vector<double>& R, const std::vector<double>& V) const {
  std::vector<BedWave> out(R.size() * V.size());
  for (std::size_t i = 0; i < R.size(); ++i)
    for (std::size_t j = 0; j < V.size(); ++j) {
      const double r = std::hypot(R[i], V[j]), cube = r * r * r;
      const BedWave deep = deep_part(K_, R[i], 2 * h_ - V[j]);
      out[i * V.size() + j] = {-1 / r - deep.d, R[i] / cube - deep.d_R, V[j] / cube + deep.d_V, false};
    }
  for (std::size_t i = 0; i < R.size(); ++i) {
    const auto add = [&](double f, double f_R, double wavenumber, bool wave) {
      for (std::size_t j = 0; j < V.size(); ++j) {
        const double x = wavenumber * V[j], e = std::exp(x - 2 * k_ * h_);  // waves come scaled by e^{2kh}
        const double c = wave ? e * (1 + std::exp(-2 * x)) / 2 : std::cos(x);
        const double s = wave ? e * (1 - std::exp(-2 * x)) / 2 : -std::sin(x);
        BedWave& o = out[i * V.size() + j];
        o.d += f * c;
        o.d_R += f_R * c;
        o.d_V += f * wavenumber * s;
      }
    };
    if (k_ > 0) {
      std::array<Complex, 2> H;
      cylinders::hankel_2_sequence(k_ * R[i], H);
      const double strength = pi * 4 * wave_scaled();  // Re(−πi C₀ H) = π C₀ Im H
      add(strength * H[0].imag(), -strength * k_ * H[1].imag(), k_, true);
    }
    for (const double kappa : kappa_) {
      const double x = kappa * R[i];
      if (x > 40) break;
      const double both = kappa * kappa + K_ * K_;
      const double strength = 2 * (std::isinf(K_) ? 1 / h_ : both / (h_ * both - K_)) * std::exp(-x);
      std::array<double, 2> bessel;
      cylinders::bessel_k_scaled_sequence(x, bessel);
      add(strength * bessel[0], -strength * kappa * bessel[1], kappa, false);
    }
  }
  return out;
}

void FiniteWave::tabulate(double reach) {
  // Waves of kh > 20 are below 1e-8 where they are kept (d at the surface, the whole below mid-depth).
  const double across = std::min(h_ / 2, k_ > 0 ? 1.5 / std::min(k_, 20 / h_) : h_);
  rows_ = 2 * static_cast<int>(std::ceil(h_ / across));
  height_ = 2 * h_ / rows_;
  const int in_near = static_cast<int>(std::ceil(switch_at * h_ / across));
  width_ = switch_at * h_ / in_near;
  columns_ = std::max(in_near, static_cast<int>(std::ceil(reach / width_ * (1 + 1e-12))));
  std::vector<double> V;
  for (int row = 0; row < rows_; ++row)
    for (int b = 0; b < patch_nodes; ++b) V.push_back(height_ * (row + (patch_node(b) + 1) / 2));
  for (int column = 0; column < columns_; ++column) {
    std::vector<double> R;
    for (int a = 0; a < patch_nodes; ++a) R.push_back(width_ * (column + (patch_node(a) + 1) / 2));
    add_column(R, V, column < in_near ? near(R, V) : far(R, V));
  }
}

void FiniteWave::add_column(const std::vector<double>& R, const std::vector<double>& V,
                            const std::vector<BedWave>& at) {
  for (int row = 0; row < rows_; ++row) {
    std::array<Eigen::MatrixXd, 3> values;
    values.fill(Eigen::MatrixXd(patch_nodes, patch_nodes));
    for (int a = 0; a < patch_nodes; ++a)
      for (int b = 0; b < patch_nodes; ++b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(row * patch_nodes + b);
        const BedWave& w = at[i * V.size() + j];
        const bool whole = row < rows_ / 2;
        const BedWave deep = whole ? deep_part(K_, R[i], 2 * h_ - V[j]) : BedWave{0, 0, 0, false};
        values[0](a, b) = w.d + deep.d;
        values[1](a, b) = w.d_R + deep.d_R;
        values[2](a, b) = w.d_V - deep.d_V;
      }
    patch_.emplace_back(values);
  }
}

BedWave FiniteWave::operator()(double R, double V) const {
  const int column = std::min(static_cast<int>(R / width_), columns_ - 1);
  const int row = std::min(static_cast<int>(V / height_), rows_ - 1);
  const auto& patch = patch_[static_cast<std::size_t>(column * rows_ + row)];
  const std::array<double, 3> d = patch(2 * (R / width_ - column) - 1, 2 * (V / height_ - row) - 1);
  return {d[0], d[1], d[2], row < rows_ / 2};
}

}  // namespace hydro::panels
