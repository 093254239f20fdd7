#pragma once
/// \file  Headings of a table as directions: those that differ by whole turns are the same. (P42)
#include <cstddef>
#include <optional>
#include <span>

namespace hydro::potential {

/// The same direction less than one turn above `first`, rad.
double turned_above(double first, double heading);

/// Whether the way from the last heading on to the first is one between neighbours like the others: at least three
/// headings, and the last less than one turn, but no farther from the first than any neighbours are.
bool goes_round(std::span<const double> table);

/// Where a direction lies among those of a table: (1 − share) of the value at `first`, share of that at `second`.
struct BetweenHeadings {
  std::size_t first, second;
  double share;
};

/// `table`: increasing, rad, not empty. Nothing where the direction is outside the table, more than the rounding of
/// degrees with four decimals.
std::optional<BetweenHeadings> between_headings(std::span<const double> table, double heading);

}  // namespace hydro::potential
