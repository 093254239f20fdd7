#pragma once
/// \file  What the programs `froude` and `froude-validate` share: common flags, one style of telling errors, exit
/// status.
#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "froude/commands.hpp"
#include "hydro/base/units.hpp"

namespace froude {

enum ExitStatus : int { done = 0, check_failed = 1, input_wrong = 2, numerics_gave_up = 3, our_fault = 4 };

/// What the command line asked for; `call` runs it and returns the exit status.
struct Request {
  bool json = false, quiet = false;
  std::function<int(const Console&)> call;
};

/// A quantity of an option in SI; none where the option is left out. \throws hydro::InputError naming the option
std::optional<double> parsed(const std::string& option, const std::string& text, const hydro::Dimension& needed);

/// The command answers by that function, once everything is read.
template <class Arguments>
void calls(CLI::App& command, Request& request, const std::shared_ptr<Arguments>& arguments,
           void (*function)(const Arguments&, const Console&)) {
  command.callback([=, &request] {
    request.call = [=](const Console& console) {
      function(*arguments, console);
      return done;
    };
  });
}

/// Adds --version, --json and --quiet.
void add_common_flags(CLI::App& app, Request& request);

/// Runs the request. What it throws is told on standard error, with `json` also as an object on standard output.
/// \return the exit status
int carry_out(const Request& request);

/// Reads the command line, whose callbacks set `request.call`, and runs the request.
int carry_out(CLI::App& app, Request& request, int argc, char** argv);

}  // namespace froude
