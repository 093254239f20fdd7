#pragma once
/// \file  A plain writer of AQWA's .AH1 files for tests.
#include <fmt/format.h>

#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "smooth_body.hpp"

namespace froude_test {

/// A plain writer of .AH1 files, with more digits than AQWA's.
struct AqwaText {
  SmoothBody body = {};
  hydro::Water water = {1025, 9.8, hydro::WaterDepth::from_metres(12)};
  std::vector<Eigen::Vector3d> cog = {{0, 0, -2}};
  bool is_recent = true;  ///< from version 18.2 on GENERAL begins with the structure's number
  bool has_limits = true;
  bool has_coupling = true;
  std::vector<double> omega = {0.4, 0.9, 1.3, 2.2, 2.5, 2.8, 3.1};
  std::vector<double> heading_deg = {-180, -45, 0, 30, 60, 90, 180};

  static std::string wrapped(const std::vector<double>& values) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i)
      text += fmt::format(" {:.15e}{}", values[i], i % 6 == 5 || i + 1 == values.size() ? "\n" : "");
    return text;
  }
  template <class Entry>
  static std::string matrix(Entry entry) {
    std::string text;
    for (int i = 0; i < 6; ++i)
      text += wrapped({entry(i, 0), entry(i, 1), entry(i, 2), entry(i, 3), entry(i, 4), entry(i, 5)});
    return text;
  }
  template <class Entry>
  std::string matrices(const char* section, Entry entry) const {
    std::string text = fmt::format("{}\n", section);
    for (int i = 0; i < body.bodies; ++i)
      for (int j = 0; j < body.bodies; ++j)
        for (std::size_t k = 0; k < omega.size() && (i == j || has_coupling); ++k)
          text += fmt::format("  {}  {}  {} ", i + 1, j + 1, k + 1) +
                  matrix([&](int a, int b) { return entry(6 * i + a, 6 * j + b, omega[k]); });
    return text;
  }
  template <class Entry>
  std::string limit(const char* section, Entry entry) const {
    std::string text = fmt::format("{}\n", section);
    for (int i = 0; i < body.bodies; ++i)
      for (int j = 0; j < body.bodies; ++j)
        if (i == j || has_coupling)
          text += fmt::format("  {}  {} ", i + 1, j + 1) +
                  matrix([&](int a, int b) { return entry(6 * i + a, 6 * j + b); });
    return text;
  }
  std::string points(const char* section, double lift) const {
    std::string text = fmt::format("{}\n", section);
    for (std::size_t s = 0; s < cog.size(); ++s)
      text += fmt::format("  {}  {:.10g} {:.10g} {:.10g}\n", s + 1, cog[s].x(), cog[s].y(), cog[s].z() + lift);
    return text;
  }
  std::string general() const {
    std::string text = "* AQWA-LINE\n";
    if (is_recent) text += "* ... IF LHFR OPTION IS ON\n";
    for (int s = 0; s < body.bodies; ++s)
      text +=
          fmt::format("  {}  {}  {} ", s + 1, heading_deg.size(), omega.size()) + wrapped(heading_deg) + wrapped(omega);
    text += "GENERAL\n";
    for (int s = 0; s < body.bodies; ++s)
      text += (is_recent ? fmt::format("  {} ", s + 1) : std::string()) +
              fmt::format(" {:.10g} {:.10g} {:.10g} 0 0\n", water.depth.metres(), water.density, water.gravity);
    return text;
  }
  std::string radiation() const {
    std::string text = "HYDSTIFFNESS\n";
    for (int s = 0; s < body.bodies; ++s)
      text += fmt::format("  {} ", s + 1) + matrix([&](int a, int b) { return body.C(6 * s + a, 6 * s + b); });
    text += matrices("ADDEDMASS", [&](int i, int j, double w) { return body.A(i, j, w); }) +
            matrices("DAMPING", [&](int i, int j, double w) { return body.B(i, j, w); });
    if (has_limits)
      text += limit("ADDEDMASS_LF", [&](int i, int j) { return body.A_zero(i, j); }) +
              limit("DAMPING_LF", [](int, int) { return 0.0; }) +
              limit("ADDEDMASS_HF", [&](int i, int j) { return body.A_inf(i, j); });
    return text;
  }
  std::string forces() const {
    std::string text = "FIDD\n";
    for (int s = 0; s < body.bodies; ++s) text += fmt::format("  {} ", s + 1) + wrapped({0, 0, 0, 0, 0, 5});
    text += "FORCERAO\n";
    for (int s = 0; s < body.bodies; ++s)
      for (std::size_t h = 0; h < heading_deg.size(); ++h)
        for (std::size_t k = 0; k < omega.size(); ++k) {
          const double beta = hydro::Angle::from_degrees(heading_deg[h]).radians();
          const auto& g = cog[static_cast<std::size_t>(s)];
          const double way =
              hydro::waves::wavenumber(omega[k], water) * (g.x() * std::cos(beta) + g.y() * std::sin(beta));
          std::vector<double> amplitude, lag;
          for (int i = 0; i < 6; ++i) {
            // The load for a wave whose crest passes the centre of gravity at t = 0, and how late it is.
            const auto X = body.X(6 * s + i, omega[k], beta) * std::polar(1.0, way);
            amplitude.push_back(std::abs(X));
            lag.push_back(-std::arg(X) * 180 / std::numbers::pi);
          }
          text += fmt::format("  {}  {}  {} ", s + 1, h + 1, k + 1) + wrapped(amplitude) + wrapped(lag);
        }
    return text;
  }
  std::string all() const {
    std::string volumes = "DISPLACEMENT\n";
    for (int s = 0; s < body.bodies; ++s) volumes += fmt::format("  {}  {}\n", s + 1, 100 * (s + 1));
    return general() + points("COG", 0) + "DRAFT\n  1  3\n" + points("COB", 0.5) + volumes + radiation() + forces();
  }
  hydro::potential::Coefficients expected() const {
    std::vector<double> beta;
    for (const double degrees : heading_deg) beta.push_back(hydro::Angle::from_degrees(degrees).radians());
    return body.coefficients(water, omega, beta);
  }
};

}  // namespace froude_test
