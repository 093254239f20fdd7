#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "compile/signal_list.hpp"
#include "harness/scenes.hpp"
#include "hydro/signal/harmonics.hpp"

namespace froude::validation::rm3_regular {
namespace {

constexpr double amplitude = 1.25, omega = 2 * std::numbers::pi / 8;  // m, rad/s

struct Pair {
  double of_float, of_spar;  // m
};

Pair frequency_domain(const scene::Scene& scene) {
  const compile::Prepared p = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(p);
  const Eigen::MatrixXcd xi = dynamics::frequency::response_amplitudes(model, p.groups, {omega}, 0);
  return {amplitude * std::abs(xi(2, 0)), amplitude * std::abs(xi(8, 0))};
}

/// Amplitude of the last ten periods.
double steady_amplitude(const Run& r, const std::string& name) {
  const auto& all = r.signal(name);
  std::vector<double> t, z;
  for (std::size_t i = 0; i < r.time.size(); ++i)
    if (r.time[i] >= 200) {
      t.push_back(r.time[i]);
      z.push_back(all[i]);
    }
  const double omegas[] = {omega};
  return std::abs(hydro::signal::fit_harmonics(t, z, omegas).amplitude.at(0));
}

}  // namespace

Outcome outcome(const Folders& folders) {
  Outcome out;
  for (const bool full : {false, true}) {
    const scene::Scene scene = read_scene(folders, "rm3/wamit/rm3.1", "interaction = \"self\"",
                                          full ? "interaction = \"full\"" : "interaction = \"self\"");
    const std::string which = full ? "full interaction" : "no interaction";
    const Pair f = frequency_domain(scene);
    const Run run = simulate(scene);
    out.numbers.push_back({"float, frequency domain, " + which, f.of_float, "m"});
    out.numbers.push_back({"spar, frequency domain, " + which, f.of_spar, "m"});
    out.numbers.push_back({"float, run, " + which, steady_amplitude(run, "float.heave"), "m"});
    out.numbers.push_back({"spar, run, " + which, steady_amplitude(run, "spar.heave"), "m"});
    plot::Figure picture{.title = "RM3, H = 2.5 m, T = 8 s, " + which,
                         .panels = {{.x = {"time", "s"}, .y = {"heave", "m"}, .series = {}}}};
    for (const char* body : {"float", "spar"})
      picture.panels[0].series.push_back({.name = body, .x = run.time, .y = run.signal(std::string(body) + ".heave")});
    out.pictures.push_back(
        {full ? "full-interaction" : "no-interaction", "Heave of float and spar, " + which + ".", picture});
  }
  return out;
}

}  // namespace froude::validation::rm3_regular
