#include "answers/plot_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "hydro/base/error.hpp"

namespace froude::plot {
namespace {

/// Midpoints between neighbours, and as far beyond the ends.
std::vector<double> edges_between(const std::vector<double>& at) {
  const std::size_t n = at.size();
  hydro::ensure(n >= 2, "plot: a field needs two points and more along each axis");
  std::vector<double> out{at[0] - (at[1] - at[0]) / 2};
  for (std::size_t i = 1; i < n; ++i) out.push_back((at[i - 1] + at[i]) / 2);
  out.push_back(at[n - 1] + (at[n - 1] - at[n - 2]) / 2);
  return out;
}

struct Corner {
  double x, y, value;
};
/// Where the level lies on the way between two corners.
std::optional<Corner> crossing(const Corner& a, const Corner& b, double level) {
  if ((a.value < level) == (b.value < level)) return std::nullopt;
  const double share = (level - a.value) / (b.value - a.value);
  return Corner{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), level};
}

void add_triangle(const std::array<Corner, 3>& t, double level, std::vector<ContourPiece>& out) {
  if (!std::all_of(t.begin(), t.end(), [](const Corner& c) { return std::isfinite(c.value); })) return;
  std::vector<Corner> ends;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (const auto at = crossing(t[k], t[(k + 1) % t.size()], level)) ends.push_back(*at);
  if (ends.size() == 2) out.push_back({ends[0].x, ends[0].y, ends[1].x, ends[1].y});
}

}  // namespace

std::vector<Tile> tiles_of(const Field& field) {
  const auto x = edges_between(field.xs), y = edges_between(field.ys);
  std::vector<Tile> out;
  for (std::size_t j = 0; j < field.ys.size(); ++j)
    for (std::size_t i = 0; i < field.xs.size(); ++i)
      if (std::isfinite(field.values[j][i])) out.push_back({x[i], x[i + 1], y[j], y[j + 1], field.values[j][i]});
  return out;
}

std::pair<double, double> extent(const std::vector<double>& at) {
  const auto edges = edges_between(at);
  return {edges.front(), edges.back()};
}

std::vector<ContourPiece> contour(const Field& field, double level) {
  const auto corner = [&](std::size_t i, std::size_t j) {
    return Corner{field.xs[i], field.ys[j], field.values[j][i]};
  };
  std::vector<ContourPiece> out;
  for (std::size_t j = 0; j + 1 < field.ys.size(); ++j)
    for (std::size_t i = 0; i + 1 < field.xs.size(); ++i) {
      const Corner low = corner(i, j), high = corner(i + 1, j + 1);
      add_triangle({low, corner(i + 1, j), high}, level, out);
      add_triangle({low, corner(i, j + 1), high}, level, out);
    }
  return out;
}

std::vector<ContourLine> joined(std::vector<ContourPiece> pieces) {
  std::vector<ContourLine> out;
  // On from the last point of a line as far as pieces go.
  const auto extend = [&](ContourLine& line) {
    for (;;) {
      const double x = line.x.back(), y = line.y.back();
      const auto next = std::find_if(pieces.begin(), pieces.end(), [&](const ContourPiece& p) {
        return (p.x1 == x && p.y1 == y) || (p.x2 == x && p.y2 == y);
      });
      if (next == pieces.end()) return;
      const bool forwards = next->x1 == x && next->y1 == y;
      line.x.push_back(forwards ? next->x2 : next->x1);
      line.y.push_back(forwards ? next->y2 : next->y1);
      pieces.erase(next);
    }
  };
  while (!pieces.empty()) {
    const ContourPiece first = pieces.back();
    pieces.pop_back();
    ContourLine line{{first.x1, first.x2}, {first.y1, first.y2}};
    extend(line);
    std::reverse(line.x.begin(), line.x.end());
    std::reverse(line.y.begin(), line.y.end());
    extend(line);
    out.push_back(std::move(line));
  }
  return out;
}

std::string colour_at(double share) {
  // Five colours of which each is lighter than the one before, for colour-blind readers and prints in grey too.
  constexpr std::array<std::array<double, 3>, 5> stops{
      {{59, 28, 96}, {49, 87, 139}, {38, 140, 135}, {110, 190, 90}, {250, 228, 60}}};
  const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  std::array<int, 3> mixed{};
  for (std::size_t c = 0; c < mixed.size(); ++c)
    mixed[c] = static_cast<int>(
        std::lround(stops[first][c] + (at - static_cast<double>(first)) * (stops[first + 1][c] - stops[first][c])));
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

}  // namespace froude::plot
