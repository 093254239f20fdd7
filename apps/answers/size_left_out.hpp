#pragma once
/// \file  Private to apps: how large effects are that a linear response leaves out, by that response. (D144), (D145)
#include <optional>
#include <string>
#include <vector>

#include "answers/linear_response.hpp"
#include "compile/compile.hpp"
#include "compile/members.hpp"
#include "dynamics/force/contact.hpp"
#include "dynamics/frequency/drag_size.hpp"

namespace froude {

/// Quadratic drag beside the wave loads, and motions of bodies that may touch beside the gap between them.
class SizeLeftOut {
 public:
  /// All must live as long. `drag_is_kept`: it is linear in these responses.
  SizeLeftOut(const scene::Scene& scene, const compile::Prepared& prepared,
              const dynamics::frequency::SmallMotions& about, bool drag_is_kept);
  SizeLeftOut(const SizeLeftOut&) = delete;
  SizeLeftOut& operator=(const SizeLeftOut&) = delete;

  /// Takes responses into account; several times where frequencies come one after the other.
  void take(const Cells& cells, const dynamics::frequency::Amplitudes& found);

  /// One sentence for each effect: the height of waves, m, in which it counts.
  std::vector<std::string> told() const;

 private:
  /// Of one contact.
  struct Gap {
    std::string name;
    double at_rest;  ///< m
    dynamics::Variation variation;
    double amplitude = 0, omega = 0;  ///< the largest, m per metre of wave amplitude, and where it is, rad/s
  };

  std::string drag_told() const;
  std::string contacts_told() const;

  const dynamics::frequency::SmallMotions& about_;
  const std::vector<dynamics::frequency::PotentialGroup>& groups_;
  std::optional<compile::DragAtRest> at_rest_;  ///< where drag is left out
  std::optional<dynamics::frequency::DragLeftOut> drag_;
  std::vector<Gap> gaps_;
};

}  // namespace froude
