#include "answers/size_left_out.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace froude {

using dynamics::frequency::SmallMotions;

SizeLeftOut::SizeLeftOut(const scene::Scene& scene, const compile::Prepared& prepared, const SmallMotions& about,
                         bool drag_is_kept)
    : about_(about), groups_(prepared.groups) {
  if (!drag_is_kept && compile::any_drag_at_rest(scene)) {
    at_rest_ = compile::drag_at_rest(scene, prepared.bodies);
    if (!at_rest_->in_current()) drag_.emplace(about, at_rest_->pieces, scene.water);
  }
  if (prepared.contacts.empty()) return;
  const dynamics::ContactKind contacts(prepared.contacts);
  const dynamics::Still still(about.still, about.linear.multipliers);
  for (const dynamics::Signal& signal : contacts.signals())
    for (std::size_t i = 0; i < contacts.elements(); ++i)
      if (signal.name == contacts.element(i).name + ".gap")
        gaps_.push_back({contacts.element(i).name, contacts.gap(i, about.still), signal.variation(still)});
}

void SizeLeftOut::take(const Cells& cells, const dynamics::frequency::Amplitudes& found) {
  for (std::size_t h = 0; h < cells.headings.size(); ++h)
    for (std::size_t w = 0; w < cells.omega.size(); ++w) {
      const double omega = cells.omega[w], heading = cells.headings[h];
      const auto column = static_cast<Eigen::Index>(w);
      if (drag_)
        drag_->take(omega, heading, found.xi[h].col(column), excitation(about_.model, groups_, omega, heading));
      for (Gap& gap : gaps_) {
        const double amplitude = std::abs(
            dynamics::amplitude(gap.variation, found.xi[h].col(column), found.lambda[h].col(column), omega, heading));
        if (amplitude > gap.amplitude) gap.amplitude = amplitude, gap.omega = omega;
      }
    }
}

std::string SizeLeftOut::drag_told() const {
  if (!drag_) return "how large the drag left out is cannot be told: a current flows past a member";
  const auto largest = drag_->largest();
  if (!largest) return "how large the drag left out is cannot be told: waves move nothing that drags";
  constexpr double share = 0.1;
  return fmt::format(
      "the drag left out reaches a tenth of the largest wave load on {} in waves of {:.3g} m height at {:.4g} rad/s, "
      "by relative velocities of responses without drag, and grows with the height",
      about_.model.mode_name(largest->mode), 2 * share / largest->per_metre, largest->omega);
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
      "bodies touch in waves of {:.3g} m height and more, first at \"{}\", whose gap is {:.4g} m at rest and moves "
      "most "
      "at {:.4g} rad/s",
      2 / share(*first), first->name, first->at_rest, first->omega);
}

std::vector<std::string> SizeLeftOut::told() const {
  std::vector<std::string> out;
  if (at_rest_) out.push_back(drag_told());
  if (!gaps_.empty()) out.push_back(contacts_told());
  return out;
}

}  // namespace froude
