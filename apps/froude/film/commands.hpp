#pragma once
/// \file  The subcommands of `froude` that need OpenCV, as plain functions; main.cpp turns the command line into their
/// arguments. They are in a program of their own, froude-film, so that no other waits for OpenCV's libraries.
#include "fit/camera/assign.hpp"
#include "froude/film/video.hpp"
#include "froude/film_arguments.hpp"

namespace froude {

/// Where the discs of a film are, frame by frame, with the covariance of each place.
void track(const TrackArguments& arguments, const Console& console);

/// Lens, and plane of motion, from pictures of a checkerboard.
void calibrate(const CalibrateArguments& arguments, const Console& console);

/// A film of a run, whose truth is known.
void render_film(const FilmArguments& arguments, const Console& console);

}  // namespace froude
