#include <cmath>
#include <sstream>

#include "answers/simulate.hpp"
#include "harness/scenes.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation::rm3_decay {
namespace {

struct Curves {
  std::vector<double> time, of_float, of_spar;  // s, m from rest
};

/// A line of words, then time and the heights of both centres of gravity, which rest at −0.72 and −21.29 m.
Curves read_curves(const std::filesystem::path& file) {
  std::istringstream in(hydro::io::read_text(file));
  std::string header;
  std::getline(in, header);
  Curves c;
  for (double t = 0, a = 0, b = 0; in >> t >> a >> b;) {
    c.time.push_back(t);
    c.of_float.push_back(a + 0.72);
    c.of_spar.push_back(b + 21.29);
  }
  return c;
}

/// Both are sampled every 0.06 s.
double rms(const std::vector<double>& reference, const std::vector<double>& ours) {
  double sum = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) sum += std::pow(ours[i] - reference[i], 2);
  return std::sqrt(sum / static_cast<double>(ours.size()));
}

double entry(const Run& r, const std::string& name) {
  for (const auto& [key, value] : r.energy)
    if (key == name) return value;
  return std::nan("");
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const Curves reference = read_curves(folders.shared("rm3/reference/wecsim_decay.txt"));
  Outcome out;
  plot::Figure picture{.title = "RM3, float let go from 0.1 m",
                       .panels = {{.x = {"time", "s"}, .y = {"heave of the float", "m"}, .series = {}}}};
  for (const std::string method : {"direct", "partitioned", "poles"}) {
    const Run run =
        simulate(read_scene(folders, "rm3/wamit/rm3.1", "method = \"direct\"", "method = \"" + method + "\""));
    out.numbers.push_back(
        {"float, rms to WEC-Sim over 100 s, " + method, rms(reference.of_float, run.signal("float.heave")), "m"});
    out.numbers.push_back(
        {"spar, rms to WEC-Sim over 100 s, " + method, rms(reference.of_spar, run.signal("spar.heave")), "m"});
    out.numbers.push_back({"energy residual relative to the turnover, " + method,
                           std::abs(entry(run, "residual")) / entry(run, "turnover"), ""});
    picture.panels[0].series.push_back({.name = method, .x = run.time, .y = run.signal("float.heave")});
  }
  const std::size_t shown = 1668;
  picture.panels[0].series.push_back({.name = "WEC-Sim",
                                      .x = {reference.time.begin(), reference.time.begin() + shown},
                                      .y = {reference.of_float.begin(), reference.of_float.begin() + shown},
                                      .dashed = true});
  out.pictures.push_back({"decay", "Heave of the float by every method against another code.", picture, true});
  return out;
}

}  // namespace froude::validation::rm3_decay
