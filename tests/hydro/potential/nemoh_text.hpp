#pragma once
/// \file  A plain writer of NEMOH results for tests: any column of frequencies, several bodies, both kinds of titles.
#include <fmt/format.h>

#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "smooth_body.hpp"

namespace froude_test {

/// How to write a case.
struct NemohText {
  SmoothBody body = {};
  hydro::Water water = {1025, 9.8, hydro::WaterDepth::from_metres(12)};
  std::vector<Eigen::Vector3d> point = {{0, 0, -2}};  ///< of the rotations, one a body
  Eigen::Vector2d wave_origin = {0, 0};
  std::string column = "w (rad/s)";  ///< or f (Hz), T (s)
  bool by_capytaine = false;         ///< headers of dots, labels of modes, headings in radians
  std::vector<double> omega = {0.4, 0.9, 1.3, 2.2};
  std::vector<double> heading_deg = {-45, 30};

  std::string cal() const {
    std::string text = fmt::format(
        "--- Environment ---\n{:.10g}\t! RHO\n{:.10g}\t! G\n{:.10g}\t! DEPTH\n{:.10g} {:.10g}\t! XEFF YEFF\n"
        "--- Description of floating bodies ---\n{}\t! Number of bodies\n",
        water.density, water.gravity, water.depth.is_infinite() ? 0 : water.depth.metres(), wave_origin.x(),
        wave_origin.y(), body.bodies);
    for (int b = 0; b < body.bodies; ++b) {
      text += fmt::format("--- Body {} ---\nx.dat\t! mesh\n10 5\t! points, panels\n", b + 1);
      const auto& p = point[static_cast<std::size_t>(b)];
      for (const char* what : {"degrees of freedom", "resulting generalised forces"}) {
        text += fmt::format("6\t! Number of {}\n", what);
        for (int mode = 0; mode < 6; ++mode)
          text += fmt::format("{} {}. {}. {}. {:.10g} {:.10g} {:.10g}\t! mode\n", mode < 3 ? 1 : 2, int(mode % 3 == 0),
                              int(mode % 3 == 1), int(mode % 3 == 2), mode < 3 ? 0 : p.x(), mode < 3 ? 0 : p.y(),
                              mode < 3 ? 0 : p.z());
      }
      text += "0\t! Number of lines of additional information\n";
    }
    return text + fmt::format("--- Load cases to be solved ---\n{} 0.4 2.2\t! frequencies\n{} -45 30\t! directions\n",
                              omega.size(), heading_deg.size());
  }
  double first_column(double w) const {
    if (column == "f (Hz)") return w / (2 * std::numbers::pi);
    return column == "T (s)" ? 2 * std::numbers::pi / w : w;
  }
  std::string head() const { return by_capytaine ? "...\n...\n" : fmt::format("VARIABLES=\"{}\"\n", column); }

  std::string radiation() const {
    constexpr const char* names[] = {"Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"};
    std::string text = head();
    for (int j = 0; j < 6 * body.bodies; ++j) {
      text += by_capytaine ? fmt::format("Body {}__{}\n", j / 6 + 1, names[j % 6])
                           : fmt::format("Zone t=\"Motion of body {:4d} in DoF {:3d}\",I= {:5d},F=POINT\n", j / 6 + 1,
                                         j % 6 + 1, omega.size());
      for (const double w : omega) {
        text += fmt::format(" {:.15e}", first_column(w));
        for (int i = 0; i < 6 * body.bodies; ++i)
          text += fmt::format(" {:.15e} {:.15e}", body.A(i, j, w), body.B(i, j, w));
        text += "\n";
      }
    }
    return text;
  }
  /// `share` of the excitation.
  std::string force(double share = 1) const {
    std::string text = head();
    for (const double degrees : heading_deg) {
      const double beta = hydro::Angle::from_degrees(degrees).radians();
      text += by_capytaine ? fmt::format("angle={:.17g}\n", beta)
                           : fmt::format("Zone t=\"Excitation force - beta = {:.10f} deg\",I= {:5d},F=POINT\n", degrees,
                                         omega.size());
      for (const double w : omega) {
        text += fmt::format(" {:.15e}", first_column(w));
        const double k = hydro::waves::wavenumber(w, water);
        for (int i = 0; i < 6 * body.bodies; ++i) {
          // The load per wave that is zero at wave_origin, for e^{−iωt}: conj(X e^{+ik·r}).
          const double way = k * (std::cos(beta) * wave_origin.x() + std::sin(beta) * wave_origin.y());
          const auto X = std::conj(body.X(i, w, beta) * std::polar(1.0, way));
          text += fmt::format(" {:.15e} {:.15e}", share * std::abs(X), std::arg(X));
        }
        text += "\n";
      }
    }
    return text;
  }
  /// The folder of the case.
  std::filesystem::path write(const TemporaryFolder& folder) const {
    std::filesystem::create_directory(folder / "Results");
    folder.write("Nemoh.cal", cal());
    folder.write("Results/RadiationCoefficients.tec", radiation());
    folder.write("Results/ExcitationForce.tec", force());
    return folder / "";
  }
  hydro::potential::Coefficients expected() const {
    std::vector<double> beta;
    for (const double degrees : heading_deg) beta.push_back(hydro::Angle::from_degrees(degrees).radians());
    return body.coefficients(water, omega, beta);
  }
};

}  // namespace froude_test
