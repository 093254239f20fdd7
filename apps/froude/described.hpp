#pragma once
/// \file  What shells and readers are told of the command line. Its one source are the commands and options of CLI11,
///        of which `--help` is made too.
#include <string>

#include "froude/command_line.hpp"

namespace froude {

/// A script by which a shell completes commands, options and values. `shell`: "bash" or "zsh".
std::string completion(const CLI::App& app, const std::string& shell);

/// The manual page of section 1, in roff: every command with its options and examples.
std::string manual_page(const CLI::App& app);

/// The commands `completion` and `man`, which tell of all commands of `app`.
void add_described(CLI::App& app, Request& request);

}  // namespace froude
