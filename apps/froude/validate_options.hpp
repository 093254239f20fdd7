#pragma once
/// \file  The command line of `froude validate`: froude-validate answers it, and froude, which starts that, describes
/// it.
#include <functional>

#include "froude/command_line.hpp"
#include "froude/validate_arguments.hpp"

namespace froude {

/// `command` is a command of froude, or the whole of froude-validate. `call` returns the exit status.
void describe_validate(CLI::App& command, Request& request,
                       const std::function<int(const ValidateArguments&, const Console&)>& call);

}  // namespace froude
