#include "froude/export_options.hpp"

#include <memory>

namespace froude {

void add_export(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("export", "results for other programs: tables, MATLAB, ParaView");
  command->footer(
      "Examples:\n  froude export run.h5 -o run.csv --signal \"m1.*\" --from \"60 s\"\n  froude export rao.h5 -o "
      "rao.mat\n"
      "  froude export run.h5 -o run.pvd --every \"0.5 s\"\n  froude export run.h5 rao.h5 --format matlab -o "
      "for_matlab");
  auto arguments = std::make_shared<ExportArguments>();
  command
      ->add_option("results", arguments->results,
                   "of run, rao, modes, stability, waves make or psd (.h5), or a table of another command (.csv)")
      ->required();
  command
      ->add_option(
          "-o,--output", arguments->output,
          "a table (.csv), a file for MATLAB (.mat) or a collection for ParaView (.pvd); with --format a folder")
      ->required();
  command->add_option("--format", arguments->format, "of all results, which then go into a folder")
      ->check(CLI::IsMember({"csv", "matlab", "vtk"}));
  command->add_option("-s,--signal", arguments->signals, "signals to take; * stands for any text; default: all");
  command->add_option("--from", arguments->from, "of results in time: leave out what comes before: \"60 s\"");
  command->add_option("--to", arguments->to, "of results in time: leave out what comes after: \"360 s\"");
  command->add_option("--every", arguments->every,
                      "of results in time: the samples that are nearest to so much later and later: \"0.5 s\"");
  command->add_option("--scene-folder", arguments->scene_folder,
                      "where the scenes stood, whose meshes and coefficients .pvd needs; left out: beside each result");
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      export_results(*arguments, console);
      return done;
    };
  });
}

}  // namespace froude
