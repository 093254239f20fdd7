#include <array>
#include <cmath>

#include "steady_common.hpp"

namespace hydro::waves {
namespace {

double polynomial(double x, std::initializer_list<double> rising) {
  double value = 0, power = 1;
  for (const double c : rising) {
    value += c * power;
    power *= x;
  }
  return value;
}

/// Fenton (1985), table 1, as functions of S = sech 2kh; the A are multiplied by cosh jkh, so that all stay finite in
/// deep water (W51). A_ij belongs to ε^i and harmonic j.
struct StokesCoefficients {
  double A11, A22, A31, A33, A42, A44, A51, A53, A55;
  double B22, B31, B42, B44, B53, B55;
  double C0, C2, C4, D2, D4, E2, E4;
};

StokesCoefficients stokes_coefficients(double kh) {
  const double e = std::exp(-2 * kh);
  const double S = 2 * e / (1 + e * e);             // sech 2kh
  const double T = -std::expm1(-2 * kh) / (1 + e);  // tanh kh
  const double coth = 1 / T;
  const double G = 2 * T * T / (1 + T * T);  // 1 − S without cancellation in shallow water
  const double G2 = G * G, G3 = G2 * G, G4 = G2 * G2, G5 = G4 * G, G6 = G3 * G3;
  // cosh jkh over sinh kh (odd j) or one (even j), each with the powers of 1/S that the polynomials below give back.
  const double cosh3 = coth * (2 - S), cosh4 = 2 - S * S, cosh5 = coth * (4 - 2 * S - S * S);
  const double C0 = std::sqrt(T);
  return {
      .A11 = coth,
      .A22 = 3 * S / (2 * G2),
      .A31 = coth * polynomial(S, {-4, -20, 10, -13}) / (8 * G3),
      .A33 = cosh3 * polynomial(S, {0, -2, 11}) / (8 * G3),
      .A42 = polynomial(S, {12, -14, -264, -45, -13}) / (24 * G5),
      .A44 = cosh4 * polynomial(S, {0, 10, -174, 291, 278}) / (48 * (3 + 2 * S) * G5),
      .A51 = coth * polynomial(S, {-1184, 32, 13232, 21712, 20940, 12554, -500, -3341, -670}) /
             (64 * (3 + 2 * S) * (4 + S) * G6),
      .A53 = cosh3 * polynomial(S, {4, 105, 198, -1376, -1302, -117, 58}) / (32 * (3 + 2 * S) * G6),
      .A55 = cosh5 * polynomial(S, {0, -6, 272, -1552, 852, 2029, 430}) / (64 * (3 + 2 * S) * (4 + S) * G6),
      .B22 = coth * (1 + 2 * S) / (2 * G),
      .B31 = -3 * polynomial(S, {1, 3, 3, 2}) / (8 * G3),
      .B42 = coth * polynomial(S, {6, -26, -182, -204, -25, 26}) / (6 * (3 + 2 * S) * G4),
      .B44 = coth * polynomial(S, {24, 92, 122, 66, 67, 34}) / (24 * (3 + 2 * S) * G4),
      .B53 =
          9 * polynomial(S, {132, 17, -2216, -5897, -6292, -2687, 194, 467, 82}) / (128 * (3 + 2 * S) * (4 + S) * G6),
      .B55 = 5 * polynomial(S, {300, 1579, 3176, 2949, 1188, 675, 1326, 827, 130}) / (384 * (3 + 2 * S) * (4 + S) * G6),
      .C0 = C0,
      .C2 = C0 * (2 + 7 * S * S) / (4 * G2),
      .C4 = C0 * polynomial(S, {4, 32, -116, -400, -71, 146}) / (32 * G5),
      .D2 = -0.5 / C0,
      .D4 = polynomial(S, {2, 4, 1, 2}) / (8 * G3 * C0),
      .E2 = T * (2 + 2 * S + 5 * S * S) / (4 * G2),
      .E4 = T * polynomial(S, {8, 12, -152, -308, -42, 77}) / (32 * G5),
  };
}

// All in units of 1/k and √(g/k); flux is Q − Ūh. A33, A44, A53, A55 carry one power of S less than printed for each
// division by S in cosh jkh.
WaveFrame scaled_frame(double kh, double epsilon, int order) {
  const StokesCoefficients a = stokes_coefficients(kh);
  const double e2 = epsilon * epsilon, e3 = e2 * epsilon, e4 = e2 * e2, e5 = e4 * epsilon;
  if (order == 2)
    return {.k = 1,
            .U = a.C0,
            .flux = e2 * a.D2,
            .bernoulli = e2 * (a.E2 - a.C0 * a.C2),
            .elevation = {epsilon, e2 * a.B22},
            .potential = {a.C0 * epsilon * a.A11, a.C0 * e2 * a.A22}};
  const double U = a.C0 + e2 * a.C2 + e4 * a.C4;
  const double R = 0.5 * a.C0 * a.C0 + e2 * a.E2 + e4 * a.E4;
  return {.k = 1,
          .U = U,
          .flux = e2 * a.D2 + e4 * a.D4,
          .bernoulli = R - 0.5 * U * U,
          .elevation = {epsilon + e3 * a.B31 - e5 * (a.B53 + a.B55), e2 * a.B22 + e4 * a.B42, -e3 * a.B31 + e5 * a.B53,
                        e4 * a.B44, e5 * a.B55},
          .potential = {a.C0 * (epsilon * a.A11 + e3 * a.A31 + e5 * a.A51), a.C0 * (e2 * a.A22 + e4 * a.A42),
                        a.C0 * (e3 * a.A33 + e5 * a.A53), a.C0 * e4 * a.A44, a.C0 * e5 * a.A55}};
}

WaveFrame frame_of_wavenumber(const SteadyWaveInput& input, double k, int order) {
  WaveFrame frame = scaled_frame(k * input.water.depth.metres(), k * input.height_m / 2, order);
  const double speed = std::sqrt(input.water.gravity / k);
  frame.k = k;
  frame.U *= speed;
  frame.flux *= speed / k;
  frame.bernoulli *= speed * speed;
  for (double& E : frame.elevation) E /= k;
  for (double& B : frame.potential) B *= speed / k;
  return frame;
}

// The wavenumber whose frequency k c(k) is the one asked for: secant steps from the linear wave.
double find_wavenumber(const SteadyWaveInput& input, int order) {
  double k = linear_wavenumber(input);
  if (std::holds_alternative<Wavelength>(input.length)) return k;
  const double omega = std::get<AngularFrequency>(input.length).rad_per_s();
  const auto excess = [&](double at) {
    return at * phase_velocity(frame_of_wavenumber(input, at, order), input) / omega - 1;
  };
  double k_before = 0.99 * k, before = excess(k_before), now = excess(k);
  for (int step = 0; step < 60; ++step) {
    if (std::abs(now) < 4e-16 || now == before) break;
    const double next = k - now * (k - k_before) / (now - before);
    if (!(next > 0) || !std::isfinite(next)) break;
    k_before = k;
    before = now;
    k = next;
    now = excess(k);
  }
  if (!(std::abs(now) < 1e-13))
    throw NumericsError(fmt::format(
        "Stokes' series of order {} finds no length for a wave of {} m and {:.6g} s in {} m of water; use the stream "
        "function",
        order, input.height_m, std::get<AngularFrequency>(input.length).period_s(), input.water.depth.metres()));
  return k;
}

SteadyWave stokes(const SteadyWaveInput& input, int order) {
  check(input);
  WaveFrame frame = frame_of_wavenumber(input, find_wavenumber(input, order), order);
  if (!(frame.U > 0))
    throw NumericsError(
        fmt::format("Stokes' series gives the speed {:.4g} m/s for a wave of {} m in {} m of water: it is "
                    "too long for it; use the stream function",
                    frame.U, input.height_m, input.water.depth.metres()));
  return finish(std::move(frame), input);
}

}  // namespace

SteadyWave stokes_second(const SteadyWaveInput& input) { return stokes(input, 2); }
SteadyWave stokes_fifth(const SteadyWaveInput& input) { return stokes(input, 5); }

}  // namespace hydro::waves
