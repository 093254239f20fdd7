#include "froude/validate_options.hpp"

#include <memory>

namespace froude {

void describe_validate(CLI::App& command, Request& request,
                       const std::function<int(const ValidateArguments&, const Console&)>& call) {
  command.description("compares with closed forms, experiments and other codes; status 1 if a limit is broken");
  command.footer(
      "Examples:\n  froude validate --list\n  froude validate sphere-decay --data ../shared/data\n"
      "Exit status: 0 done, 1 a limit is broken, 2 the input is wrong, 3 the numerics gave up, 4 a fault of froude.");
  auto arguments = std::make_shared<ValidateArguments>();
  command.add_option("cases", arguments->names, "names of cases; default: all");
  auto* list =
      command.add_flag("--list", arguments->list, "run nothing: tell the question of each case, and absent data");
  command.add_option("--folder", arguments->folder, "of the cases");
  command.add_option("--data", arguments->data, "folder of reference data; default: FROUDE_REFERENCE_DATA");
  command.add_option("--page", arguments->page, "write the table with pictures here (.md)")->excludes(list);
  command.add_flag("--reference-curves", arguments->reference_curves,
                   "also draw the pictures that show curves of others");
  command.callback([=, &request] { request.call = [=](const Console& console) { return call(*arguments, console); }; });
}

}  // namespace froude
