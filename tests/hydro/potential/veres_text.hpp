#pragma once
/// \file  A plain writer of VERES files for tests.
#include <fmt/format.h>

#include <numbers>

#include "smooth_body.hpp"

namespace froude_test {

/// A body of formulas in VERES's own axes, written as its files are.
struct VeresText {
  SmoothBody body = {};
  std::vector<double> omega{0.4, 0.9, 1.3}, heading_deg{0, 60, 180};
  double speed = 0, trim = 0, x = 4, draught = 6, z = 5;  ///< point of motions: x aft of Lpp/2, z over the baseline
  bool version2 = true;
  double addition = 0;

  static std::string matrix(auto entry) {
    std::string text;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) text += fmt::format("{:.17g}{}", entry(i, j), j == 5 ? '\n' : ' ');
    return text;
  }
  std::string header(const std::string& title) const {
    return " " + title + " - VERES Version  4\n run\n ship\n load\n\n ShipX exported data\n 1025 9.81\n 80 20 " +
           fmt::format("{}\n 3 7\n", draught);
  }
  std::string point() const { return fmt::format("{} 0 {} {} {}\n", speed, trim, x, z); }
  std::string re7() const {
    const auto none = [&](int i, int j) { return i == 3 && j == 3 ? addition : 0.0; };
    std::string text = header("HYDRODYNAMIC COEFFICIENTS" + std::string(version2 ? " (Version 2)" : ""));
    if (version2) text += "-1 2\n";
    text += fmt::format("1 {} {} 6\n", heading_deg.size(), omega.size());
    text += matrix([](int i, int j) { return i == j ? 1.0 : 0.0; }) + point();
    for (const double beta : heading_deg) {
      text += fmt::format("{}\n", beta);
      for (const double w : omega) {
        text += fmt::format("{}\n", w);
        text += matrix([&](int i, int j) { return body.A(i, j, w); }) + (version2 ? matrix(none) : "");
        text += matrix([&](int i, int j) { return body.B(i, j, w); }) + (version2 ? matrix(none) : "");
        text += matrix([&](int i, int j) { return body.C(i, j); }) + (version2 ? matrix(none) : "") + "0 0 0\n";
      }
    }
    return text;
  }
  std::string transfer(const std::string& title) const {
    std::string text = header(title) + fmt::format("1 {} {} 6\n", heading_deg.size(), omega.size()) + point();
    for (const double beta : heading_deg) {
      text += fmt::format("{}\n", beta);
      for (const double w : omega) {
        text += fmt::format("{}\n", w);
        for (int i = 0; i < 6; ++i) {
          const auto X = body.X(i, w, beta * std::numbers::pi / 180);
          text += fmt::format("{} {:.17g} {:.17g}\n", i + 1, X.real(), X.imag());
        }
      }
    }
    return text;
  }
  std::filesystem::path write(const TemporaryFolder& folder) const {
    folder.write("s.re8", transfer("WAVE EXCITATION FORCE TRANSFER FUNCTIONS"));
    return folder.write("s.re7", re7());
  }
};

}  // namespace froude_test
