// `froude modes`: free motions about rest, with the added mass and damping of each motion's own frequency.
#include "dynamics/frequency/modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "froude/linear_response.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

using dynamics::frequency::Mode;
using dynamics::frequency::ModeList;
using dynamics::frequency::SmallMotions;

constexpr std::array<const char*, 6> motions{"surge", "sway", "heave", "roll", "pitch", "yaw"};

double period(const Mode& mode) { return 2 * std::numbers::pi / mode.omega; }

/// Shares of kinetic energy of the six motions, all bodies together.
std::array<double, 6> shares(const Mode& mode, const SmallMotions& about) {
  std::array<double, 6> out{};
  const Eigen::VectorXd share = mode.energy_share(about);
  for (Eigen::Index m = 0; m < share.size(); ++m) out[static_cast<std::size_t>(m % 6)] += share[m];
  return out;
}

std::vector<Mode> wanted(const ModeList& all, const scene::AskModes& ask) {
  std::vector<Mode> out;
  for (const Mode& mode : all.modes)
    if (period(mode) >= ask.shortest && period(mode) <= ask.longest) out.push_back(mode);
  return out;
}

/// "m1.surge 1, m2.surge 0.81": the motions that matter in a shape.
std::string describe(const Eigen::VectorXd& shape, const dynamics::Model& model) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(shape.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return std::abs(shape[a]) > std::abs(shape[b]); });
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i)
    if (std::abs(shape[order[i]]) > 0.1)
      out += fmt::format("{}{} {:.2g}", out.empty() ? "" : ", ", model.mode_name(static_cast<int>(order[i])),
                         shape[order[i]]);
  return out;
}

std::vector<std::string> notes_of(const ModeList& all, const std::vector<Mode>& shown, const dynamics::Model& model,
                                  std::vector<std::string> notes) {
  for (const auto& shape : all.adrift) notes.push_back("nothing restores " + describe(shape, model));
  for (const auto& shape : all.toppling)
    notes.push_back("rest is no stable equilibrium: negative stiffness of " + describe(shape, model));
  if (!all.indefinite_at.empty())
    notes.push_back(
        fmt::format("mass and added mass are not positive definite from {:.4g} to {:.4g} rad/s, as near a resonance of "
                    "water between "
                    "bodies: modes about there are no swinging of the bodies alone",
                    all.indefinite_at.front(), all.indefinite_at.back()));
  if (std::any_of(shown.begin(), shown.end(), [](const Mode& m) { return !m.damped; }))
    notes.push_back(
        "damping \"none\": no swinging motion is like that mode; it creeps back, or radiation leaves nothing of it");
  if (all.modes.size() > shown.size())
    notes.push_back(fmt::format("{} of {} modes have the periods asked for", shown.size(), all.modes.size()));
  if (std::any_of(shown.begin(), shown.end(), [](const Mode& m) { return m.outside_data; }))
    notes.push_back("modes marked * lie outside the frequencies of the coefficients, whose nearest end was used");
  return notes;
}

Report report_of(const Mode& mode, std::size_t number, const SmallMotions& about) {
  std::array<double, 6> percent = shares(mode, about);
  for (double& share : percent) share *= 100;
  std::optional<double> ratio;
  if (mode.damped) ratio = mode.damped->damping_ratio();
  Report out, shape;
  out.say("{:>4} {:>10.5g}{}{:>11.5g} {:>10} {:>6.0f}  {}", number, fact("period_s", period(mode)),
          fact("outside_data", mode.outside_data, mode.outside_data ? "*" : " "), fact("omega_rad_per_s", mode.omega),
          fact("damping_ratio", ratio, ratio ? fmt::format("{:.2f} %", 100 * *ratio) : "none"), fmt::join(percent, " "),
          describe(mode.shape, about.model));
  for (int m = 0; m < about.model.modes(); ++m) shape.keep(about.model.mode_name(m), mode.shape[m]);
  return out.part("shape", shape);
}

Report report_of(const scene::Scene& scene, const SmallMotions& about, const std::vector<Mode>& modes,
                 const std::vector<std::string>& notes, const Path& file) {
  Report out;
  out.say("{}: {} modes; share of the kinetic energy in %", scene.file.filename().string(), modes.size());
  out.say("{:>4} {:>10} {:>11} {:>10} {:>6}  largest", "mode", "period [s]", "omega", "damping",
          fmt::join(motions, " "));
  for (std::size_t i = 0; i < modes.size(); ++i) out.one_of("modes", report_of(modes[i], i + 1, about));
  return out.sentences("notes", "note: {}", notes).say("wrote {}", fact("file", file.string()));
}

void write_csv(const Path& path, const std::vector<Mode>& modes, const dynamics::Model& model) {
  std::vector<std::vector<double>> numbers(3 + static_cast<std::size_t>(model.modes()));
  for (const Mode& mode : modes) {
    numbers[0].push_back(period(mode));
    numbers[1].push_back(mode.omega);
    numbers[2].push_back(mode.damped ? mode.damped->damping_ratio() : std::nan(""));
    for (int m = 0; m < model.modes(); ++m) numbers[3 + static_cast<std::size_t>(m)].push_back(mode.shape[m]);
  }
  std::vector<hydro::io::CsvColumn> columns{
      {"period", "s", &numbers[0]}, {"omega", "rad/s", &numbers[1]}, {"damping ratio", "", &numbers[2]}};
  for (int m = 0; m < model.modes(); ++m)
    columns.push_back({model.mode_name(m), m % 6 < 3 ? "m" : "rad", &numbers[3 + static_cast<std::size_t>(m)]});
  hydro::io::write_csv(path, columns, {"free motions about rest; shapes about the centres of gravity"});
}

/// The first shapes, over the bodies: each in the motion that has most of its energy.
plot::Figure figure(const scene::Scene& scene, const SmallMotions& about, const std::vector<Mode>& modes) {
  const std::size_t bodies = about.model.bodies().size();
  constexpr std::size_t most = 6;
  plot::Figure f{.title = scene.title.empty() ? "Free motions" : scene.title, .panels = {}};
  for (std::size_t i = 0; i < std::min(most, modes.size()); ++i) {
    const auto share = shares(modes[i], about);
    const auto main = std::max_element(share.begin(), share.end()) - share.begin();
    plot::Series series{.name = "", .x = {}, .y = {}, .line = true, .marks = true};
    for (std::size_t b = 0; b < bodies; ++b) {
      series.x.push_back(static_cast<double>(b + 1));
      series.y.push_back(modes[i].shape[6 * static_cast<Eigen::Index>(b) + main]);
    }
    f.panels.push_back({.x = {.label = fmt::format("mode {}, {:.4g} s: body", i + 1, period(modes[i])),
                              .range = {{0.5, static_cast<double>(bodies) + 0.5}}},
                        .y = {.label = motions[static_cast<std::size_t>(main)],
                              .unit = main < 3 ? "m" : "rad",
                              .range = {{-1.1, 1.1}}},
                        .series = {series}});
    f.panel_height = 180;
  }
  return f;
}

ModeTable table_of(const std::vector<Mode>& modes, const dynamics::Model& model) {
  ModeTable out;
  for (int m = 0; m < model.modes(); ++m) out.motions.push_back(model.mode_name(m));
  for (const Mode& mode : modes) {
    out.omega.push_back(mode.omega);
    const std::complex<double> none(std::nan(""), std::nan(""));
    out.s.push_back(mode.damped ? mode.damped->s : none);
    for (int m = 0; m < model.modes(); ++m) {
      out.shape.push_back(mode.shape[m]);
      out.damped_shape.push_back(mode.damped ? mode.damped->shape[m] : none);
    }
  }
  return out;
}

}  // namespace

void modes(const SceneArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.ask_modes.has_value(), scene, "modes", "modes = { longest = \"60 s\" }");
  const Path file = checked_output(arguments, ".modes.h5");
  compile::Prepared prepared = compile::prepare(scene);
  for (const std::string& effect : left_out_of_linear_responses(scene)) prepared.notes.push_back(effect);
  const dynamics::Model model = compile::frequency_model(prepared, scene.ask_modes->about);
  const SmallMotions about = compile::small_motions(model, scene.ask_modes->about, prepared.notes);
  const ModeList all = dynamics::frequency::free_motions(about, prepared.groups);
  compile::note_other_depths(scene, prepared, compile::used_by(all), prepared.notes);
  const std::vector<Mode> shown = wanted(all, *scene.ask_modes);
  if (shown.empty())
    throw hydro::InputError(fmt::format("none of the {} free motions has a period from {} to {} s", all.modes.size(),
                                        scene.ask_modes->shortest, scene.ask_modes->longest),
                            {.file = scene.file.string()}, "ask for a wider range, or name what restores the bodies");
  const auto notes = notes_of(all, shown, model, prepared.notes);
  write_modes(file, table_of(shown, model), provenance_of(scene, notes));
  if (arguments.csv) write_csv(*arguments.csv, shown, model);
  if (arguments.picture) hydro::io::write_atomically(*arguments.picture, plot::svg(figure(scene, about, shown)));
  tell(report_of(scene, about, shown, notes, file), console);
}

}  // namespace froude
