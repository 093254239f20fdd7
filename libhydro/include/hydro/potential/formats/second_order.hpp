#pragma once
/// \file  Wave loads of second order: quadratic transfer functions and mean drift, read from WAMIT's files. (P35)
#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::potential {

/// What a pair of waves a₁ e^{iω₁t}, a₂ e^{iω₂t} exerts on a body about its origin: with all pairs of a sea, both
/// orders,
///
///   F = Re Σ_k Σ_l a_k a̅_l T(ω_k, β_k; ω_l, β_l) e^{i(ω_k − ω_l)t}      difference frequencies
///   F = Re Σ_k Σ_l a_k a_l T(ω_k, β_k; ω_l, β_l) e^{i(ω_k + ω_l)t}      sum frequencies
///
/// a against the elevation at the origin, T in N/m² and N m/m².
struct QuadraticTransfer {
  enum class Kind {
    mean_drift,  ///< of difference frequencies, what two equal waves exert
    difference,
    sum
  };
  Kind kind;
  std::vector<double> omega;    ///< rad/s, increasing
  std::vector<double> heading;  ///< rad, increasing
  /// T of heading h₁, h₂ at h₁ · headings + h₂, mode by mode, (Nω, Nω); of a mean drift (Nω, 1). Empty: not in the
  /// file.
  std::vector<std::array<Eigen::MatrixXcd, 6>> of_headings;
  std::vector<std::string> notes;  ///< what the file leaves open

  const std::array<Eigen::MatrixXcd, 6>& at(std::size_t h1, std::size_t h2) const {
    return of_headings[h1 * heading.size() + h2];
  }
  bool has(std::size_t h1, std::size_t h2) const { return at(h1, h2)[0].size() > 0; }
};

struct SecondOrderOptions {
  double density, gravity;  ///< kg/m³, m/s²
  double ulen = 1;          ///< WAMIT's ULEN, m
  int iperout = 1;          ///< what PER is: 1 period in s, 2 rad/s
  int body = 1;             ///< whose modes are read, from 1: 6 (body − 1) + 1 …
};

/// WAMIT's .7, .8, .9 (mean drift), .10d, .11d, .12d (difference) and .10s, .11s, .12s (sum), by the name's ending.
/// Half of a matrix is completed by T(2; 1) = T̅(1; 2) of differences and T(2; 1) = T(1; 2) of sums. \throws InputError
/// with line and column: another ending, a row of another length, a row that stands twice; a pair of frequencies,
/// headings or a mode that is there for some pairs and not for others
QuadraticTransfer read_second_order(const std::filesystem::path& path, const SecondOrderOptions& options);

}  // namespace hydro::potential
