#pragma once
/// \file  Contraction of a table with the weights of interpolation (W97).
#include <cstddef>

namespace hydro::waves::table {

/// A table with axes time, a, b, and `level` last; steps between neighbours along each, in doubles.
struct Strides {
  std::size_t time, a, b;
};

/// Weights along one axis: value, first and second derivative, in units of x; `count` points.
struct AxisWeights {
  const double *value, *slope, *bend;
  std::size_t count;
};

/// The potential at one place and instant, as polynomials in the vertical. Each points to `levels` numbers.
enum Part : std::size_t { phi, phi_a, phi_b, phi_aa, phi_ab, phi_bb, rate, rate_a, rate_b, parts };

/// Table contracted over time: value[...] and rate[...] for `size` numbers that stand `stride` apart in time.
void contract_time(const double* from, std::size_t stride, const AxisWeights& time, std::size_t size, double* value,
                   double* rate);

/// out[part·levels + level], from a table at one instant (value, rate), both starting at the first point used.
void contract_place(const double* value, const double* rate_table, const Strides& stride, const AxisWeights& a,
                    const AxisWeights& b, std::size_t levels, double* out);

/// Sums over levels of all parts with the polynomials at a height and with their slopes.
struct AtHeight {
  double value[parts], slope[parts];
};
void at_height(const double* contracted, const double* value, const double* slope, std::size_t levels, AtHeight& out);

/// Σ weights of an elevation table: time × a × b, b contiguous and readable up to whole packs.
double contract_elevation(const double* from, const Strides& stride, const AxisWeights& time, const AxisWeights& a,
                          const AxisWeights& b);

}  // namespace hydro::waves::table
