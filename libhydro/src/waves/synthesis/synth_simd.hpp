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
using Pack = double __attribute__((vector_size(64)));
using Bits = std::int64_t __attribute__((vector_size(64)));

/// n rounded up to whole packs.
constexpr std::size_t padded(std::size_t n) { return (n + lanes - 1) / lanes * lanes; }

// Packs go in and out by reference: passing them by value would depend on the instruction set of the caller.
FROUDE_INLINE void load(const double* from, Pack& to) { std::memcpy(&to, from, sizeof to); }
FROUDE_INLINE void store(const Pack& from, double* to) { std::memcpy(to, &from, sizeof from); }
FROUDE_INLINE double sum(const Pack& p) { return ((p[0] + p[4]) + (p[1] + p[5])) + ((p[2] + p[6]) + (p[3] + p[7])); }

/// The sums of eight packs, in the pairs ((0+1)+(2+3)) + ((4+5)+(6+7)).
FROUDE_INLINE void sums(const Pack* p, Pack& out) {
  Pack pairs[4], fours[2];
  for (std::size_t i = 0; i < 4; ++i)
    pairs[i] = __builtin_shufflevector(p[2 * i], p[2 * i + 1], 0, 8, 2, 10, 4, 12, 6, 14) +
               __builtin_shufflevector(p[2 * i], p[2 * i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  for (std::size_t i = 0; i < 2; ++i)
    fours[i] = __builtin_shufflevector(pairs[2 * i], pairs[2 * i + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
               __builtin_shufflevector(pairs[2 * i], pairs[2 * i + 1], 2, 3, 10, 11, 6, 7, 14, 15);
  out = __builtin_shufflevector(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11) +
        __builtin_shufflevector(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15);
}

/// x to the nearest whole number, ties to even, |x| < 2^51: adding 1.5·2^52 leaves no room for a fraction. (W91)
inline constexpr double whole_only = 6755399441055744.0;

/// sin 2πx and cos 2πx, |x| < 2^49; error at most 2.5e-16 (W91). Turns rather than radians, since taking whole turns
/// off x is exact.
FROUDE_INLINE void sincos_turns(const Pack& x, Pack& sine, Pack& cosine) {
  const Pack shifted = 4.0 * x + whole_only;
  const Pack quarters = shifted - whole_only;
  const Pack r = x - 0.25 * quarters, u = r * r;  // |r| <= 1/8, exact
  // Polynomials through sin(2π√u)/√u and (cos(2π√u) − 1)/u at Chebyshev points of 0 <= u <= 1/64; 2e-17 and 8e-18.
  Pack s = 3.7808689593022957 * u - 15.093804209987114;
  s = s * u + 42.058685020160894;
  s = s * u - 76.705859704274545;
  s = s * u + 81.60524927594804;
  s = s * u - 41.341702240399634;
  s = (s * u + 6.2831853071795862) * r;
  Pack c = -1.6990343940660637 * u + 7.9032069115696784;
  c = c * u - 26.426253275854723;
  c = c * u + 60.244641352702011;
  c = c * u - 85.456817206643805;
  c = c * u + 64.939394022668239;
  c = c * u - 19.739208802178716;
  c = c * u + 1.0;
  // An odd number of quarters swaps the two; the second and third quarter change signs.
  Bits q, sb, cb;
  std::memcpy(&q, &shifted, sizeof q);
  std::memcpy(&sb, &s, sizeof sb);
  std::memcpy(&cb, &c, sizeof cb);
  const Bits swap = -(q & 1);
  const Bits sine_bits = ((sb & ~swap) | (cb & swap)) ^ ((q & 2) << 62);
  const Bits cosine_bits = ((cb & ~swap) | (sb & swap)) ^ (((q + 1) & 2) << 62);
  std::memcpy(&sine, &sine_bits, sizeof sine);
  std::memcpy(&cosine, &cosine_bits, sizeof cosine);
}

/// e^x for −700 <= x <= 700, relative error at most 3e-16·(1 + |x|/100) (W92); below −700 it is e^−700, next to
/// nothing.
FROUDE_INLINE void exponential(const Pack& x, Pack& out) {
  constexpr double per_ln2 = 1.4426950408889634, ln2_high = 0.693147180369123816490,
                   ln2_low = 1.90821492927058770002e-10;
  Pack in = x;
  for (std::size_t i = 0; i < lanes; ++i) in[i] = in[i] < -700 ? -700 : in[i];
  const Pack shifted = in * per_ln2 + whole_only;
  const Pack n = shifted - whole_only;
  const Pack r = (in - n * ln2_high) - n * ln2_low;  // |r| <= ln 2 / 2; n·ln2_high is exact
  Pack p = r * (1.0 / 6227020800) + 1.0 / 479001600;
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
  Bits power, bits;
  std::memcpy(&power, &shifted, sizeof power);
  std::memcpy(&bits, &p, sizeof bits);
  bits += power << 52;
  std::memcpy(&out, &bits, sizeof out);
}

}  // namespace hydro::waves::simd
