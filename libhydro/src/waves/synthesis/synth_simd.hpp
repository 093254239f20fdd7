#pragma once
/// \file  Eight doubles at a time, on any x86-64 and on anything else that GCC or clang compile for.
///
/// A kernel marked FROUDE_KERNEL is compiled three times (baseline, AVX2 with FMA, AVX-512); the loader takes the best
/// that the processor has. Sums keep one order in all three; they differ by whether a product and a sum are rounded
/// once or twice, so results are the same bit for bit on one instruction set, and to rounding between them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>

#if defined(__x86_64__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FROUDE_KERNEL __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define FROUDE_KERNEL  // sanitizers are not yet awake when the loader chooses among versions
#endif
#define FROUDE_INLINE [[gnu::always_inline]] inline

namespace hydro::waves::simd {

inline constexpr std::size_t lanes = 8;

/// n rounded up to whole packs.
constexpr std::size_t padded(std::size_t n) { return (n + lanes - 1) / lanes * lanes; }

using Half = double __attribute__((vector_size(32)));
using HalfBits = std::int64_t __attribute__((vector_size(32)));

/// Two halves of four, each a register of AVX2. A vector of eight is none there, and GCC keeps it in memory, where each
/// sum waits for the one before.
struct Pack {
  Half low, high;

  FROUDE_INLINE Pack& operator+=(const Pack& b);
  FROUDE_INLINE Pack& operator-=(const Pack& b);
};

FROUDE_INLINE Pack operator+(const Pack& a, const Pack& b) { return {a.low + b.low, a.high + b.high}; }
FROUDE_INLINE Pack operator-(const Pack& a, const Pack& b) { return {a.low - b.low, a.high - b.high}; }
FROUDE_INLINE Pack operator*(const Pack& a, const Pack& b) { return {a.low * b.low, a.high * b.high}; }
FROUDE_INLINE Pack operator+(const Pack& a, double b) { return {a.low + b, a.high + b}; }
FROUDE_INLINE Pack operator-(const Pack& a, double b) { return {a.low - b, a.high - b}; }
FROUDE_INLINE Pack operator*(const Pack& a, double b) { return {a.low * b, a.high * b}; }
FROUDE_INLINE Pack operator*(double a, const Pack& b) { return b * a; }
FROUDE_INLINE Pack operator-(const Pack& a) { return {-a.low, -a.high}; }
FROUDE_INLINE Pack& Pack::operator+=(const Pack& b) { return *this = *this + b; }
FROUDE_INLINE Pack& Pack::operator-=(const Pack& b) { return *this = *this - b; }

FROUDE_INLINE void load(const double* from, Half& to) { std::memcpy(&to, from, sizeof to); }
FROUDE_INLINE void store(const Half& from, double* to) { std::memcpy(to, &from, sizeof from); }
FROUDE_INLINE void load(const double* from, Pack& to) {
  load(from, to.low);
  load(from + lanes / 2, to.high);
}
FROUDE_INLINE void store(const Pack& from, double* to) {
  store(from.low, to);
  store(from.high, to + lanes / 2);
}

FROUDE_INLINE double sum(const Pack& p) {
  const Half s = p.low + p.high;
  return (s[0] + s[1]) + (s[2] + s[3]);
}

/// The sums (0+1)+(2+3) of four halves.
FROUDE_INLINE void sums(const Half& a, const Half& b, const Half& c, const Half& d, Half& out) {
  const Half ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Half cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  out = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

/// The sums of eight packs, in the pairs ((0+1)+(2+3)) + ((4+5)+(6+7)).
FROUDE_INLINE void sums(const Pack* p, Pack& out) {
  Half high;
  sums(p[0].low, p[1].low, p[2].low, p[3].low, out.low);
  sums(p[0].high, p[1].high, p[2].high, p[3].high, high);
  out.low += high;
  sums(p[4].low, p[5].low, p[6].low, p[7].low, out.high);
  sums(p[4].high, p[5].high, p[6].high, p[7].high, high);
  out.high += high;
}

/// x to the nearest whole number, ties to even, |x| < 2^51: adding 1.5·2^52 leaves no room for a fraction. (W91)
inline constexpr double whole_only = 6755399441055744.0;

/// sin 2πx and cos 2πx, |x| < 2^49; error at most 2.5e-16 (W91). Turns rather than radians, since taking whole turns
/// off x is exact.
FROUDE_INLINE void sincos_turns(const Half& x, Half& sine, Half& cosine) {
  const Half shifted = 4.0 * x + whole_only;
  const Half quarters = shifted - whole_only;
  const Half r = x - 0.25 * quarters, u = r * r;  // |r| <= 1/8, exact
  // Polynomials through sin(2π√u)/√u and (cos(2π√u) − 1)/u at Chebyshev points of 0 <= u <= 1/64; 2e-17 and 8e-18.
  Half s = 3.7808689593022957 * u - 15.093804209987114;
  s = s * u + 42.058685020160894;
  s = s * u - 76.705859704274545;
  s = s * u + 81.60524927594804;
  s = s * u - 41.341702240399634;
  s = (s * u + 6.2831853071795862) * r;
  Half c = -1.6990343940660637 * u + 7.9032069115696784;
  c = c * u - 26.426253275854723;
  c = c * u + 60.244641352702011;
  c = c * u - 85.456817206643805;
  c = c * u + 64.939394022668239;
  c = c * u - 19.739208802178716;
  c = c * u + 1.0;
  // An odd number of quarters swaps the two; the second and third quarter change signs.
  HalfBits q, sb, cb;
  std::memcpy(&q, &shifted, sizeof q);
  std::memcpy(&sb, &s, sizeof sb);
  std::memcpy(&cb, &c, sizeof cb);
  const HalfBits swap = -(q & 1);
  const HalfBits sine_bits = ((sb & ~swap) | (cb & swap)) ^ ((q & 2) << 62);
  const HalfBits cosine_bits = ((cb & ~swap) | (sb & swap)) ^ (((q + 1) & 2) << 62);
  std::memcpy(&sine, &sine_bits, sizeof sine);
  std::memcpy(&cosine, &cosine_bits, sizeof cosine);
}
FROUDE_INLINE void sincos_turns(const Pack& x, Pack& sine, Pack& cosine) {
  sincos_turns(x.low, sine.low, cosine.low);
  sincos_turns(x.high, sine.high, cosine.high);
}

/// e^x for −700 <= x <= 700, relative error at most 3e-16·(1 + |x|/100) (W92); below −700 it is e^−700, next to
/// nothing.
FROUDE_INLINE void exponential(const Half& x, Half& out) {
  constexpr double per_ln2 = 1.4426950408889634, ln2_high = 0.693147180369123816490,
                   ln2_low = 1.90821492927058770002e-10;
  constexpr double least = -700;
  const Half in = x < least ? Half{least, least, least, least} : x;
  const Half shifted = in * per_ln2 + whole_only;
  const Half n = shifted - whole_only;
  const Half r = (in - n * ln2_high) - n * ln2_low;  // |r| <= ln 2 / 2; n·ln2_high is exact
  Half p = r * (1.0 / 6227020800) + 1.0 / 479001600;
  p = p * r + 1.0 / 39916800;
  p = p * r + 1.0 / 3628800;
  p = p * r + 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  HalfBits power, bits;
  std::memcpy(&power, &shifted, sizeof power);
  std::memcpy(&bits, &p, sizeof bits);
  bits += power << 52;
  std::memcpy(&out, &bits, sizeof out);
}
FROUDE_INLINE void exponential(const Pack& x, Pack& out) {
  exponential(x.low, out.low);
  exponential(x.high, out.high);
}

}  // namespace hydro::waves::simd
