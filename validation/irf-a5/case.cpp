#include <cmath>
#include <sstream>

#include "harness/case.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/radiation/kernel.hpp"

namespace froude::validation::irf_a5 {
namespace {

struct Curve {
  std::vector<double> t, L;
};

/// Rows t, i, j, from added mass, from damping; of mode (3, 3).
Curve read_step_response(const std::filesystem::path& file) {
  std::istringstream in(hydro::io::read_text(file));
  Curve c;
  double t = 0, from_added_mass = 0, from_damping = 0;
  int i = 0, j = 0;
  while (in >> t >> i >> j >> from_added_mass >> from_damping)
    if (i == 3 && j == 3) {
      c.t.push_back(t);
      c.L.push_back(from_damping);
    }
  return c;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const hydro::potential::ReadOptions options{
      .density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::infinite(), .iperout = {}};
  const auto c = hydro::potential::read(folders.shared("irf_buoy_a5/BuoyA5.1"), options);
  const Curve reference = read_step_response(folders.shared("irf_buoy_a5/BuoyA5_IR.1"));
  const hydro::radiation::DampingTable damping{c.omega, c.B};
  const double rho = c.water.density;
  // L = ∫K by Simpson's rule over half steps of the reference's own grid.
  Curve ours{{0.0}, {0.0}};
  double worst = 0, largest = 0, at_one = 0, before = hydro::radiation::retardation(damping, 0)(2, 2) / rho;
  const double K0 = before;
  for (std::size_t n = 1; n < reference.t.size(); ++n) {
    const double t0 = reference.t[n - 1], t1 = reference.t[n];
    const double middle = hydro::radiation::retardation(damping, (t0 + t1) / 2)(2, 2) / rho,
                 after = hydro::radiation::retardation(damping, t1)(2, 2) / rho;
    ours.t.push_back(t1);
    ours.L.push_back(ours.L.back() + (t1 - t0) / 6 * (before + 4 * middle + after));
    before = after;
    worst = std::max(worst, std::abs(ours.L.back() - reference.L[n]));
    largest = std::max(largest, std::abs(reference.L[n]));
    if (std::abs(t1 - 1) < 1e-9) at_one = ours.L.back();
  }
  const auto found = hydro::radiation::infinite_added_mass(damping, c.A);
  Outcome out;
  out.numbers = {{"L33 at 1 s", at_one, "m^3"},
                 {"largest error of L33 over 10 s, of its largest value", worst / largest, ""},
                 {"K33 at 0 s", K0, "m^3/s"},
                 {"added mass at infinite frequency by Ogilvie's relation", found.value(2, 2) / rho, "m^3"}};
  plot::Figure f{.title = "Buoy, heave", .panels = {{.x = {"time", "s"}, .y = {"L33 / density", "m^3"}, .series = {}}}};
  f.panels[0].series = {{.name = "Froude", .x = ours.t, .y = ours.L},
                        {.name = "F2T", .x = reference.t, .y = reference.L, .dashed = true}};
  out.pictures.push_back({"step-response", "Integral of the retardation function in heave against F2T.", f, true});
  return out;
}

}  // namespace froude::validation::irf_a5
