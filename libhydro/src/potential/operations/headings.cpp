#include "hydro/potential/operations/headings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hydro::potential {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;
constexpr double of_degrees = 1e-6;  // rad: degrees are printed with few digits

}  // namespace

double turned_above(double first, double heading) {
  return heading - whole_turn * std::floor((heading - first) / whole_turn);
}

bool goes_round(std::span<const double> table) {
  if (table.size() < 3) return false;
  double widest = 0;
  for (std::size_t i = 1; i < table.size(); ++i) widest = std::max(widest, table[i] - table[i - 1]);
  const double gap = table.front() + whole_turn - table.back();
  return gap > of_degrees && gap <= widest + of_degrees;
}

std::optional<BetweenHeadings> between_headings(std::span<const double> table, double heading) {
  const double first = table.front(), last = table.back(), beta = turned_above(first, heading);
  const std::size_t end = table.size() - 1;
  if (beta <= last) {
    const auto above = std::upper_bound(table.begin(), table.end(), beta);
    if (above == table.end()) return BetweenHeadings{end, end, 0};
    const auto i = static_cast<std::size_t>(above - table.begin());
    return BetweenHeadings{i - 1, i, (beta - table[i - 1]) / (table[i] - table[i - 1])};
  }
  if (beta <= last + of_degrees) return BetweenHeadings{end, end, 0};
  if (beta >= first + whole_turn - of_degrees) return BetweenHeadings{0, 0, 0};
  if (!goes_round(table)) return std::nullopt;
  return BetweenHeadings{end, 0, (beta - last) / (first + whole_turn - last)};
}

}  // namespace hydro::potential
