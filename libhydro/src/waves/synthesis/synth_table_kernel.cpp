#include "synth_table_kernel.hpp"

#include <initializer_list>

#include "synth_simd.hpp"

namespace hydro::waves::table {
namespace {

using simd::lanes;
using simd::Pack;

// Adds one station's potential and rate to the nine sums.
FROUDE_INLINE void add_station(const Pack& value, const Pack& rate_value, const AxisWeights& a, std::size_t i,
                               const AxisWeights& b, std::size_t k, Pack* sums) {
  sums[phi] += (a.value[i] * b.value[k]) * value;
  sums[phi_b] += (a.value[i] * b.slope[k]) * value;
  sums[phi_bb] += (a.value[i] * b.bend[k]) * value;
  sums[rate] += (a.value[i] * b.value[k]) * rate_value;
  sums[rate_b] += (a.value[i] * b.slope[k]) * rate_value;
  if (a.count == 1) return;  // long-crested: nothing changes along a
  sums[phi_a] += (a.slope[i] * b.value[k]) * value;
  sums[phi_aa] += (a.bend[i] * b.value[k]) * value;
  sums[phi_ab] += (a.slope[i] * b.slope[k]) * value;
  sums[rate_a] += (a.slope[i] * b.value[k]) * rate_value;
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

FROUDE_KERNEL void contract_place(const double* value, const double* rate_table, const Strides& stride,
                                  const AxisWeights& a, const AxisWeights& b, const double* at, const double* at_slope,
                                  std::size_t levels, AtHeight& out) {
  Pack values[parts] = {}, slopes[parts] = {};
  for (std::size_t q = 0; q < levels; q += lanes) {
    Pack sums[parts] = {}, v, r, T, T_slope;
    for (std::size_t i = 0; i < a.count; ++i)
      for (std::size_t k = 0; k < b.count; ++k) {
        simd::load(value + i * stride.a + k * stride.b + q, v);
        simd::load(rate_table + i * stride.a + k * stride.b + q, r);
        add_station(v, r, a, i, b, k, sums);
      }
    simd::load(at + q, T);
    simd::load(at_slope + q, T_slope);
    for (const Part p : {phi_a, phi_b, phi_aa, phi_ab, phi_bb, rate, rate_a, rate_b}) values[p] += T * sums[p];
    for (const Part p : {phi, phi_a, phi_b, rate}) slopes[p] += T_slope * sums[p];
  }
  for (std::size_t p = 0; p < parts; ++p) {
    out.value[p] = simd::sum(values[p]);
    out.slope[p] = simd::sum(slopes[p]);
  }
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

}  // namespace hydro::waves::table
