#pragma once
/// \file  The subcommands of `froude` that need OpenCV, as plain functions; main.cpp turns the command line into these
/// arguments. They are in a program of their own, froude-film, so that no other waits for OpenCV's libraries.
#include <optional>
#include <string>
#include <vector>

#include "fit/camera/assign.hpp"
#include "froude/commands.hpp"
#include "froude/film/video.hpp"

namespace froude {

struct TrackArguments {
  Path film;
  std::string markers;                   ///< "pin0, pin1, bob", or how many
  std::string radius = "3 px .. 30 px";  ///< of the discs
  double contrast = 40, roundness = 0.4;
  bool dark = false;
  std::optional<std::string> colour = {};  ///< "#e02020": what is near to it is bright
  std::string order = "left to right";     ///< of the markers in the first frame
  std::optional<std::string> first = {};   ///< where they are there: "(412, 220), (530, 310)"
  std::optional<Path> pattern = {};        ///< a picture of the marker, in place of discs
  double likeness = 0.8;                   ///< of a place to it, normalised correlation, at least
  std::optional<std::string> tags = {};    ///< family: markers are tags, and `markers` says their numbers, "pivot = 3"
  std::vector<std::string> lengths = {};   ///< "pin0 pin1 120 px 2 px": markers, their distance, its deviation
  std::optional<std::string> frame_rate = {}, from = {}, to = {};
  Path output;
  std::optional<Path> annotated = {}, picture = {};
};
/// Where the discs of a film are, frame by frame, with the covariance of each place.
void track(const TrackArguments& arguments, const Console& console);

struct CalibrateArguments {
  std::vector<Path> pictures;      ///< or one film
  std::string corners = "9 x 6";   ///< between the squares of the board, along its rows and columns
  std::string square;              ///< "25 mm"
  std::optional<Path> plane = {};  ///< picture of the board in the plane of motion
  int radial = 2;                  ///< coefficients
  bool tangential = false;
  Path output;
  std::optional<Path> annotated = {};  ///< folder of pictures with the corners found
};
/// Lens, and plane of motion, from pictures of a checkerboard.
void calibrate(const CalibrateArguments& arguments, const Console& console);

struct FilmArguments {
  Path scene;
  Path output;
  std::optional<Path> truth = {};  ///< .csv, a track without errors
};
/// A film of a run, whose truth is known.
void render_film(const FilmArguments& arguments, const Console& console);

}  // namespace froude
