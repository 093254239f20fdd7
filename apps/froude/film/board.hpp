#pragma once
/// \file  Checkerboards: their corners in a picture, and what they tell of a camera, through OpenCV's calib3d (Zhang
/// 2000).
#include <Eigen/Core>

#include <vector>

#include "fit/camera/picture.hpp"
#include "fit/camera/view.hpp"

namespace froude::film {

struct BoardSize {
  int columns = 9, rows = 6;  ///< of corners between squares
  double square = 0;          ///< m
};

/// Corners to a part of a pixel, row after row from the one that is nearest to the upper left; empty unless the whole
/// board is seen.
std::vector<Eigen::Vector2d> find_board(const ::fit::camera::Picture& picture, const BoardSize& board);

struct LensFit {
  ::fit::camera::Lens lens;
  double rms = 0;  ///< px, of both coordinates together
  std::vector<double> rms_of_picture = {};
  std::vector<double> deviations = {};  ///< of f_x, f_y, c_x, c_y, k₁, k₂, p₁, p₂, k₃; zero where it is held
};
LensFit fit_lens(const std::vector<std::vector<Eigen::Vector2d>>& boards, const BoardSize& board,
                 const Eigen::Vector2i& size, int radial, bool tangential);

struct PoseFit {
  ::fit::camera::PlanePose pose;
  double rms = 0;  ///< px
};
/// \throws hydro::NumericsError where there is none
PoseFit fit_pose(const std::vector<Eigen::Vector2d>& corners, const BoardSize& board, const ::fit::camera::Lens& lens);

}  // namespace froude::film
