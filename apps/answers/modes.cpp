#include "dynamics/frequency/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "answers/answers.hpp"
#include "answers/linear_response.hpp"
#include "answers/provenance.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

using dynamics::frequency::Mode;
using dynamics::frequency::ModeList;
using dynamics::frequency::SmallMotions;

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

std::vector<std::string> notes_of(const ModeList& all, const std::vector<Mode>& shown,
                                  const std::vector<std::string>& names, std::vector<std::string> notes) {
  const auto described = [&](const Eigen::VectorXd& shape) {
    return largest_motions(names, {shape.data(), static_cast<std::size_t>(shape.size())});
  };
  for (const auto& shape : all.adrift) notes.push_back("nothing restores " + described(shape));
  for (const auto& shape : all.toppling)
    notes.push_back("rest is no stable equilibrium: negative stiffness of " + described(shape));
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

/// Where no motion has a period that is asked for.
[[noreturn]] void refuse_none(const scene::Scene& scene, const ModeList& all, const SmallMotions& about) {
  const hydro::Place place{.file = scene.file.string()};
  if (scene.bodies.empty())
    throw hydro::InputError("modes are free motions of bodies, and the scene has none", place,
                            "add a [[body]]; what lines do by themselves a run tells");
  if (all.modes.empty()) {
    compile::require_stable(about, place, "name what restores that motion");
    throw hydro::InputError("nothing restores the bodies: none of their motions has a period", place,
                            "name what restores them, such as hydrostatics, moorings or connectors");
  }
  throw hydro::InputError(fmt::format("of {} free motions none has a period from {} to {} s", all.modes.size(),
                                      scene.ask_modes->shortest, scene.ask_modes->longest),
                          place, "ask for a wider range");
}

void add(const Mode& mode, const SmallMotions& about, Modes& out) {
  const std::complex<double> none(std::nan(""), std::nan(""));
  out.omega.push_back(mode.omega);
  out.s.push_back(mode.damped ? mode.damped->s : none);
  out.energy.push_back(shares(mode, about));
  out.outside_data.push_back(mode.outside_data);
  for (Eigen::Index m = 0; m < mode.shape.size(); ++m) {
    out.shape.push_back(mode.shape[m]);
    out.damped_shape.push_back(mode.damped ? mode.damped->shape[m] : none);
  }
}

}  // namespace

std::string largest_motions(const std::vector<std::string>& motions, std::span<const double> shape) {
  std::vector<std::size_t> order(shape.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return std::abs(shape[a]) > std::abs(shape[b]); });
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i)
    if (std::abs(shape[order[i]]) > 0.1)
      out += fmt::format("{}{} {:.2g}", out.empty() ? "" : ", ", motions[order[i]], shape[order[i]]);
  return out;
}

Modes free_modes(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept) {
  compile::Prepared prepared = compile::prepare(scene, kept);
  for (const std::string& effect : left_out_of_linear_responses(scene, prepared)) prepared.notes.push_back(effect);
  const dynamics::Model model = compile::frequency_model(prepared, scene.ask_modes->about);
  const SmallMotions about = compile::small_motions(scene, model, scene.ask_modes->about, prepared.notes);
  const ModeList all = dynamics::frequency::free_motions(about, prepared.groups);
  compile::note_other_depths(scene, prepared, compile::used_by(all), prepared.notes);
  const std::vector<Mode> shown = wanted(all, *scene.ask_modes);
  if (shown.empty()) refuse_none(scene, all, about);
  Modes out;
  for (int m = 0; m < model.modes(); ++m) out.motions.push_back(model.mode_name(m));
  for (const Mode& mode : shown) add(mode, about, out);
  out.notes = notes_of(all, shown, out.motions, prepared.notes);
  out.provenance = provenance_of(scene);
  return out;
}

}  // namespace froude
