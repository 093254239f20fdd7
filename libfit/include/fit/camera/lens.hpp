#pragma once
/// \file  A lens: a pinhole with radial and tangential distortion; (V1), (V2), docs/theory/camera.md.
#include <Eigen/Core>

#include <array>

namespace fit::camera {

/// Pixels count from the centre of the upper left one, which is (0, 0): x to the right, y down.
struct Lens {
  Eigen::Vector2d focal;               ///< px, along x and y
  Eigen::Vector2d principal;           ///< px
  std::array<double, 3> radial{};      ///< k₁, k₂, k₃
  std::array<double, 2> tangential{};  ///< p₁, p₂
  Eigen::Vector2i size{0, 0};          ///< px, width and height of the pictures it was calibrated with
};

/// Where the ray (x/z, y/z) in the camera's axes (x right, y down, z ahead) would meet the plane z = 1 if the lens did
/// not distort it, to where it seems to meet it (Brown 1971, eq. 1).
Eigen::Vector2d distorted(const Lens& lens, const Eigen::Vector2d& ray);
/// ∂ distorted / ∂ ray.
Eigen::Matrix2d distortion_slope(const Lens& lens, const Eigen::Vector2d& ray);

Eigen::Vector2d pixel_of(const Lens& lens, const Eigen::Vector2d& ray);
/// The ray of a pixel, by Newton's method, to 1e-12. \throws hydro::InputError for a pixel that the polynomials of the
/// distortion do not reach, or reach beyond the radius where they fold the picture over itself
Eigen::Vector2d ray_of(const Lens& lens, const Eigen::Vector2d& pixel);

/// \throws hydro::InputError unless focal lengths and size are positive and the rays of all corners can be told
void check(const Lens& lens);

}  // namespace fit::camera
