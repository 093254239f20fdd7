#pragma once
/// \file  The program `froude`, as main() calls it.

namespace froude {

/// Every command. \return the exit status
int run_program(int argc, char** argv);

}  // namespace froude
