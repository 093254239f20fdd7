#pragma once
/// \file  What linear potential theory says about N floating bodies, in one convention whatever code it came from.
///
/// Convention (docs/theory/conventions.md):
///   (P1)  motion, load and wave are Re(amplitude · e^{+iωt}); x forward, y port, z up, origin in the still waterplane
///   (P2)  wave of unit amplitude: ζ(x, y, t) = Re e^{i(ωt − k(x cos β + y sin β))}; β is where it goes, from +x
///   towards +y (P3)  load on the bodies: F = X ζ_a − (C + iωB − ω²A) ξ, in the order surge, sway, heave, roll, pitch,
///   yaw of body 1, body 2, …
/// SI throughout. Rotations are in radians; moments and rotations are about each body's reference point.
#include <Eigen/Core>

#include <complex>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::potential {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Facts about one body. What a file does not say stays empty; nothing is guessed.
struct BodyData {
  std::string name;                                   ///< "body1" where the file has no name
  std::optional<Eigen::Vector3d> reference_point;     ///< in the global frame of the data, m
  std::optional<Eigen::Vector3d> centre_of_gravity;   ///< global, m
  std::optional<Eigen::Vector3d> centre_of_buoyancy;  ///< global, m
  std::optional<double> displaced_volume;             ///< m³
};

/// Added mass, damping, excitation and hydrostatics of N bodies.
struct Coefficients {
  Water water;
  std::vector<BodyData> body;      ///< N
  std::vector<double> omega;       ///< Nω, rad/s, finite, positive, strictly increasing
  std::vector<double> heading;     ///< Nβ, rad, strictly increasing; empty if there is no excitation
  std::vector<Eigen::MatrixXd> A;  ///< Nω × (6N, 6N): added mass, kg, kg m, kg m²; row: load on, column: motion of
  std::vector<Eigen::MatrixXd> B;  ///< Nω × (6N, 6N): radiation damping, kg/s …
  std::optional<Eigen::MatrixXd> A_zero, A_inf;  ///< limits ω → 0 and ω → ∞, (6N, 6N)
  std::vector<Eigen::MatrixXcd>
      X;  ///< Nβ × (6N, Nω): excitation per metre of amplitude, N/m, N; phase as (P2) at the global origin
  std::optional<Eigen::MatrixXd> C;  ///< (6N, 6N): hydrostatic and gravitational restoring, N/m, N, N m
  std::string source;                ///< format and files, for people
  std::vector<std::string> notes;    ///< what the reader had to decide, one sentence each

  int bodies() const { return static_cast<int>(body.size()); }
  int modes() const { return 6 * bodies(); }

  /// Sizes agree, frequencies and headings increase, everything is finite.
  /// \throws InputError naming what is wrong, with `source`
  void validate() const;
};

/// Velocity at P + r from that at P of a rigid body: v(P + r) = T v(P), T = [I, −[r]×; 0, I]. A load moves the other
/// way by the transpose, so matrices move as A(P) = Tᵀ A(P + r) T.
Matrix6 rigid_shift(const Eigen::Vector3d& r);

/// What WAMIT-style files leave unsaid.
struct ReadOptions {
  std::optional<double> density = {};  ///< ρ; needed for HAMS, HDB, and WAMIT unless its .out file states it
  std::optional<double> gravity = {};  ///< g; needed for HAMS, HDB, and the numeric files of WAMIT without a .out file
  std::optional<WaterDepth> depth = {};  ///< needed for VERES, HDB, and the numeric files of WAMIT without a .out file
  std::optional<double> ulen = {};       ///< WAMIT's ULEN, m; empty: that of the .out file, else 1; refused for other
                                         ///< formats
  std::optional<int> iperout = {};  ///< WAMIT's IPEROUT 1…4; empty: 1 (periods), unless a file contradicts it; refused
                                    ///< for other formats
};

/// Reads a file of any format and says in `source` what it was taken for; docs/guide/coefficients.md lists the formats
/// and which file or folder to give of each. Formats are told apart by content, not by name.
/// \throws InputError with file, line and remedy
Coefficients read(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace hydro::potential
