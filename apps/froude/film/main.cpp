// froude-film: the commands that read and write films, behind a command line. It names itself as people call it,
// froude.
#include "froude/film/commands.hpp"
#include "froude/film_options.hpp"

namespace froude {
namespace {

int main_program(int argc, char** argv) {
  Request request;
  CLI::App app;
  app.name("froude");
  app.description("Films: tracks of markers, calibration of lenses, films of runs.");
  app.fallthrough();
  app.require_subcommand(1);
  add_common_flags(app, request);
  add_films(app, request, {.track = &track, .calibrate = &calibrate, .film = &render_film});
  return carry_out(app, request, argc, argv);
}

}  // namespace
}  // namespace froude

int main(int argc, char** argv) { return froude::main_program(argc, argv); }
