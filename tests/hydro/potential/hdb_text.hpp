#pragma once
/// \file  A plain writer of .hdb files for tests.
#include <fmt/format.h>

#include <numbers>

#include "smooth_body.hpp"

namespace froude_test {

/// A body of formulas, written as Hydrostar's and AQUA+'s .hdb are.
struct HdbText {
  SmoothBody body = {};
  std::vector<double> period{4, 8, 16}, heading_deg{0, 90};
  int structures = 1;
  double speed = 0, apart = 20;
  bool is_coupled = true;

  std::string rows(auto value) const {
    std::string text;
    for (const double T : period) {
      text += fmt::format("{:7.2f}", T);
      for (int i = 0; i < 6; ++i) text += fmt::format(" {:.17g}", value(i, 2 * std::numbers::pi / T));
      text += '\n';
    }
    return text;
  }
  std::string text() const {
    std::string out = fmt::format("[SOFT] X\n[FORWARD_SPEED] {}\n[PERIODS_NUMBER] {}\n[HEADINGS_NUMBER] {}\n", speed,
                                  period.size(), heading_deg.size());
    out += "[List_calculated_periods]\n";
    for (const double T : period) out += fmt::format("{:.3f}\n", T);
    out += "[List_calculated_headings]\n";
    for (const double beta : heading_deg) out += fmt::format("{:.3f}\n", beta);
    out += fmt::format("[STRUCTURES_NUMBER] {}\n", structures);
    for (int b = 0; b < body.bodies; ++b) out += structure(b);
    if (is_coupled)
      for (int by = 0; by < body.bodies; ++by)
        for (int on = 0; on < body.bodies; ++on)
          if (on != by)
            out += fmt::format(
                       "[HYDRODYNAMIC_COUPLING_BETWEEN_STRUCTURES] buoy {}\n[ON] buoy {}\n"
                       "[Coupled_Added_mass_Radiation_Damping]\n",
                       by + 1, on + 1) +
                   radiation(on, by);
    return out;
  }
  std::string radiation(int on, int by) const {
    std::string out;
    for (int i = 0; i < 6; ++i)
      out += fmt::format("[ADDED_MASS_LINE_{}]\n", i + 1) +
             rows([&](int j, double w) { return body.A(6 * on + i, 6 * by + j, w); });
    for (int i = 0; i < 6; ++i)
      out += fmt::format("[DAMPING_TERM_{}]\n", i + 1) +
             rows([&](int j, double w) { return body.B(6 * on + i, 6 * by + j, w); });
    return out;
  }
  std::string structure(int b) const {
    std::string out = fmt::format(
        "[STRUCTURE_{:02}] buoy {}\n[UNDERWATER_VOLUME] {}\n[CENTER_OF_BUOYANCY] 0 0 -2\n"
        "[CENTER_OF_GRAVITY] {} 2 -1\n[Hydrostatic_matrix]\n",
        b + 1, b + 1, 12 + b, 1 + apart * b);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) out += fmt::format(" {:.17g}", body.C(6 * b + i, 6 * b + j));
      out += '\n';
    }
    out += "[EXCITATION_FORCES_AND_MOMENTS]\n";
    for (const bool is_phase : {false, true})
      for (std::size_t h = 0; h < heading_deg.size(); ++h) {
        out += fmt::format("[INCIDENCE_EFM_{}_{:03}] {:.3f}\n", is_phase ? "PH" : "MOD", h + 1, heading_deg[h]);
        out += rows([&](int i, double w) {
          const auto X = body.X(6 * b + i, w, heading_deg[h] * std::numbers::pi / 180);
          return is_phase ? -std::arg(X) - std::numbers::pi / 2 : std::abs(X);
        });
      }
    return out + radiation(b, b);
  }
};

}  // namespace froude_test
