#pragma once
/// \file  Private to apps: what sets the stiffness of connectors in a run, by any of its signals.
#include <memory>
#include <vector>

#include "compile/signal_list.hpp"
#include "froude/control.hpp"
#include "hydro/base/state_bytes.hpp"

namespace froude::compile {

/// Puts the controllers of the caller's in.
/// \throws hydro::InputError if no axial connector has the name or two controls have it, or they have a table or more
/// than one stiffness
void set_controllers(const std::vector<Control>& controls, Prepared& prepared);

/// What rules the connectors of one run. Of the signals it reads those that are watched, at the ends of steps.
class Controllers {
 public:
  /// `signals` are those of the model that has these rules. \throws hydro::InputError at what is watched and is none
  Controllers(const std::vector<Rule>& rules, const std::vector<Signal>& signals);
  ~Controllers();
  Controllers(Controllers&&) noexcept;
  /// Sets what the rules ask for at the end of a step. \returns true if something changed, so that loads have jumped.
  /// \throws hydro::InputError if a rule asks for what is no number, or for a signal that there is not
  bool decide(const Moment& now);
  /// True if keep_state() knows what all of them have seen; of those of the caller nobody does.
  bool can_be_kept() const;
  void keep_state(hydro::StateBytes& bytes);

  class Ruler;

 private:
  std::vector<std::unique_ptr<Ruler>> rules_;
};

}  // namespace froude::compile
