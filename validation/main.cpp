// froude-validate: the validation cases behind a command line. It names itself as people call it, `froude validate`.
#include "froude/validate_options.hpp"
#include "harness/validate.hpp"

namespace froude::validation {
namespace {

int main_program(int argc, char** argv) {
  Request request;
  CLI::App app;
  app.name("froude validate");
  add_common_flags(app, request);
  describe_validate(app, request, [](const ValidateArguments& arguments, const Console& console) -> int {
    if (!arguments.list) return validate(cases(), arguments, console);
    list(cases(), arguments, console);
    return done;
  });
  return carry_out(app, request, argc, argv);
}

}  // namespace
}  // namespace froude::validation

int main(int argc, char** argv) { return froude::validation::main_program(argc, argv); }
