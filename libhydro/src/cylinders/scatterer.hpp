#pragma once
/// \file  One vertical cylinder as its neighbours see it: what it sends out when it is struck or moved, and the loads
/// on it. Not installed.
///
/// Around the cylinder, for each azimuthal order m (as e^{imθ}; only |m| matters),
///   φ = Σ_n [a_n S_n(r) + b_n Q_n(r)] Z_n(z)                                                   (C4)
///   n = 0: S = s_m J_m(kr),          Q = H⁽²⁾_m(kr)/s_m,         s_m = |H⁽²⁾_m(ka)|
///   n > 0: S = K_m(κ_n a) I_m(κ_n r), Q = K_m(κ_n r)/K_m(κ_n a)
/// The factors keep all numbers near one. Loads are given as L = ∬ φ n_i dS/γ, γ = 2π for m = 0 and π for m = 1 with φ
/// the factor of cos θ; a force is iωρ times ∬ φ n_i dS.
#include <Eigen/Core>

#include <vector>

namespace hydro::cylinders {

/// One azimuthal order. Channels: the modes n = 0 … of the vertical. Motions: heave for m = 0; surge and pitch about
/// the centre in the still waterplane for m = 1; none beyond.
struct AzimuthalOrder {
  Eigen::MatrixXcd T;  ///< (channels, channels): b = T a, the diffraction transfer matrix
  Eigen::MatrixXcd R;  ///< (channels, motions): b per unit velocity
  Eigen::MatrixXcd E;  ///< (motions, channels): L per unit a
  Eigen::MatrixXcd L;  ///< (motions, motions): L per unit velocity; row: load, column: motion
};

struct Scatterer {
  std::vector<AzimuthalOrder> order;  ///< m = 0, 1, …
};

}  // namespace hydro::cylinders
