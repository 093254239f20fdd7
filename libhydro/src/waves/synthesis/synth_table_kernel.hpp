#pragma once
/// \file  Contraction of a table with the weights of interpolation (W97).
#include <complex>
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

/// The potential and its rate at one place and instant, with their derivatives along b and by height.
enum Part : std::size_t { phi, phi_b, phi_bb, phi_z, phi_bz, rate, rate_b, rate_z, parts };

/// Table contracted over time: value[...] and rate[...] for `size` numbers that stand `stride` apart in time.
void contract_time(const double* from, std::size_t stride, const AxisWeights& time, std::size_t size, double* value,
                   double* rate);

/// The same without the rate.
void contract_time(const double* from, std::size_t stride, const AxisWeights& time, std::size_t size, double* value);

/// The parts and their first two derivatives along a, at a place and a height, from a table at one instant (value,
/// rate) whose first point is the first used. `at` and `at_slope`: the polynomials at that height and their slopes,
/// `levels` of each.
struct AtHeight {
  double plain[parts], by_a[parts], by_aa[parts];
};
void contract_place(const double* value, const double* rate_table, const Strides& stride, const AxisWeights& a,
                    const AxisWeights& b, const double* at, const double* at_slope, std::size_t levels, AtHeight& out);

/// At how many instants sum_waves() sums at once.
inline constexpr std::size_t instants_at_once = 4;

/// Σ_j profile(q, j) Re(a_j turn_nj) for all levels q, in whole packs, and four instants n. `profile` has the levels of
/// one pack of all waves before those of the next; `cosine` and `sine` of the turns have the instants of a wave next to
/// one another; `room` holds as many numbers. Instants of `to` stand `levels` apart.
void sum_waves(const double* profile, std::size_t levels, std::size_t waves, const std::complex<double>* a,
               const double* cosine, const double* sine, double* room, double* to);

/// Σ weights of an elevation table: time × a × b, b contiguous and readable up to whole packs.
double contract_elevation(const double* from, const Strides& stride, const AxisWeights& time, const AxisWeights& a,
                          const AxisWeights& b);

}  // namespace hydro::waves::table
