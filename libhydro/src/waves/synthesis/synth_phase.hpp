#pragma once
/// \file  The phase of a wave at a late time, in turns, to the last digit (W90).
///
/// Everything here stays right whether or not the compiler fuses products with sums: parts of 26 and 27 bits multiply
/// without rounding, and where a rounded product is needed it is made out of line.
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace hydro::waves::phase {

/// An unevaluated sum high + low of about 100 bits; in turns, whole turns taken off.
struct Turns {
  double high, low;
};

/// The leading 26 bits of x; the other 27 are x − leading(x).
inline double leading(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits &= ~((std::uint64_t{1} << 27) - 1);
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

[[gnu::noinline]] inline double rounded_product(double a, double b) { return a * b; }

/// ω/2π, whole turns kept.
inline Turns per_second(double omega) {
  constexpr double inverse_high = 0.15915494309189535, inverse_low = -9.8393383375912429e-18;  // 1/2π
  const double high = rounded_product(omega, inverse_high);
  return {high, std::fma(omega, inverse_high, -high) + omega * inverse_low};
}

/// The sum of two, exactly, as a rounded sum and the rest (Knuth).
inline Turns two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// ω t/2π for exactly the two doubles given, modulo one; |ω t/2π| < 2^51.
inline Turns of(double omega, double t) {
  const auto without_turns = [](double x) { return x - std::nearbyint(x); };
  const Turns f = per_second(omega);
  const double fa = leading(f.high), fb = f.high - fa, ta = leading(t), tb = t - ta;
  const Turns large = two_sum(without_turns(fa * ta), without_turns(fa * tb));
  const Turns middle = two_sum(without_turns(fb * ta), fb * tb);
  const Turns sum = two_sum(without_turns(large.high), without_turns(middle.high));
  const Turns all = two_sum(sum.high, sum.low + large.low + middle.low + t * f.low);
  return {without_turns(all.high), all.low};
}

/// e^{2πi x}, to rounding.
inline std::complex<double> unit(Turns x) { return std::polar(1.0, 2 * std::numbers::pi * (x.high + x.low)); }

/// A fraction of a turn cut so that n·coarse is exact for |n| < 2^26: n·(coarse + fine) then keeps its phase.
struct Step {
  double coarse, fine;
};
inline Step repeatable(Turns x) {
  const double coarse = leading(x.high);
  return {coarse, (x.high - coarse) + x.low};
}
inline Turns times(Step step, double n) {
  const double whole = n * step.coarse;
  return {whole - std::nearbyint(whole), n * step.fine};
}

}  // namespace hydro::waves::phase
