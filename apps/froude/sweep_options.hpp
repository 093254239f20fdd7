#pragma once
/// \file  The command line of `froude sweep`, alone and as one rank of several (froude-ranks).
#include <functional>
#include <string>
#include <vector>

#include "froude/command_line.hpp"

namespace froude {

void add_sweep(CLI::App& app, Request& request, const std::function<int(const SweepArguments&, const Console&)>& call);

/// How many processes a launcher of parallel programs (mpirun, srun) has started, this one among them, as the
/// environment tells it; 1 without such a launcher.
int processes_started_together();

/// True if a sweep with these words is one that such processes share. With --part each is by itself.
bool is_shared_among_ranks(const std::vector<std::string>& arguments);

}  // namespace froude
