#pragma once
/// \file  What the sums of a table cost, for whoever chooses a method and for the table itself.
namespace hydro::waves::table {

// Seconds for each wave and each series of a table, fitted on one core of about 2022; only their ratios matter.
constexpr double by_product(double instants) { return 6e-11 * instants; }
constexpr double by_transform = 1e-7;

}  // namespace hydro::waves::table
