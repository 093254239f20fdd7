#pragma once
/// \file  Private to apps: controllers of the caller's, put in a model.
#include "compile/compile.hpp"
#include "froude/control.hpp"

namespace froude::compile {

/// Puts the controllers in.
/// \throws hydro::InputError if no axial connector has the name or two controls have it, or they have a table or more
/// than one stiffness; in the run, if a controller asks for what is no number
void set_controllers(const std::vector<Control>& controls, Prepared& prepared);

}  // namespace froude::compile
