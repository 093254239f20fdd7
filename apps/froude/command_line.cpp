#include "froude/command_line.hpp"

#include <unistd.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <sstream>
#include <string_view>
#include <vector>

#include "froude/option.hpp"
#include "froude/signals.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

int tell(const hydro::InputError& error, bool json, int status) {
  std::cerr << error.what() << '\n';
  if (json) {
    const auto& where = error.where();
    const nlohmann::json document{{"error",
                                   {{"rule", error.rule()},
                                    {"file", where.file},
                                    {"line", where.line},
                                    {"column", where.column},
                                    {"text", where.text},
                                    {"remedy", error.remedy()}}}};
    std::cout << document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  }
  return status;
}

/// Results reach standard output only when all went well, so JSON readers never see half a document.
int called(const Request& request) {
  std::ostringstream json_text;
  std::ostream nowhere(nullptr);
  std::ostream& out = request.json ? json_text : request.quiet ? nowhere : std::cout;
  const Console console{out, std::cerr, request.json, isatty(STDERR_FILENO) != 0 && !request.quiet};
  const int status = request.call(console);
  std::cout << json_text.str() << std::flush;
  hydro::require(std::cout.good(), "cannot write to standard output; results are incomplete");
  return status;
}

/// What is wrong with the command line, told by the command it went wrong in.
hydro::InputError usage_error(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = app.get_name();
  const CLI::App* deepest = &app;
  for (auto chosen = app.get_subcommands(); !chosen.empty(); chosen = deepest->get_subcommands()) {
    deepest = chosen.front();
    command += " " + deepest->get_name();
  }
  const hydro::Place place{.file = "command line"};
  std::vector<std::string> known;
  for (const CLI::App* sub : deepest->get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(sub->get_name());
  const auto left = app.remaining(true);
  if (known.empty() || left.empty() || left.front().starts_with('-'))
    return hydro::InputError(error.what(), place, "see " + command + " --help");
  const std::string meant = hydro::nearest(left.front(), known);
  return hydro::InputError(
      fmt::format("{} has no command \"{}\"", command, left.front()), place,
      (meant.empty() ? "" : fmt::format("did you mean \"{}\"? ", meant)) + "see " + command + " --help");
}

}  // namespace

std::optional<double> parsed(const std::string& option, const std::string& text, const hydro::Dimension& needed) {
  if (text.empty()) return std::nullopt;
  return option_si(option, text, needed);
}

void add_common_flags(CLI::App& app, Request& request) {
  app.set_version_flag("--version", "froude " FROUDE_VERSION);
  app.add_flag("--json", request.json, "one JSON document on standard output");
  app.add_flag("--quiet", request.quiet, "no progress and no tables: files, errors and the exit status only");
}

int carry_out(const Request& request) {
  // A full disk under a size limit is then an ordinary error of write(), with a message, instead of a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return called(request);
  } catch (const CheckFailed& error) {
    return tell(error.told(), request.json, check_failed);
  } catch (const hydro::InputError& error) {
    return tell(error, request.json, input_wrong);
  } catch (const hydro::NumericsError& error) {
    return tell(hydro::InputError(std::string("the numerics gave up: ") + error.what()), request.json,
                numerics_gave_up);
  } catch (const EndedBySignal& ended) {
    return tell(hydro::InputError(ended.what()), request.json, ended_by_signal + ended.signal());
  } catch (const std::bad_alloc&) {
    return tell(hydro::InputError("out of memory; if the task is a small one, please report it"), request.json,
                our_fault);
  } catch (const std::exception& error) {
    return tell(hydro::InputError(fmt::format("a fault inside froude, please report it: {}", error.what())),
                request.json, our_fault);
  }
}

int carry_out(CLI::App& app, Request& request, int argc, char** argv) {
  std::vector<const char*> words(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {  // `help run` is `run --help`
    words.erase(words.begin() + 1);
    words.push_back("--help");
  }
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    const bool json = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
    return tell(usage_error(app, error), json, input_wrong);
  }
  return carry_out(request);
}

}  // namespace froude
