#pragma once
/// \file  The command lines of what draws signals against each other: `froude poincare`, `trajectory`, `snapshot`.
#include "froude/command_line.hpp"

namespace froude {

void add_poincare(CLI::App& app, Request& request);
void add_trajectory(CLI::App& app, Request& request);
void add_snapshot(CLI::App& app, Request& request);

}  // namespace froude
