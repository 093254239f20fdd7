#pragma once
/// \file  What panel and strip codes compute beyond the coefficients: motions, mean drift, sum- and
/// difference-frequency loads. Tables for people to look at and to compare with; time factor, wave and modes as in
/// coefficients.hpp (P1), (P2).
///
/// All about the reference point that the file's own run had; phases are relative to the wave at the origin of the
/// data.
#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// Motions of the bodies in regular waves, per metre of amplitude.
struct RaoTable {
  std::vector<double> omega;             ///< Nω, rad/s, increasing
  std::vector<double> heading;           ///< Nβ, rad, increasing
  std::vector<int> mode;                 ///< modes that the file has, from 0 through all bodies, increasing
  std::vector<Eigen::MatrixXcd> motion;  ///< Nβ × (modes, Nω), m/m and rad/m
  std::string source;
  std::vector<std::string> notes;
};

/// Mean second-order loads in regular waves, or in two crossing trains of one frequency.
struct DriftForces {
  std::vector<double> omega;                   ///< Nω, rad/s, increasing
  std::vector<std::array<double, 2>> heading;  ///< of both trains, rad, increasing; the same twice for one train
  std::vector<int> mode;                       ///< as in RaoTable
  std::vector<Eigen::MatrixXcd> load;          ///< pairs × (modes, Nω), N/m² and N/m: times both amplitudes
  std::string method;                          ///< momentum, pressure, control surface, …
  std::string source;
  std::vector<std::string> notes;
};

/// Second-order loads of pairs of waves, Re(F a₁ a₂^{(*)} e^{i(ω₁ ± ω₂)t}).
struct QuadraticLoads {
  bool is_sum = false;                              ///< ω₁ + ω₂, else ω₁ − ω₂
  std::vector<double> omega;                        ///< Nω, rad/s, increasing
  std::vector<std::array<double, 2>> heading;       ///< of the first and the second wave, rad, increasing
  std::vector<int> mode;                            ///< as in RaoTable
  std::vector<std::vector<Eigen::MatrixXcd>> load;  ///< [pair][mode] (Nω, Nω), N/m², N/m; zero where not `known`
  using Known = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;
  std::vector<std::vector<Known>> known;  ///< where the file has the pair of frequencies or its mirror (P24)
  std::string source;
  std::vector<std::string> notes;
};

/// What a file of responses is, by its extension.
enum class ResponseKind { none, rao, drift, quadratic };
/// .4 and .re1 hold motions, .7, .8, .9 and .re2 mean drift, .10d/s, .11d/s and .12d/s quadratic loads.
ResponseKind response_kind(const std::filesystem::path& path);

/// Motions from WAMIT's .4 (P24) or VERES's .re1 (P26). For IPEROUT 3 and 4 gravity and depth are needed as in read().
/// \throws InputError with file and line, also if long waves move the bodies the wrong way (P25): then the file was
/// written for e^{−iωt}
RaoTable read_rao(const std::filesystem::path& path, const ReadOptions& options = {});

/// Mean drift from WAMIT's .8 (momentum), .9 (pressure), .7 (control surface) (P24) or VERES's .re2 (P26). WAMIT's need
/// density and gravity. \throws InputError with file and line
DriftForces read_drift(const std::filesystem::path& path, const ReadOptions& options = {});

/// Quadratic loads from WAMIT's .10 (quadratic part), .11 (indirect) or .12 (direct), with d for differences and s for
/// sums (P24). Density and gravity are needed. \throws InputError with file and line
QuadraticLoads read_quadratic(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace hydro::potential
