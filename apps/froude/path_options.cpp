#include "froude/path_options.hpp"

#include <memory>

namespace froude {

void add_poincare(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand(
      "poincare", "Poincare section: where two signals are when a third crosses a level, or once in a period");
  command->footer(
      "Examples:\n  froude poincare run.h5 --x chain.link2.polar --y chain.link2.polar_rate --at chain.link1.polar "
      "--level \"90 deg\" --picture poincare.svg\n"
      "  froude poincare run.h5 --x chain.link2.polar --y chain.link2.polar_rate --every \"8 s\" --from \"200 s\"");
  auto arguments = std::make_shared<PoincareArguments>();
  command->add_option("file", arguments->file, "CSV with units in its header, or a result of `froude run`")->required();
  command->add_option("--x", arguments->x, "signal along the Poincare section")->required();
  command->add_option("--y", arguments->y, "the other one")->required();
  command->add_option("--at", arguments->at, "signal that crosses the level");
  command->add_option("--level", arguments->level, "which it crosses: \"90 deg\"");
  command->add_option("--through", arguments->through, "in which direction")
      ->check(CLI::IsMember({"up", "down", "both"}))
      ->capture_default_str();
  command->add_option("--every", arguments->every, "instead of --at: once in this period: \"8 s\"");
  command->add_option("--from", arguments->from, "leave out what comes before; with --every the first point");
  command->add_flag("--wrap", arguments->wrap, "angles between -180 and 180 deg, without their full turns");
  command->add_option("-o,--output", arguments->output, "table (.csv)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, poincare);
}

void add_trajectory(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("trajectory", "paths in space, by three signals each, drawn in perspective");
  command->footer(
      "Examples:\n  froude trajectory double.h5 --point double.node1 --point double.node2 --picture double.svg\n"
      "  froude trajectory run.h5 --x m1.surge --y m1.heave --z m1.pitch --from \"60 s\" --picture motion.png");
  auto arguments = std::make_shared<TrajectoryArguments>();
  command->add_option("file", arguments->file, "CSV with units in its header, or a result of `froude run`")->required();
  command->add_option("--point", arguments->points,
                      "what signals .x, .y and .z are of: \"rope.node3\"; as often as there are paths");
  command->add_option("--x", arguments->x, "instead: the signal along x of one path");
  command->add_option("--y", arguments->y, "along y");
  command->add_option("--z", arguments->z, "up");
  command->add_option("--from", arguments->from, "leave out what comes before: \"60 s\"");
  command->add_option("--to", arguments->to, "leave out what comes after: \"360 s\"");
  command->add_option("--azimuth", arguments->azimuth, "of the eye about z, from +x towards +y")->capture_default_str();
  command->add_option("--elevation", arguments->elevation, "of the eye above the level, less than 90 deg")
      ->capture_default_str();
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)")->required();
  calls(*command, request, arguments, trajectory);
}

void add_snapshot(CLI::App& app, Request& request) {
  auto* command = app.add_subcommand("snapshot", "where lines and members of bodies are at chosen instants of a run");
  command->footer(
      "Examples:\n  froude snapshot dropper.h5 --line dropper --at \"4 s\" --at \"6 s\" --picture line.svg\n"
      "  froude snapshot dropper.h5 --line dropper --at \"4 s\" --plane xz --plane xy --picture both.png");
  auto arguments = std::make_shared<SnapshotArguments>();
  command->add_option("file", arguments->file, "result of `froude run`, with the places of all nodes")->required();
  command->add_option("--line", arguments->lines, "the name of a line; as often as there are lines to show");
  command->add_option("--body", arguments->bodies,
                      "the name of a body, whose members are shown; \"m*\": all that are called so");
  command->add_option("--at", arguments->at, "an instant: \"4 s\", of which the nearest sample is shown")->required();
  command->add_option("--plane", arguments->planes, "what goes along the picture and up it; one picture below another")
      ->check(CLI::IsMember({"xz", "yz", "xy", "yx", "zx", "zy"}))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "table (.csv)");
  command->add_option("--picture", arguments->picture, "plot (.svg, .png, .pdf)");
  calls(*command, request, arguments, snapshot);
}

}  // namespace froude
