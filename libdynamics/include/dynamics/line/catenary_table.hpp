#pragma once
/// \file  The elastic catenary from a table of its energy, for lines that are asked for often. (D120)
#include <vector>

#include "dynamics/line/catenary.hpp"

namespace dynamics {

/// Where the fairlead may be, seen from the anchor, m.
struct Reach {
  double x_low, x_high, z_low, z_high;

  bool holds(double x, double z) const { return x >= x_low && x <= x_high && z >= z_low && z <= z_high; }
};

/// A line over a rectangle of places of its fairlead: bicubic in the energy, so that the pull is its exact gradient and
/// does no net work around a loop. The pull is continuous, the stiffness jumps from cell to cell.
class CatenaryTable {
 public:
  /// Halves the cells until the pull is within `tolerance` of the largest one in the rectangle. \throws
  /// hydro::InputError where 512 cells a side do not do, or the line has no shape somewhere in the rectangle
  CatenaryTable(const LineProperties& line, const Reach& reach, double tolerance);

  /// As catenary(), of a place that the table holds; the rest of the line lies on the bed, or none does.
  LineTension at(double x_m, double z_m) const;
  const Reach& reach() const { return reach_; }
  /// The largest difference of the pull from catenary() at the points of the cells where it is largest, N.
  double error() const { return error_; }
  int cells() const { return cells_; }  ///< along each side

 private:
  struct Node {
    double E, Ex, Ez, Exz;  ///< J, N, N, N/m
  };
  void fill();
  double largest_difference(double enough) const;
  const Node& node(int i, int k) const { return nodes_[static_cast<std::size_t>(k * (cells_ + 1) + i)]; }

  LineProperties line_;
  Reach reach_;
  int cells_ = 4;
  double width_ = 0, height_ = 0;  ///< of a cell, m
  double error_ = 0, largest_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace dynamics
