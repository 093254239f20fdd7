#pragma once
/// \file  A scene of a film: a run of a scene of motion, and the camera that films it. Plain data.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "answers/camera.hpp"

namespace froude::scene {

struct FilmScene {
  struct Marker {
    std::string name;
    std::string node = {};                   ///< signals NODE.x, NODE.y and NODE.z of the run
    std::optional<Eigen::Vector3d> at = {};  ///< in place of a node: it stays there
    std::optional<int> tag = {};             ///< its number
    Place place = {};
  };
  std::string title;
  Located<std::filesystem::path> scene = {};
  CameraTable camera;
  std::vector<Marker> markers;
  int width = 0, height = 0;                                  ///< px
  double frame_rate = 0;                                      ///< Hz
  double exposure = 0;                                        ///< s
  double disc_radius = 0, sticker_radius = 0, bar_width = 0;  ///< m
  std::string tags = {};                                      ///< family of tags in place of discs; empty: discs
  double tag_side = 0;                                        ///< m, of their black squares
  double blur = 0, noise = 0, fall_of_light = 0, flicker = 0, lost = 0;
  std::uint64_t seed = 1;
  Place place = {};
};

const Table& film_schema();  ///< root of a scene of a film
FilmScene read_film(const std::filesystem::path& file);

}  // namespace froude::scene
