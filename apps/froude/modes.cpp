/// \file  `froude modes`: free motions about rest, with the added mass and damping of each motion's own frequency.
#include <algorithm>
#include <array>
#include <cmath>

#include "answers/answers.hpp"
#include "answers/picture.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

constexpr std::array<const char*, 6> motions{"surge", "sway", "heave", "roll", "pitch", "yaw"};

/// Of a number that is told to two decimals.
double without_sign_of_zero(double value) { return std::abs(value) < 0.005 ? 0 : value; }

Report report_of(const Modes& modes, std::size_t i) {
  std::array<double, 6> percent = modes.energy[i];
  for (double& share : percent) share *= 100;
  const std::optional<double> ratio = modes.damping_ratio(i), damped = modes.damped_period(i);
  const bool outside = modes.outside_data[i];
  Report out, shape;
  out.say("{:>4} {:>10.5g}{}{:>11.5g} {:>11} {:>10} {:>6.0f}  {}", i + 1, fact("period_s", modes.period(i)),
          fact("outside_data", outside, outside ? "*" : " "), fact("omega_rad_per_s", modes.omega[i]),
          fact("damped_period_s", damped, damped ? fmt::format("{:.5g}", *damped) : "none"),
          fact("damping_ratio", ratio, ratio ? fmt::format("{:.2f} %", without_sign_of_zero(100 * *ratio)) : "none"),
          fmt::join(percent, " "), largest_motions(modes.motions, modes.shape_of(i)));
  for (std::size_t m = 0; m < modes.motions.size(); ++m) shape.keep(modes.motions[m], modes.shape_of(i)[m]);
  return out.part("shape", shape);
}

Report report_of(const scene::Scene& scene, const Modes& modes, const Path& file) {
  Report out;
  out.say("{}: {} modes; share of the kinetic energy in %", scene.file.filename().string(), modes.count());
  out.say("{:>4} {:>10} {:>11} {:>11} {:>10}", "", "undamped", "", "damped", "");
  out.say("{:>4} {:>10} {:>11} {:>11} {:>10} {:>6}  largest, undamped", "mode", "period [s]", "omega", "period [s]",
          "damping", fmt::join(motions, " "));
  for (std::size_t i = 0; i < modes.count(); ++i) out.one_of("modes", report_of(modes, i));
  return out.sentences("notes", "note: {}", modes.notes).say("wrote {}", fact("file", file.string()));
}

void write_csv(const Path& path, const Modes& modes) {
  std::vector<std::vector<double>> numbers(4 + modes.motions.size());
  for (std::size_t i = 0; i < modes.count(); ++i) {
    numbers[0].push_back(modes.period(i));
    numbers[1].push_back(modes.omega[i]);
    numbers[2].push_back(modes.damped_period(i).value_or(std::nan("")));
    numbers[3].push_back(modes.damping_ratio(i).value_or(std::nan("")));
    for (std::size_t m = 0; m < modes.motions.size(); ++m) numbers[4 + m].push_back(modes.shape_of(i)[m]);
  }
  std::vector<hydro::io::CsvColumn> columns{{"period", "s", &numbers[0]},
                                            {"omega", "rad/s", &numbers[1]},
                                            {"damped period", "s", &numbers[2]},
                                            {"damping ratio", "", &numbers[3]}};
  for (std::size_t m = 0; m < modes.motions.size(); ++m)
    columns.push_back({modes.motions[m], m % 6 < 3 ? "m" : "rad", &numbers[4 + m]});
  hydro::io::write_csv(path, columns,
                       {"free motions about rest: period, omega and shapes about the centres of gravity are undamped"});
}

/// The first shapes, over the bodies: each in the motion that has most of its energy.
plot::Figure figure(const scene::Scene& scene, const Modes& modes) {
  const std::size_t bodies = modes.motions.size() / 6;
  constexpr std::size_t most = 6;
  plot::Figure f{.title = scene.title.empty() ? "Free motions" : scene.title, .panels = {}};
  for (std::size_t i = 0; i < std::min(most, modes.count()); ++i) {
    const auto& share = modes.energy[i];
    const auto main = static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
    plot::Series series{.name = "", .x = {}, .y = {}, .line = true, .marks = true};
    for (std::size_t b = 0; b < bodies; ++b) {
      series.x.push_back(static_cast<double>(b + 1));
      series.y.push_back(modes.shape_of(i)[6 * b + main]);
    }
    f.panels.push_back({.x = {.label = fmt::format("mode {}, {:.4g} s: body", i + 1, modes.period(i)),
                              .range = {{0.5, static_cast<double>(bodies) + 0.5}}},
                        .y = {.label = motions[main], .unit = main < 3 ? "m" : "rad", .range = {{-1.1, 1.1}}},
                        .series = {series}});
    f.panel_height = 180;
  }
  return f;
}

}  // namespace

void modes(const SceneArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.ask_modes.has_value(), scene, "modes", "modes = { longest = \"60 s\" }");
  const Path file = checked_output(arguments, ".modes.h5");
  const Modes found = free_modes(scene);
  found.write(file);
  if (arguments.csv) write_csv(*arguments.csv, found);
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(scene, found));
  tell(report_of(scene, found, file), console);
}

}  // namespace froude
