#pragma once
/// \file  The radial functions of (C4) at the cylinder itself. Not installed.
#include <complex>
#include <vector>

#include "hydro/cylinders/vertical_modes.hpp"
#include "scatterer.hpp"

namespace hydro::cylinders {

/// What matching needs of S_n and Q_n at r = a, for m = 0 … orders − 1.
class RadialFunctions {
 public:
  /// Ratios K/K′ are computed for all modes, the rest for the first `channels`.
  RadialFunctions(const VerticalModes& modes, double radius, int orders, int channels);

  using Complex = std::complex<double>;
  /// q_n = Q_n/Q_n′, m; n = 0 is complex, the others negative.
  Complex wave_ratio(int m) const { return wave_[static_cast<std::size_t>(m)].ratio; }
  double ratio(int m, int n) const { return ratio_[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(m)]; }
  Complex slope_Q(int m, int n) const;  ///< Q_n′(a)
  double slope_S(int m, int n) const;   ///< S_n′(a)
  Complex wronskian(int n) const;       ///< a (S_n Q_n′ − S_n′ Q_n): −2i/π for n = 0, else −1

 private:
  struct Wave {
    Complex ratio, slope_Q;
    double slope_S;
  };
  std::vector<Wave> wave_;
  std::vector<std::vector<double>> ratio_;    // [n − 1][m]
  std::vector<std::vector<double>> slope_S_;  // [n − 1][m], first channels only
};

/// From velocities to the amplitudes of (C4): T and R hold V_n per unit ψ_n a_n and velocity, E loads per unit ψ_n a_n.
void to_amplitudes(AzimuthalOrder& order, int m, const RadialFunctions& radial, double radius);

/// s_m = |H⁽²⁾_m(ka)| for m = 0 … orders − 1; ones if there is no wave.
std::vector<double> wave_scales(double k, double radius, int orders);

}  // namespace hydro::cylinders
