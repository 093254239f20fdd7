#include "answers/size_left_out.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace froude {

using dynamics::frequency::SmallMotions;

namespace {

constexpr double told_share = 0.1;       // an effect counts from a tenth on
constexpr std::size_t most_joints = 50;  // twelve right-hand sides each, at every frequency

}  // namespace

std::optional<double> own_wave_height(const scene::Scene& scene) {
  if (!scene.waves) return std::nullopt;
  if (const auto* regular = std::get_if<scene::RegularWave>(&scene.waves->kind)) return 2 * regular->amplitude;
  const auto* random = std::get_if<scene::RandomSea>(&scene.waves->kind);
  if (random == nullptr || (random->crest && random->crest->alone)) return std::nullopt;
  double squares = 0;
  for (const scene::WaveSystem& system : random->systems) squares += std::pow(system.spectrum->hs(), 2);
  return std::sqrt(squares);
}

SizeLeftOut::SizeLeftOut(const scene::Scene& scene, const compile::Prepared& prepared, const SmallMotions& about,
                         bool drag_is_kept)
    : about_(about), groups_(prepared.groups), water_(prepared.water), height_(own_wave_height(scene)) {
  find_members(scene, prepared, drag_is_kept);
  find_joints(prepared);
  find_gaps(prepared);
  if (height_ && *height_ > 0) departure_.emplace(about, *height_ / 2);
}

void SizeLeftOut::find_members(const scene::Scene& scene, const compile::Prepared& prepared, bool drag_is_kept) {
  impacts_ = std::any_of(scene.members.begin(), scene.members.end(),
                         [](const scene::Member& m) { return m.slamming.has_value(); });
  if (drag_is_kept) return;
  compile::DragAtRest left_out = compile::drag_of_responses(scene, prepared.bodies);
  dragged_ = std::move(left_out.pieces);
  if (!dragged_.empty()) drag_.emplace(about_, dragged_, scene.water);
}

void SizeLeftOut::find_joints(const compile::Prepared& prepared) {
  for (const dynamics::Friction& f : prepared.friction)
    if (f.hold)
      latches_ = true;
    else
      rubbing_.push_back(f);
  if (!rubbing_.empty() && rubbing_.size() <= most_joints) friction_.emplace(about_, groups_, rubbing_);
}

void SizeLeftOut::find_gaps(const compile::Prepared& prepared) {
  if (prepared.contacts.empty()) return;
  const dynamics::ContactKind contacts(prepared.contacts);
  const dynamics::Still still(about_.still, about_.linear.multipliers);
  for (const dynamics::Signal& signal : contacts.signals())
    for (std::size_t i = 0; i < contacts.elements(); ++i)
      if (signal.name == contacts.element(i).name + ".gap")
        gaps_.push_back({contacts.element(i).name, contacts.gap(i, about_.still), signal.variation(still)});
}

/// Above Miche's limit, 0.142 λ tanh kh with tanh kh = ω²/(gk).
bool SizeLeftOut::own_waves_break(double omega) const {
  const double k = hydro::waves::wavenumber(omega, water_);
  return *height_ > 0.142 * 2 * std::numbers::pi / k * omega * omega / (water_.gravity * k);
}

/// So far from rest a load may have no value: then no size is told, and why.
void SizeLeftOut::take_departure(double omega, const Eigen::VectorXcd& xi, const Eigen::VectorXcd& X) {
  if (!departure_ || own_waves_break(omega)) return;
  try {
    departure_->take(omega, xi, X);
  } catch (const hydro::InputError& e) {
    no_departure_ = e.rule();
  } catch (const hydro::NumericsError& e) {
    no_departure_ = e.what();
  }
  if (!no_departure_.empty()) departure_.reset();
}

/// What stands beside the wave loads.
void SizeLeftOut::take_loads(double omega, double heading, const Eigen::VectorXcd& xi) {
  if (!drag_ && !departure_) return;
  const Eigen::VectorXcd X = excitation(about_, groups_, omega, heading);
  if (drag_) drag_->take(omega, heading, xi, X);
  take_departure(omega, xi, X);
}

void SizeLeftOut::take(const Cells& cells, const dynamics::frequency::Amplitudes& found) {
  for (std::size_t w = 0; w < cells.omega.size(); ++w) {
    const double omega = cells.omega[w];
    const auto column = static_cast<Eigen::Index>(w);
    std::vector<Eigen::VectorXcd> motions;
    for (std::size_t h = 0; h < cells.headings.size(); ++h) {
      const double heading = cells.headings[h];
      const Eigen::VectorXcd& xi = motions.emplace_back(found.xi[h].col(column));
      take_loads(omega, heading, xi);
      for (Gap& gap : gaps_) {
        const double amplitude =
            std::abs(dynamics::amplitude(gap.variation, xi, found.lambda[h].col(column), omega, heading));
        if (amplitude > gap.amplitude) gap.amplitude = amplitude, gap.omega = omega;
      }
    }
    if (friction_) friction_->take(omega, motions);
  }
}

template <class Tell>
std::string SizeLeftOut::in_own_waves(Tell tell) const {
  if (!height_) return {};
  return fmt::format("; in waves as high as those of the scene, {:.3g} m, {}", *height_, tell(*height_ / 2));
}

std::string SizeLeftOut::drag_told() const {
  const auto largest = drag_->largest();
  if (!largest) return "how large the drag left out is cannot be told: waves move nothing that drags";
  return fmt::format(
             "the drag left out reaches a tenth of the largest wave load on {} in waves of {:.3g} m height at {:.4g} "
             "rad/s, by relative velocities of responses without drag, and grows with the height",
             about_.model.mode_name(largest->mode), 2 * told_share / largest->per_metre, largest->omega) +
         in_own_waves([&](double a) { return fmt::format("it is {:.3g} of that load", a * largest->per_metre); });
}

std::string SizeLeftOut::contacts_told() const {
  const auto closed = std::find_if(gaps_.begin(), gaps_.end(), [](const Gap& gap) { return gap.at_rest <= 0; });
  if (closed != gaps_.end())
    return fmt::format("\"{}\" is closed at rest: no wave is so low that contacts may be left out", closed->name);
  const auto share = [](const Gap& gap) { return gap.amplitude / gap.at_rest; };  // of the gap, per metre
  const auto first =
      std::max_element(gaps_.begin(), gaps_.end(), [&](const Gap& a, const Gap& b) { return share(a) < share(b); });
  if (first->amplitude == 0) return "waves do not move what may touch";
  return fmt::format(
             "bodies touch in waves of {:.3g} m height and more, first at \"{}\", whose gap is {:.4g} m at rest and "
             "moves "
             "most "
             "at {:.4g} rad/s",
             2 / share(*first), first->name, first->at_rest, first->omega) +
         in_own_waves([&](double a) { return fmt::format("{:.3g} of that gap is taken up", a * share(*first)); });
}

std::string SizeLeftOut::friction_told() const {
  if (!friction_)
    return fmt::format("how large friction is cannot be told of more than {} joints, and {} have it", most_joints,
                       rubbing_.size());
  const auto largest = friction_->largest();
  if (!largest) return "waves do not load the joints that have friction, which stick";
  const dynamics::Friction& joint = rubbing_[largest->element];
  const double sticks = largest->sticks_below(joint), tenth = largest->is_share_from(joint, told_share);
  return fmt::format(
             "joint \"{}\" sticks in waves of up to {:.3g} m height, by the load that would hold it at {:.4g} rad/s "
             "while other joints move freely, and in waves of {:.3g} m height and more its friction is less than a "
             "tenth of that load",
             joint.name, 2 * sticks, largest->omega, 2 * std::max(sticks, tenth)) +
         in_own_waves([&](double a) {
           return a <= sticks ? std::string("it sticks")
                              : fmt::format("its friction is {:.3g} of that load", told_share * tenth / a);
         });
}

std::string SizeLeftOut::departure_told() const {
  if (!no_departure_.empty())
    return fmt::format(
        "how far loads depart from their linear part cannot be told in waves as high as those of the "
        "scene, {:.3g} m: {}",
        *height_, no_departure_);
  constexpr double worth_telling = 0.01;
  const auto largest = departure_ ? departure_->largest() : std::nullopt;
  if (!largest || largest->share < worth_telling) return {};
  return fmt::format(
      "loads of {} depart from their linear part by {:.3g} of the largest wave load on {} at {:.4g} rad/s, where that "
      "moves by {:.3g} {}, in waves as high as those of the scene, {:.3g} m",
      largest->effect, largest->share, about_.model.mode_name(largest->mode), largest->omega, largest->motion,
      largest->mode % 6 < 3 ? "m" : "rad", *height_);
}

std::vector<std::string> SizeLeftOut::told() const {
  std::vector<std::string> out;
  if (!dragged_.empty()) out.push_back(drag_told());
  if (impacts_) out.emplace_back("how large impacts are no height tells: they are of members that meet the water");
  if (!rubbing_.empty()) out.push_back(friction_told());
  if (latches_) out.emplace_back("how large latches are no height tells: they hold whatever the load");
  if (!gaps_.empty()) out.push_back(contacts_told());
  if (std::string told = departure_told(); !told.empty()) out.push_back(std::move(told));
  return out;
}

}  // namespace froude
