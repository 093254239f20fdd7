#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "compile/compile.hpp"
#include "harness/scenes.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation::fpso_rao {
namespace {

using Response = Eigen::Matrix<std::complex<double>, 6, 1>;

/// WAMIT's own motions, by period and heading in degrees. Columns: PER BETA I Mod Pha Re Im.
std::map<std::pair<double, double>, Response> read_motions(const std::filesystem::path& file) {
  std::istringstream in(hydro::io::read_text(file));
  std::map<std::pair<double, double>, Response> out;
  double period = 0, heading = 0, modulus = 0, phase = 0, re = 0, im = 0;
  int mode = 0;
  while (in >> period >> heading >> mode >> modulus >> phase >> re >> im) out[{period, heading}][mode - 1] = {re, im};
  return out;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const scene::Scene scene = read_scene(folders, "mss_fpso/fpso.1");
  const auto motions = read_motions(folders.shared("mss_fpso/fpso.4"));
  const compile::Prepared p = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(p);
  // Motions of the hull's origin at the waterline, 1 m above the centre of gravity.
  const dynamics::Matrix6 to_origin = dynamics::shift_from_centre(-p.bodies.front().properties().centre_of_gravity.xyz);
  Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero(), largest = error;
  plot::Series ours{.name = "Froude", .x = {}, .y = {}},
      theirs{.name = "WAMIT", .x = {}, .y = {}, .line = false, .marks = true};
  for (const auto& [at, reference] : motions) {
    const auto [period, heading] = at;
    if (period <= 5 || period >= 25) continue;
    const Response found = to_origin.cast<std::complex<double>>() *
                           dynamics::frequency::response_amplitudes(model, p.groups, {2 * std::numbers::pi / period},
                                                                    heading * std::numbers::pi / 180)
                               .col(0);
    error = error.cwiseMax((found - reference).cwiseAbs());
    largest = largest.cwiseMax(reference.cwiseAbs());
    if (heading == 90) {
      ours.x.push_back(period);
      ours.y.push_back(std::abs(found[2]));
      theirs.x.push_back(period);
      theirs.y.push_back(std::abs(reference[2]));
    }
  }
  Outcome out;
  for (int mode = 0; mode < 6; ++mode)
    out.numbers.push_back(
        {std::string(hydro::mode_names[static_cast<std::size_t>(mode)]) + ", largest error of the peak",
         error[mode] / largest[mode], ""});
  plot::Figure f{.title = "FPSO in beam waves",
                 .panels = {{.x = {"wave period", "s"}, .y = {"heave", "m/m"}, .series = {ours, theirs}}}};
  out.pictures.push_back({"heave", "Heave in beam waves against the panel code's own motions.", f, true});
  return out;
}

}  // namespace froude::validation::fpso_rao
