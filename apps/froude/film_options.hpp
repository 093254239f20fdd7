#pragma once
/// \file  The command lines of `froude track`, `calibrate` and `film`: froude-film answers them, and froude, which
/// starts that, describes them.
#include <functional>

#include "froude/command_line.hpp"
#include "froude/film_arguments.hpp"

namespace froude {

/// What the commands do.
struct FilmCommands {
  std::function<void(const TrackArguments&, const Console&)> track;
  std::function<void(const CalibrateArguments&, const Console&)> calibrate;
  std::function<void(const FilmArguments&, const Console&)> film;
};
void add_films(CLI::App& app, Request& request, const FilmCommands& commands);

}  // namespace froude
