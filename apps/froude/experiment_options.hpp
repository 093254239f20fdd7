#pragma once
/// \file  The command line of `froude experiment`.
#include "froude/command_line.hpp"

namespace froude {

void add_experiment(CLI::App& app, Request& request);

}  // namespace froude
