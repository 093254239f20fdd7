
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "hydro/base/dense.hpp"
#include "hydro/waves/kinematics/limits.hpp"
#include "steady_common.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;

/// The wave in units of 1/k₀ and √(g/k₀), k₀ its wavenumber by linear theory: coefficients E_j, B_j and four numbers.
struct Unknowns {
  Eigen::VectorXd E, B;  // shape (N) each
  double U, q, K, k;

  Eigen::Index N() const { return E.size(); }
  void step(const Eigen::VectorXd& d) {
    E += d.head(N());
    B += d.segment(N(), N());
    U += d[2 * N()];
    q += d[2 * N() + 1];
    K += d[2 * N() + 2];
    k += d[2 * N() + 3];
  }
  Unknowns with_harmonics(Eigen::Index count) const {
    Unknowns out{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count), U, q, K, k};
    const Eigen::Index kept = std::min(count, N());
    out.E.head(kept) = E.head(kept);
    out.B.head(kept) = B.head(kept);
    return out;
  }
};

/// What the wave must fulfil beside (W54) and (W55); same units.
struct Conditions {
  double depth;                     // k₀h
  std::optional<double> frequency;  // ω; empty: k = 1
  double mean_flow;
  bool is_transport;
};

/// Profiles of harmonic j at height η and their rates with k, (W56).
struct Profiles {
  double C, S, C_k, S_k;
};

Profiles profiles(double j, double k, double h, double eta) {
  const DepthProfile p = depth_profile(j * k, h, eta);
  if (std::isinf(h)) return {p.cosh, p.sinh, j * eta * p.sinh, j * eta * p.cosh};
  // cosh jkη/cosh² jkh and sinh jkη/cosh² jkh; |η| < h, so no exponent is positive.
  const double a = j * k * eta, b = j * k * h, d = 1 + std::exp(-2 * b);
  const double up = std::exp(a - 2 * b), down = std::exp(-a - 2 * b);
  const double c = 2 * (up + down) / (d * d), s = 2 * (up - down) / (d * d);
  return {p.cosh, p.sinh, j * (eta * p.sinh + h * s), j * (eta * p.cosh + h * c)};
}

/// Residuals and their derivatives with the unknowns: two rows for each point of the half wave, then height and length.
struct System {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};

void fill_surface_rows(System& s, const Unknowns& v, double h, Eigen::Index m, Eigen::Index points) {
  const Eigen::Index N = v.N(), kin = 2 * m, dyn = 2 * m + 1;
  const double X = pi * static_cast<double>(m) / static_cast<double>(points - 1);
  double eta = 0;
  for (Eigen::Index n = 0; n < N; ++n) eta += v.E[n] * std::cos(static_cast<double>(n + 1) * X);
  double psi = 0, u = 0, w = 0, u_z = 0, w_z = 0, psi_k = 0, u_k = 0, w_k = 0;
  std::vector<std::array<double, 3>> own(static_cast<std::size_t>(N));  // ∂(ψ, u, w)/∂B_j
  for (Eigen::Index n = 0; n < N; ++n) {
    const auto j = static_cast<double>(n + 1);
    const double jk = j * v.k, c = std::cos(j * X), sn = std::sin(j * X), B = v.B[n];
    const Profiles p = profiles(j, v.k, h, eta);
    own[static_cast<std::size_t>(n)] = {p.S * c, jk * p.C * c, jk * p.S * sn};
    psi += B * p.S * c;
    u += B * jk * p.C * c;
    w += B * jk * p.S * sn;
    u_z += B * jk * jk * p.S * c;
    w_z += B * jk * jk * p.C * sn;
    psi_k += B * p.S_k * c;
    u_k += B * j * (p.C + v.k * p.C_k) * c;
    w_k += B * j * (p.S + v.k * p.S_k) * sn;
  }
  s.residual[kin] = psi - v.U * eta + v.q;                         // (W54)
  s.residual[dyn] = -v.U * u + 0.5 * (u * u + w * w) + eta - v.K;  // (W55), g = 1
  const double kin_eta = u - v.U, dyn_eta = (u - v.U) * u_z + w * w_z + 1;
  for (Eigen::Index n = 0; n < N; ++n) {
    const double c = std::cos(static_cast<double>(n + 1) * X);
    const auto& [psi_B, u_B, w_B] = own[static_cast<std::size_t>(n)];
    s.jacobian(kin, n) = kin_eta * c;
    s.jacobian(dyn, n) = dyn_eta * c;
    s.jacobian(kin, N + n) = psi_B;
    s.jacobian(dyn, N + n) = (u - v.U) * u_B + w * w_B;
  }
  s.jacobian.row(kin).tail(4) << -eta, 1, 0, psi_k;
  s.jacobian.row(dyn).tail(4) << -u, 0, -1, (u - v.U) * u_k + w * w_k;
}

System assemble(const Unknowns& v, const Conditions& is, double height) {
  const Eigen::Index N = v.N(), points = 2 * N + 1;  // twice as many as harmonics: see (W57)
  System s{Eigen::VectorXd::Zero(2 * points + 2), Eigen::MatrixXd::Zero(2 * points + 2, 2 * N + 4)};
  for (Eigen::Index m = 0; m < points; ++m) fill_surface_rows(s, v, is.depth, m, points);
  const Eigen::Index high = 2 * points, length = high + 1;
  for (Eigen::Index n = 0; n < N; n += 2) {  // odd harmonics alone differ between crest and trough
    s.residual[high] += 2 * v.E[n];
    s.jacobian(high, n) = 2;
  }
  s.residual[high] -= height;
  if (!is.frequency) {
    s.residual[length] = v.k - 1;
    s.jacobian(length, 2 * N + 3) = 1;
    return s;
  }
  const double c = v.U + is.mean_flow + (is.is_transport ? v.q / is.depth : 0);  // (W52)
  s.residual[length] = v.k * c - *is.frequency;
  s.jacobian.row(length).tail(4) << v.k, is.is_transport ? v.k / is.depth : 0, 0, c;
  return s;
}

// Gauss–Newton. Columns are scaled to length one; of all steps that are equal to 1e-14 the shortest is taken, (W57).
// True if the step, relative to the height, fell below 1e-13, or below `good_enough` and no longer halves.
bool solve(Unknowns& v, const Conditions& is, double height, double good_enough, int most_steps) {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_steps; ++iteration) {
    System s = assemble(v, is, height);
    if (!s.residual.allFinite() || !s.jacobian.allFinite()) return false;
    const Eigen::VectorXd scale = s.jacobian.colwise().norm();
    s.jacobian.array().rowwise() /= scale.transpose().array();
    const dense::CompleteQr qr(s.jacobian, 1e-14);
    const Eigen::VectorXd step = (-qr.solve(s.residual)).cwiseQuotient(scale);
    v.step(step);
    if (!(v.k > 0) || !(v.U > 0)) return false;
    const double size = (step.head(v.N()).cwiseAbs().maxCoeff() + std::abs(step[2 * v.N() + 3])) / height;
    if (size < 1e-13 || (size < good_enough && size > 0.5 * last)) return true;
    last = size;
  }
  return false;
}

/// The last two waves of the continuation in height, which give the start of the next.
struct Rung {
  double height;
  Unknowns wave;
};

Unknowns extrapolate(const Rung& before, const Rung& last, double height) {
  const double s = (height - last.height) / (last.height - before.height);
  const auto ahead = [s](const auto& a, const auto& b) { return b + s * (b - a); };
  const Unknowns &a = before.wave, &b = last.wave;
  return {b.E + s * (b.E - a.E), b.B + s * (b.B - a.B), ahead(a.U, b.U),
          ahead(a.q, b.q),       ahead(a.K, b.K),       ahead(a.k, b.k)};
}

// The linear wave; of no height it is where the continuation begins.
Unknowns linear_start(const Conditions& is, Eigen::Index N, double height) {
  const double T = std::tanh(is.depth), U = std::sqrt(T);
  Unknowns v{Eigen::VectorXd::Zero(N), Eigen::VectorXd::Zero(N), U, 0, 0, 1};
  v.E[0] = height / 2;
  v.B[0] = U * height / 2 / T;
  return v;
}

constexpr Eigen::Index most_climbing_harmonics = 192;

struct Problem {
  Conditions is;
  double height;     // k₀H
  WaterDepth depth;  // in units of 1/k₀
  Eigen::Index climbing_harmonics;
};

// The equations also hold for several crests to the length, which Newton may fall into from long waves: the surface
// must go down all the way from crest to trough (but for ripples of a solution with too few harmonics).
bool has_one_crest(const Unknowns& v, double height) {
  double lowest = v.E.sum();
  for (Eigen::Index m = 1; m <= 4 * v.N(); ++m) {
    const double X = pi * static_cast<double>(m) / static_cast<double>(4 * v.N());
    double eta = 0;
    for (Eigen::Index n = 0; n < v.N(); ++n) eta += v.E[n] * std::cos(static_cast<double>(n + 1) * X);
    if (eta > lowest + 1e-2 * height) return false;
    lowest = std::min(lowest, eta);
  }
  return true;
}

bool is_resolved(const Unknowns& v) { return std::abs(v.E[v.N() - 1]) < 1e-6 * std::abs(v.E[0]); }

[[noreturn]] void throw_lost(const Problem& problem, const Rung& last) {
  throw NumericsError(
      fmt::format("the stream function was lost at {:.4g} of the height asked for, which is {:.4g} of the highest wave",
                  last.height / problem.height, last.height / highest_wave(2 * pi / last.wave.k, problem.depth)));
}

// Raises the height from nothing to the one asked for. Where the solution is lost: more harmonics if the last one still
// counts, or else a smaller step.
Unknowns climb(const Problem& problem) {
  const double target = problem.height, h = problem.is.depth;
  Eigen::Index N = problem.climbing_harmonics;
  std::optional<Rung> before;
  Rung last{0, linear_start(problem.is, N, 0)};
  // Beyond Hλ²/h³ ≈ 10 the linear wave is no start.
  double step = std::min(target / 8, 10 * h * h * h / (4 * pi * pi));
  while (last.height < target) {
    const double height = std::min(target, last.height + step);
    Unknowns v = before ? extrapolate(*before, last, height) : linear_start(problem.is, N, height);
    if (solve(v, problem.is, height, 1e-4, 10) && has_one_crest(v, height)) {
      const double highest = highest_wave(2 * pi / v.k, problem.depth);
      require(height <= highest, "the wave is too high: at its length the highest is {:.4g} of the height asked for",
              highest / target);
      before = std::move(last);
      last = Rung{height, std::move(v)};
      step = std::min(1.5 * step, target / 8);
    } else if (N < most_climbing_harmonics && !is_resolved(v)) {
      N = std::min(2 * N, most_climbing_harmonics);
      last.wave = last.wave.with_harmonics(N);
      if (before) before->wave = before->wave.with_harmonics(N);
    } else {
      step /= 2;
      if (step < target / 4096) throw_lost(problem, last);
    }
  }
  return last.wave;
}

Problem scaled_problem(const SteadyWaveInput& input, double k0, int harmonics) {
  const double speed = std::sqrt(input.water.gravity / k0);
  Conditions is{.depth = k0 * input.water.depth.metres(), .frequency = {}, .mean_flow = 0, .is_transport = false};
  if (const auto* omega = std::get_if<AngularFrequency>(&input.length))
    is.frequency = omega->rad_per_s() / (k0 * speed);
  if (const auto* transport = std::get_if<TransportVelocity>(&input.mean_flow)) {
    is.mean_flow = transport->velocity / speed;
    is.is_transport = true;
  } else {
    is.mean_flow = std::get<EulerianCurrent>(input.mean_flow).velocity / speed;
  }
  const WaterDepth depth = input.water.depth.is_infinite() ? WaterDepth::infinite() : WaterDepth::from_metres(is.depth);
  // Long waves need more harmonics to be followed at all: their crest takes a share of the length like kh.
  const auto enough = static_cast<Eigen::Index>(std::clamp(12 / is.depth, 24.0, 192.0));
  return {is, k0 * input.height_m, depth, harmonics > 0 ? std::min<Eigen::Index>(harmonics, enough) : enough};
}

SteadyWave in_metres(const Unknowns& v, const SteadyWaveInput& input, double k0) {
  const double speed = std::sqrt(input.water.gravity / k0);
  WaveFrame frame{.k = v.k * k0,
                  .U = v.U * speed,
                  .flux = v.q * speed / k0,
                  .bernoulli = v.K * speed * speed,
                  .elevation = {},
                  .potential = {}};
  for (Eigen::Index n = 0; n < v.N(); ++n) {
    frame.elevation.push_back(v.E[n] / k0);
    frame.potential.push_back(v.B[n] * speed / k0);
  }
  return finish(std::move(frame), input);
}

double worst_residual(const SteadyWave& wave) { return std::max(wave.kinematic_residual, wave.dynamic_residual); }

}  // namespace

SteadyWave stream_function(const SteadyWaveInput& input, const StreamFunctionOptions& options) {
  check(input);
  require(options.harmonics == 0 || (options.harmonics >= 4 && options.harmonics <= 512),
          "a stream function needs 4 to 512 harmonics, or 0 to choose them, got {}", options.harmonics);
  require(options.tolerance >= 1e-13, "a residual below {} cannot be reached; rounding ends at 1e-13",
          options.tolerance);
  const double k0 = linear_wavenumber(input);
  if (std::holds_alternative<Wavelength>(input.length)) {
    const double highest = highest_wave(2 * pi / k0, input.water.depth);
    require(input.height_m <= highest, "a wave of {} m height is above the highest of its length, {:.4g} m (W60)",
            input.height_m, highest);
  }
  const Problem problem = scaled_problem(input, k0, options.harmonics);
  const Unknowns start = climb(problem);
  const std::vector<int> counts =
      options.harmonics > 0 ? std::vector<int>{options.harmonics} : std::vector<int>{16, 32, 64, 128, 256};
  Unknowns v = start;
  double reached = std::numeric_limits<double>::infinity();
  for (const int N : counts) {
    Unknowns finer = v.with_harmonics(N);
    if (!solve(finer, problem.is, problem.height, 1e-9, 25) || !has_one_crest(finer, problem.height)) continue;
    if (N >= problem.climbing_harmonics) v = finer;
    SteadyWave wave = in_metres(finer, input, k0);
    reached = std::min(reached, worst_residual(wave));
    if (options.harmonics > 0 || worst_residual(wave) <= options.tolerance) return wave;
  }
  throw NumericsError(
      fmt::format("the stream function reached a residual of {:.2g} with {} harmonics, not {:.2g}: the wave "
                  "is too close to the highest, or too long",
                  reached, counts.back(), options.tolerance));
}

}  // namespace hydro::waves
