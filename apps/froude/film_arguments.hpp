#pragma once
/// \file  What the commands about films are told. It names nothing of OpenCV, so that froude can describe them.
#include <optional>
#include <string>
#include <vector>

#include "froude/commands.hpp"

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

struct FilmArguments {
  Path scene;
  Path output;
  std::optional<Path> truth = {};  ///< .csv, a track without errors
};

}  // namespace froude
