#pragma once
/// \file  Private to interchange: triangles, pieces of lines and quadrangles in space, and VTK's XML of them.
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "view/view.hpp"

namespace froude::interchange {

/// A closed surface: what is round is cut into flat faces.
struct Faces {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise seen from outside
};
Faces faces_of(const view::Shape& shape);

/// Cells of one kind over points, and what stands at each.
struct Grid {
  enum class Cell : std::uint8_t { piece = 3, triangle = 5, quadrangle = 9 };  ///< VTK's numbers
  Cell cell;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::int32_t> corners;  ///< 2, 3 or 4 a cell
  std::vector<std::pair<std::string, std::vector<double>>> of_cells = {}, of_points = {};

  std::size_t corners_of_a_cell() const { return cell == Cell::piece ? 2 : cell == Cell::triangle ? 3 : 4; }
};

/// A whole .vtu.
std::string vtu_of(const Grid& grid, double time_s);

}  // namespace froude::interchange
