#include <cmath>
#include <numbers>
#include <sstream>

#include "answers/simulate.hpp"
#include "compile/compile.hpp"
#include "fit/decay_memory.hpp"
#include "harness/scenes.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation::sphere_decay {
namespace {

struct Curve {
  std::vector<double> time, heave;
};

/// Two columns of numbers after lines that begin with "#".
Curve read_curve(const std::filesystem::path& file) {
  std::istringstream in(hydro::io::read_text(file));
  Curve c;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream row(line);
    double t = 0, z = 0;
    if (row >> t >> z) {
      c.time.push_back(t);
      c.heave.push_back(z);
    }
  }
  return c;
}

double rms_difference(const Curve& reference, const std::vector<double>& time, const std::vector<double>& heave) {
  double sum = 0;
  int count = 0;
  std::size_t i = 1;
  for (std::size_t n = 0; n < reference.time.size(); ++n) {
    const double t = reference.time[n];
    if (t > time.back()) break;
    while (i + 1 < time.size() && time[i] < t) ++i;
    const double s = (t - time[i - 1]) / (time[i] - time[i - 1]), ours = (1 - s) * heave[i - 1] + s * heave[i];
    sum += (ours - reference.heave[n]) * (ours - reference.heave[n]);
    ++count;
  }
  return std::sqrt(sum / count);
}

std::vector<double> zero_crossings(const std::vector<double>& t, const std::vector<double>& z) {
  std::vector<double> out;
  for (std::size_t i = 1; i < z.size(); ++i)
    if ((z[i - 1] > 0) != (z[i] > 0)) out.push_back(t[i - 1] + (t[i] - t[i - 1]) * z[i - 1] / (z[i - 1] - z[i]));
  return out;
}

std::vector<double> extrema(const std::vector<double>& z) {
  std::vector<double> out;
  for (std::size_t i = 1; i + 1 < z.size(); ++i)
    if ((z[i] - z[i - 1]) * (z[i + 1] - z[i]) <= 0) out.push_back(z[i]);
  return out;
}

/// ω²(m + A33(ω)) = C33 by fixed-point iteration.
double natural_period(const scene::Scene& scene) {
  const compile::Prepared p = compile::prepare(scene);
  double omega = 1.4;
  for (int i = 0; i < 50; ++i)
    omega = std::sqrt(p.hydrostatics.front().stiffness(0, 0) /
                      (p.bodies.front().mass() + p.groups.front().table.added_mass(omega)(2, 2)));
  return 2 * std::numbers::pi / omega;
}

/// What another code's decay tells of the water, against the data that both were made with.
void add_fitted_memory(const scene::Scene& scene, const Curve& curve, std::vector<Number>& numbers) {
  const compile::Prepared p = compile::prepare(scene);
  const double mass = p.bodies.front().mass(), stiffness = p.hydrostatics.front().stiffness(0, 0);
  const auto& table = p.groups.front().table;
  const auto n = static_cast<Eigen::Index>(curve.heave.size());
  const std::vector<fit::Window> record{{(curve.time.back() - curve.time.front()) / static_cast<double>(n - 1),
                                         Eigen::Map<const Eigen::VectorXd>(curve.heave.data(), n)}};
  const auto f = fit::fit_decay_memory(record);
  const auto at = fit::radiation_of(f, {.mass = mass, .stiffness = stiffness}, f.omega);
  const auto plain =
      fit::added_mass(fit::fit_decay(record, {.terms = {.linear = true}}), {.mass = mass, .stiffness = stiffness});
  const auto value = [](const fit::Coefficient& c) { return c.value.value_or(std::nan("")); };
  const double damping = table.damping(f.omega)(2, 2), whole = mass + table.added_mass(f.omega)(2, 2);
  numbers.push_back(
      {"damping at the swing by a memory fitted to inwave_h, over the data's", value(at.damping) / damping, ""});
  numbers.push_back(
      {"mass and added mass at the swing by that memory, over the data's", (mass + value(at.added_mass)) / whole, ""});
  numbers.push_back({"damping by a constant damping fitted to inwave_h, over the data's",
                     value(plain.damping.front()) / damping, ""});
  numbers.push_back({"AICc gained by the memory", f.gain, ""});
}

double entry(const Run& r, const std::string& name) {
  for (const auto& [key, value] : r.energy)
    if (key == name) return value;
  return std::nan("");
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const scene::Scene scene = read_scene(folders, "iea_sphere/wamit/sphere.1");
  const Curve inwave = read_curve(folders.shared("iea_sphere/reference/decay_1m/inwave_h.txt"));
  const Curve hydrochrono = read_curve(folders.shared("iea_sphere/reference/decay_1m/hydrochrono.txt"));
  const Run record = simulate(scene);
  const auto& heave = record.signal("sphere.heave");
  const auto crossings = zero_crossings(record.time, heave);
  const auto peaks = extrema(heave);
  Outcome out;
  out.numbers = {{"period from added mass at its own frequency", natural_period(scene), "s"},
                 {"first zero crossing", crossings.at(0), "s"},
                 {"fifth zero crossing", crossings.at(4), "s"},
                 {"first trough", peaks.at(0), "m"},
                 {"fourth extremum", peaks.at(3), "m"},
                 {"rms to inwave_h over 40 s", rms_difference(inwave, record.time, heave), "m"},
                 {"rms to hydrochrono over 40 s", rms_difference(hydrochrono, record.time, heave), "m"},
                 {"energy residual relative to the turnover",
                  std::abs(entry(record, "residual")) / entry(record, "turnover"), ""}};
  add_fitted_memory(scene, inwave, out.numbers);
  plot::Figure f{.title = "Sphere released from 1 m",
                 .panels = {{.x = {"time", "s"}, .y = {"heave", "m"}, .series = {}}}};
  f.panels[0].series = {{.name = "Froude", .x = record.time, .y = heave},
                        {.name = "InWave (h)", .x = inwave.time, .y = inwave.heave, .dashed = true},
                        {.name = "HydroChrono", .x = hydrochrono.time, .y = hydrochrono.heave, .dashed = true}};
  out.pictures.push_back({"decay", "Heave decay of the sphere against two linear codes.", f, true});
  return out;
}

}  // namespace froude::validation::sphere_decay
