#pragma once
/// \file  Private: where A and B do not fit between their neighbours; shared by the doctor and by healing. (P72), (P73)
#include <string_view>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// single_number: in A or in B alone; lonely: in both, but of one body among several; irregular, resonance: (P73).
enum class SpikeKind { single_number, lonely, irregular, resonance };
std::string_view to_string(SpikeKind kind);

struct Spike {
  std::size_t at;     ///< index of the frequency
  Eigen::Index mode;  ///< from 0
  double size;        ///< misfit relative to the mode's size
  SpikeKind kind;
};

/// Spikes of the diagonals of A and B; the two frequencies at each end cannot be judged.
std::vector<Spike> find_spikes(const Coefficients& c);

/// The value at `at` of the polynomial through the frequencies `nodes`, with `value(index)` of any kind that adds and
/// scales (Lagrange). (P72)
template <class Value>
auto through(const std::vector<double>& omega, const std::vector<std::size_t>& nodes, double at, Value value) {
  auto sum = value(nodes.front());
  sum *= 0.0;
  for (const std::size_t i : nodes) {
    double weight = 1;
    for (const std::size_t j : nodes)
      if (j != i) weight *= (at - omega[j]) / (omega[i] - omega[j]);
    sum += weight * value(i);
  }
  return sum;
}

/// No irregular frequency is lower, rad/s: a hull's water inside sloshes slowest under a disc of the same waterplane.
/// 0 if waterplanes are unknown. (P73)
double lowest_irregular_frequency(const Coefficients& c);

}  // namespace hydro::potential
