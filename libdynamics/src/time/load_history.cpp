#include "dynamics/time/load_history.hpp"

#include <array>

namespace dynamics {
namespace {

std::array<double, 4> corners(const LoadHistory& h) {
  return {h.from, h.from + h.ramp_up, h.until, h.until + h.ramp_down};
}

}  // namespace

int LoadHistory::piece(double t) const {
  int out = 0;
  for (const double corner : corners(*this)) out += t >= corner ? 1 : 0;
  return out;
}

// (D150)
double LoadHistory::share(double t, double within) const {
  switch (piece(within)) {
    case 1:
      return (t - from) / ramp_up;
    case 2:
      return 1;
    case 3:
      return 1 - (t - until) / ramp_down;
    default:
      return 0;
  }
}

double LoadHistory::next_corner(double t) const {
  for (const double corner : corners(*this))
    if (corner > t) return corner;
  return std::numeric_limits<double>::infinity();
}

}  // namespace dynamics
