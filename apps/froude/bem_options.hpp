#pragma once
/// \file  The command line of `froude bem`.
#include "froude/command_line.hpp"

namespace froude {

void add_bem(CLI::App& app, Request& request);

}  // namespace froude
