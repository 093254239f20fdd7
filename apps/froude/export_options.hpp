#pragma once
/// \file  The command line of `froude export`.
#include "froude/command_line.hpp"

namespace froude {

void add_export(CLI::App& app, Request& request);

}  // namespace froude
