#pragma once
/// \file  A plain writer of WAMIT files for tests, independent of the library's: any IPEROUT, any order, any extras.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "smooth_body.hpp"

namespace froude_test {

/// Wavenumber by bisection of ω² = gν tanh νh: slow and plain.
inline double wavenumber_by_bisection(double omega, const hydro::Water& water) {
  double low = 0, high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double nu = (low + high) / 2;
    const double squared = water.gravity * nu * std::tanh(nu * water.depth.metres());
    (squared < omega * omega ? low : high) = nu;
  }
  return low;
}

/// How to write the set.
struct WamitText {
  SmoothBody body = {};
  hydro::Water water = {1025, 9.8, hydro::WaterDepth::from_metres(12)};
  double ulen = 1;
  int iperout = 1;
  bool header = false;
  bool five_columns_at_limits = false;
  bool limits_as_frequencies = false;                ///< 0 for ω = 0 and −1 for ω = ∞
  std::vector<double> omega = {1.3, 0.4, 2.2, 0.9};  ///< in the order of the file
  std::vector<double> heading_deg = {30, -45};

  double per(double w) const {
    switch (iperout) {
      case 1:
        return 2 * std::numbers::pi / w;
      case 2:
        return w;
      case 3:
        return w * w * ulen / water.gravity;
      default:
        return wavenumber_by_bisection(w, water) * ulen;
    }
  }
  /// Powers of L as the manual lists them: 3 between translations, 4 mixed, 5 between rotations.
  static int power(int i, int j) { return 3 + (i % 6 >= 3 ? 1 : 0) + (j % 6 >= 3 ? 1 : 0); }

  std::string title() const {
    return header ? " WAMIT Numeric Output -- Filename  x.1     05-Dec-2016  12:18:57\n" : "";
  }

  std::string radiation() const {
    std::string text = title();
    const int n = 6 * body.bodies;
    const auto row = [&](double p, int i, int j, double A) {
      return fmt::format(" {:.15e} {:5d} {:5d} {:.15e}", p, i + 1, j + 1,
                         A / (water.density * std::pow(ulen, power(i, j))));
    };
    const std::string extra = five_columns_at_limits ? " 0\n" : "\n";
    for (const bool zero : {true, false})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          text += row(zero == limits_as_frequencies ? 0.0 : -1.0, i, j, zero ? body.A_zero(i, j) : body.A_inf(i, j)) +
                  extra;
    for (const double w : omega)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          text += row(per(w), i, j, body.A(i, j, w)) +
                  fmt::format(" {:.15e}\n", body.B(i, j, w) / (water.density * w * std::pow(ulen, power(i, j))));
    return text;
  }
  std::string excitation() const {
    std::string text = title();
    for (const double w : omega)
      for (const double degrees : heading_deg)
        for (int i = 0; i < 6 * body.bodies; ++i) {
          const auto X = body.X(i, w, hydro::Angle::from_degrees(degrees).radians()) /
                         (water.density * water.gravity * std::pow(ulen, i % 6 < 3 ? 2 : 3));
          text += fmt::format("{:.15e} {:.6e} {:4d} {:.15e} {:.15e} {:.15e} {:.15e}\n", per(w), degrees, i + 1,
                              std::abs(X), hydro::Angle::from_radians(std::arg(X)).degrees(), X.real(), X.imag());
        }
    return text;
  }
  std::string restoring() const {
    std::string text = title();
    for (int i = 0; i < 6 * body.bodies; ++i)
      for (int j = 0; j < 6 * body.bodies; ++j)
        text += fmt::format("{:4d} {:4d} {:.15e}\n", i + 1, j + 1,
                            body.C(i, j) / (water.density * water.gravity * std::pow(ulen, power(i, j) - 1)));
    return text;
  }
  /// The .1 file's path.
  std::filesystem::path write(const TemporaryFolder& folder) const {
    folder.write("x.3", excitation());
    folder.write("x.hst", restoring());
    return folder.write("x.1", radiation());
  }
  hydro::potential::ReadOptions options() const { return {water.density, water.gravity, water.depth, ulen, iperout}; }
  hydro::potential::Coefficients expected() const {
    std::vector<double> w = omega, beta;
    for (const double degrees : heading_deg) beta.push_back(hydro::Angle::from_degrees(degrees).radians());
    std::sort(w.begin(), w.end());
    std::sort(beta.begin(), beta.end());
    return body.coefficients(water, w, beta);
  }
};

}  // namespace froude_test
