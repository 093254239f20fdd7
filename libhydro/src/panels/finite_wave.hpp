#pragma once
/// \file  What the sea bed adds to waves of one frequency, tabulated. (G7) to (G9) in docs/theory/panels.md.
/// Not installed.
#include <array>
#include <vector>

#include "patches.hpp"

namespace hydro::panels {

/// d(R, V) of (G7) and its slopes, real parts, 1/m and 1/m².
struct BedWave {
  double d, d_R, d_V;
  bool whole;  ///< in the lower half of the water the part w(R, 2h − V) of deep water is in it
};

/// For one K in water of one depth; 0 <= R <= reach, 0 <= V <= 2h. K may be +∞.
class FiniteWave {
 public:
  FiniteWave(double K, double depth, double reach);

  /// From the table: 1e-8/h and 1e-8/h².
  BedWave operator()(double R, double V) const;
  double k() const { return k_; }  ///< wavenumber; 0 if K = ∞
  /// √C₀ cosh k(z+h), C₀ of (G8), given −z; without overflow.
  double profile(double down) const;

 private:
  std::vector<BedWave> near(const std::vector<double>& R, const std::vector<double>& V) const;
  std::vector<BedWave> far(const std::vector<double>& R, const std::vector<double>& V) const;
  void tabulate(double reach);
  void add_column(const std::vector<double>& R, const std::vector<double>& V, const std::vector<BedWave>& at);
  double wave_scaled() const;  ///< C₀ e^{2kh}/4

  double K_, h_, k_ = 0, strength_ = 0;  // of waves, √C₀ e^{kh}/2
  std::vector<double> kappa_;            ///< of evanescent modes
  double width_ = 0, height_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<Patch<3>> patch_;  // column by column
};

}  // namespace hydro::panels
