// froude-validate: the validation cases behind a command line. It names itself as people call it, `froude validate`.
#include <memory>

#include "froude/command_line.hpp"
#include "harness/validate.hpp"

namespace froude::validation {
namespace {

void describe(CLI::App& app, Request& request) {
  app.name("froude validate");
  app.description("compares with closed forms, experiments and other codes; status 1 if a limit is broken");
  app.footer(
      "Examples:\n  froude validate --list\n  froude validate sphere-decay --data ../shared/data\n"
      "Exit status: 0 done, 1 a limit is broken, 2 the input is wrong, 3 the numerics gave up, 4 a fault of froude.");
  add_common_flags(app, request);
  auto arguments = std::make_shared<ValidateArguments>();
  auto listed = std::make_shared<bool>(false);
  app.add_option("cases", arguments->names, "names of cases; default: all");
  auto* list_flag = app.add_flag("--list", *listed, "run nothing: tell the question of each case, and absent data");
  app.add_option("--folder", arguments->folder, "of the cases");
  app.add_option("--data", arguments->data, "folder of reference data; default: FROUDE_REFERENCE_DATA");
  app.add_option("--page", arguments->page, "write the table with pictures here (.md)")->excludes(list_flag);
  app.add_flag("--reference-curves", arguments->reference_curves, "also draw the pictures that show curves of others");
  app.callback([=, &request] {
    request.call = [=](const Console& console) -> int {
      if (!*listed) return validate(cases(), *arguments, console);
      list(cases(), *arguments, console);
      return done;
    };
  });
}

int main_program(int argc, char** argv) {
  Request request;
  CLI::App app;
  describe(app, request);
  return carry_out(app, request, argc, argv);
}

}  // namespace
}  // namespace froude::validation

int main(int argc, char** argv) { return froude::validation::main_program(argc, argv); }
