#pragma once
/// \file  How water goes to and fro past the segments of a line, and coefficients by that. (D104), (D105)
#include <string>
#include <vector>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// Water past the middle of a segment that holds still, across its axis, along the direction in which most passes.
struct Exposure {
  double velocity;  ///< U, m/s: √2 of its root mean square; of a sine its amplitude
  double period;    ///< T, s: 2π times the ratio of root mean squares of velocity and acceleration; of a sine its own

  double keulegan_carpenter(double diameter) const { return velocity * period / diameter; }
  double reynolds(double diameter, double viscosity) const { return velocity * diameter / viscosity; }
};

/// Of each segment, over `instants` instants between two times, for nodes in `places`. \throws hydro::InputError at a
/// segment past which no water goes, or whose middle is above the water at one of them
std::vector<Exposure> exposure(const hydro::waves::WaveField& field, const Places& places, double from_s, double to_s,
                               int instants = 2000);

/// C_D and C_A across the axis, by KC and perhaps Re: straight in their logarithms between the points of a grid.
class CoefficientTable {
 public:
  struct Row {
    double kc, re, cd, ca;  ///< re: the same in every row of a table that knows none
  };
  struct Pair {
    double cd, ca;
  };
  /// Rows in any order, one for each pair of a KC and an Re that occur. \throws hydro::InputError for fewer than two
  /// KC, a pair that is missing or there twice, KC or Re not above 0, coefficients below 0
  explicit CoefficientTable(std::vector<Row> rows);

  bool knows_reynolds() const { return re_.size() > 1; }
  /// `re` is not looked at where the table knows none. \throws hydro::InputError outside the table: nothing is guessed
  Pair at(double kc, double re) const;

 private:
  std::vector<double> kc_, re_;
  std::vector<Pair> grid_;  // row by row of KC
};

}  // namespace dynamics::line
