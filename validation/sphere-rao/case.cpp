#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "answers/linear_response.hpp"
#include "harness/scenes.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation::sphere_rao {
namespace {

/// The waves of the comparison and the damper of each.
struct Wave {
  double omega, damper;  ///< rad/s, N s/m
};
constexpr std::array codes{"inwave", "inwave_hotint", "marin", "nrel", "proteusds"};

/// The numbers of a row of the table that the reference data's README has.
std::vector<double> row_of(const std::string& text, const std::string& head) {
  std::istringstream row(text.substr(text.find("| " + head + " |") + head.size() + 4));
  std::vector<double> out;
  double value = 0;
  for (char bar = '|'; bar == '|' && row >> value; row >> bar) out.push_back(value);
  return out;
}

std::vector<Wave> waves_of(const Folders& folders) {
  const std::string text = hydro::io::read_text(folders.shared("iea_sphere/README.md"));
  const std::vector<double> omega = row_of(text, "omega rad/s"), damper = row_of(text, "PTO damping N s/m");
  std::vector<Wave> out;
  for (std::size_t i = 0; i < std::min(omega.size(), damper.size()); ++i) out.push_back({omega[i], damper[i]});
  return out;
}

/// Heave over the amplitude of the waves by frequency, after lines that begin with "#".
double of_code(const std::string& text, double omega) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    double w = 0, heave = 0;
    if (line.front() != '#' && row >> w >> heave && std::abs(w - omega) < 1e-4) return heave;
  }
  return std::nan("");
}

double ours(const Folders& folders, const Wave& wave) {
  scene::Scene scene =
      read_scene(folders, "iea_sphere/wamit/sphere.1", "90080.857 N s/m", fmt::format("{} N s/m", wave.damper));
  scene.rao->omega = {wave.omega};
  return std::abs(respond(scene).signal("sphere.heave").values.front());
}

}  // namespace

Outcome outcome(const Folders& folders) {
  Outcome out;
  plot::Series found{.name = "Froude", .x = {}, .y = {}};
  std::vector<plot::Series> theirs;
  for (const char* code : codes) theirs.push_back({.name = code, .x = {}, .y = {}, .line = false, .marks = true});
  for (const Wave& wave : waves_of(folders)) {
    const double heave = ours(folders, wave);
    found.x.push_back(wave.omega), found.y.push_back(heave);
    double lowest = 1e9, highest = 0;
    for (std::size_t c = 0; c < codes.size(); ++c) {
      const double value =
          of_code(hydro::io::read_text(folders.shared(fmt::format("iea_sphere/reference/rao_S0.002/{}.txt", codes[c]))),
                  wave.omega);
      theirs[c].x.push_back(wave.omega), theirs[c].y.push_back(value);
      lowest = std::min(lowest, value), highest = std::max(highest, value);
    }
    out.numbers.push_back({fmt::format("{:.3f} rad/s: heave over the wave's amplitude", wave.omega), heave, ""});
    out.numbers.push_back({fmt::format("{:.3f} rad/s: beyond the codes, over their value", wave.omega),
                           std::max({0.0, heave / highest - 1, 1 - heave / lowest}), ""});
  }
  theirs.insert(theirs.begin(), found);
  out.pictures.push_back({"heave",
                          "Heave against a damper that is another at each frequency.",
                          {.title = "Floating sphere, waves of steepness 0.002",
                           .panels = {{.x = {"frequency", "rad/s"}, .y = {"heave", "m/m"}, .series = theirs}}},
                          true});
  return out;
}

}  // namespace froude::validation::sphere_rao
