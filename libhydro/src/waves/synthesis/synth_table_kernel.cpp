#include "synth_table_kernel.hpp"

#include "synth_simd.hpp"

namespace hydro::waves::table {
namespace {

using simd::lanes;
using simd::Pack;

// Adds what eight levels at the stations of one row give to the parts.
FROUDE_INLINE void add_levels(const double* value, const double* rate_table, std::size_t step, const AxisWeights& b,
                              const Pack& T, const Pack& T_slope, Pack* parts_of_row) {
  Pack v{}, v_b{}, v_bb{}, r{}, r_b{}, x, y;
  for (std::size_t k = 0; k < b.count; ++k, value += step, rate_table += step) {
    simd::load(value, x);
    simd::load(rate_table, y);
    v += b.value[k] * x;
    v_b += b.slope[k] * x;
    v_bb += b.bend[k] * x;
    r += b.value[k] * y;
    r_b += b.slope[k] * y;
  }
  parts_of_row[phi] += T * v;
  parts_of_row[phi_b] += T * v_b;
  parts_of_row[phi_bb] += T * v_bb;
  parts_of_row[phi_z] += T_slope * v;
  parts_of_row[phi_bz] += T_slope * v_b;
  parts_of_row[rate] += T * r;
  parts_of_row[rate_b] += T * r_b;
  parts_of_row[rate_z] += T_slope * r;
}

}  // namespace

// Three neighbouring packs at a time: whole stretches of each row, not one line of each. By hand, since compilers keep
// arrays of sums in memory.
FROUDE_KERNEL void contract_time(const double* from, std::size_t stride, const AxisWeights& time, std::size_t size,
                                 double* value, double* rate_out) {
  std::size_t at = 0;
  for (; at + 3 * lanes <= size; at += 3 * lanes) {
    Pack v0{}, v1{}, v2{}, r0{}, r1{}, r2{}, x0, x1, x2;
    const double* row = from + at;
    for (std::size_t l = 0; l < time.count; ++l, row += stride) {
      simd::load(row, x0);
      simd::load(row + lanes, x1);
      simd::load(row + 2 * lanes, x2);
      v0 += time.value[l] * x0;
      v1 += time.value[l] * x1;
      v2 += time.value[l] * x2;
      r0 += time.slope[l] * x0;
      r1 += time.slope[l] * x1;
      r2 += time.slope[l] * x2;
    }
    simd::store(v0, value + at);
    simd::store(v1, value + at + lanes);
    simd::store(v2, value + at + 2 * lanes);
    simd::store(r0, rate_out + at);
    simd::store(r1, rate_out + at + lanes);
    simd::store(r2, rate_out + at + 2 * lanes);
  }
  for (; at < size; at += lanes) {
    Pack v{}, r{}, x;
    const double* row = from + at;
    for (std::size_t l = 0; l < time.count; ++l, row += stride) {
      simd::load(row, x);
      v += time.value[l] * x;
      r += time.slope[l] * x;
    }
    simd::store(v, value + at);
    simd::store(r, rate_out + at);
  }
}

FROUDE_KERNEL void contract_time(const double* from, std::size_t stride, const AxisWeights& time, std::size_t size,
                                 double* value) {
  for (std::size_t at = 0; at < size; at += lanes) {
    Pack v{}, x;
    const double* row = from + at;
    for (std::size_t l = 0; l < time.count; ++l, row += stride) {
      simd::load(row, x);
      v += time.value[l] * x;
    }
    simd::store(v, value + at);
  }
}

FROUDE_KERNEL void contract_place(const double* value, const double* rate_table, const Strides& stride,
                                  const AxisWeights& a, const AxisWeights& b, const double* at, const double* at_slope,
                                  std::size_t levels, AtHeight& out) {
  Pack plain{}, by_a{}, by_aa{};
  for (std::size_t i = 0; i < a.count; ++i, value += stride.a, rate_table += stride.a) {
    Pack row[parts] = {}, T, T_slope, sums;
    for (std::size_t q = 0; q < levels; q += lanes) {
      simd::load(at + q, T);
      simd::load(at_slope + q, T_slope);
      add_levels(value + q, rate_table + q, stride.b, b, T, T_slope, row);
    }
    simd::sums(row, sums);
    plain += a.value[i] * sums;
    by_a += a.slope[i] * sums;
    by_aa += a.bend[i] * sums;
  }
  simd::store(plain, out.plain);
  simd::store(by_a, out.by_a);
  simd::store(by_aa, out.by_aa);
}

FROUDE_KERNEL double contract_elevation(const double* from, const Strides& stride, const AxisWeights& time,
                                        const AxisWeights& a, const AxisWeights& b) {
  Pack total{};
  for (std::size_t k = 0; k < b.count; k += lanes) {
    Pack along{}, weight, x;
    for (std::size_t i = 0; i < a.count; ++i) {
      Pack v{};
      const double* row = from + i * stride.a + k;
      for (std::size_t l = 0; l < time.count; ++l, row += stride.time) {
        simd::load(row, x);
        v += time.value[l] * x;
      }
      along += a.value[i] * v;
    }
    simd::load(b.value + k, weight);
    total += weight * along;
  }
  return simd::sum(total);
}

FROUDE_KERNEL void sum_waves(const double* profile, std::size_t levels, std::size_t waves,
                             const std::complex<double>* a, const double* cosine, const double* sine, double* room,
                             double* to) {
  for (std::size_t j = 0; j < waves; ++j)
    for (std::size_t n = instants_at_once * j; n < instants_at_once * (j + 1); ++n)
      room[n] = a[j].real() * cosine[n] - a[j].imag() * sine[n];
  for (std::size_t q = 0; q < levels; q += lanes) {
    Pack sum0{}, sum1{}, sum2{}, sum3{}, p;
    const double* wave = room;
    for (std::size_t j = 0; j < waves; ++j, profile += lanes, wave += instants_at_once) {
      simd::load(profile, p);
      sum0 += wave[0] * p;
      sum1 += wave[1] * p;
      sum2 += wave[2] * p;
      sum3 += wave[3] * p;
    }
    simd::store(sum0, to + q);
    simd::store(sum1, to + levels + q);
    simd::store(sum2, to + 2 * levels + q);
    simd::store(sum3, to + 3 * levels + q);
  }
}

}  // namespace hydro::waves::table
