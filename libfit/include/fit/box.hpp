#pragma once
/// \file  Samples as a box: quartiles, whiskers, outliers. (F110) in docs/theory/fit.md.
#include <vector>

namespace fit {

/// Value below which the share `q` of the sorted values lies, straight lines between them; (S3). \throws
/// hydro::InputError if there is none or q is not between 0 and 1
double quantile_of(std::vector<double> values, double q);

/// Where samples lie, in their unit.
struct Box {
  double lower_quartile, median, upper_quartile;
  double low, high;              ///< whiskers: the lowest and the highest sample that is no outlier
  std::vector<double> outliers;  ///< beyond the quartiles by more than 1.5 times their distance; increasing
};

/// Of samples in any order. \throws hydro::InputError if there is none or one is not finite
Box box_of(std::vector<double> samples);

}  // namespace fit
