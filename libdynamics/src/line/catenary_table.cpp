#include "dynamics/line/catenary_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// The four cubics of Hermite on [0, h] at t h, with their first and second derivatives: they carry the value at 0, the
/// value at h, the slope at 0 and the slope at h.
struct Hermite {
  std::array<double, 4> value, slope, curvature;

  Hermite(double t, double h)
      : value{(1 + 2 * t) * (1 - t) * (1 - t), t * t * (3 - 2 * t), h * t * (1 - t) * (1 - t), h * t * t * (t - 1)},
        slope{6 * t * (t - 1) / h, 6 * t * (1 - t) / h, (1 - t) * (1 - 3 * t), t * (3 * t - 2)},
        curvature{(12 * t - 6) / (h * h), (6 - 12 * t) / (h * h), (6 * t - 4) / h, (6 * t - 2) / h} {}
};

constexpr int most_cells = 512;

}  // namespace

CatenaryTable::CatenaryTable(const LineProperties& line, const Reach& reach, double tolerance)
    : line_(line), reach_(reach) {
  hydro::require(reach.x_high > reach.x_low && reach.z_high > reach.z_low && reach.x_low >= 0,
                 "a table of a catenary needs a rectangle on one side of the anchor, got x {} to {} m, z {} to {} m",
                 reach.x_low, reach.x_high, reach.z_low, reach.z_high);
  hydro::require(tolerance > 0 && tolerance < 1, "the tolerance of a table must be between 0 and 1, got {}", tolerance);
  for (; cells_ <= most_cells; cells_ *= 2) {
    fill();
    error_ = largest_difference(tolerance * largest_);
    if (error_ <= tolerance * largest_) return;
  }
  throw hydro::InputError(
      fmt::format(
          "a table of {} x {} places of a line is still {:.2g} of its largest pull away from the catenary, more "
          "than {:.2g}",
          most_cells, most_cells, error_ / largest_, tolerance),
      {}, "a smaller reach, a larger tolerance, or no table");
}

void CatenaryTable::fill() {
  width_ = (reach_.x_high - reach_.x_low) / cells_;
  height_ = (reach_.z_high - reach_.z_low) / cells_;
  nodes_.clear();
  largest_ = 0;
  for (int k = 0; k <= cells_; ++k)
    for (int i = 0; i <= cells_; ++i) {
      const LineTension t = catenary(line_, reach_.x_low + i * width_, reach_.z_low + k * height_);
      nodes_.push_back({t.stored, t.horizontal, t.vertical, t.stiffness(0, 1)});
      largest_ = std::max(largest_, t.fairlead());
    }
}

// The slope of a cubic that meets values and slopes at both ends is worst at (3 ± √3)/6 between them.
double CatenaryTable::largest_difference(double enough) const {
  const double early = (3 - std::sqrt(3.0)) / 6;
  double largest = 0;
  for (int k = 0; k < cells_; ++k)
    for (int i = 0; i < cells_; ++i)
      for (const double t : {early, 1 - early}) {
        const double x = reach_.x_low + (i + t) * width_, z = reach_.z_low + (k + early) * height_;
        const LineTension is = at(x, z), should = catenary(line_, x, z);
        largest = std::max(largest, std::hypot(is.horizontal - should.horizontal, is.vertical - should.vertical));
        if (largest > enough && cells_ < most_cells) return largest;
      }
  return largest;
}

LineTension CatenaryTable::at(double x, double z) const {
  const double u = (x - reach_.x_low) / width_, v = (z - reach_.z_low) / height_;
  const int i = std::clamp(static_cast<int>(u), 0, cells_ - 1), k = std::clamp(static_cast<int>(v), 0, cells_ - 1);
  const Hermite X(u - i, width_), Z(v - k, height_);
  LineTension out{0, 0, 0, 0, 0, Eigen::Matrix2d::Zero()};
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t a = 0; a < 2; ++a) {
      const Node& n = node(i + static_cast<int>(a), k + static_cast<int>(b));
      const auto sum = [&](const std::array<double, 4>& by_x, const std::array<double, 4>& by_z) {
        return n.E * by_x[a] * by_z[b] + n.Ex * by_x[2 + a] * by_z[b] + n.Ez * by_x[a] * by_z[2 + b] +
               n.Exz * by_x[2 + a] * by_z[2 + b];
      };
      out.stored += sum(X.value, Z.value);
      out.horizontal += sum(X.slope, Z.value);
      out.vertical += sum(X.value, Z.slope);
      out.stiffness(0, 0) += sum(X.curvature, Z.value);
      out.stiffness(1, 1) += sum(X.value, Z.curvature);
      out.stiffness(0, 1) += sum(X.slope, Z.slope);
    }
  out.stiffness(1, 0) = out.stiffness(0, 1);
  out.anchor_vertical = out.vertical - line_.weight * line_.length;
  if (line_.on_bed && out.anchor_vertical < 0) {
    out.resting = -out.anchor_vertical / line_.weight;
    out.anchor_vertical = 0;
  }
  return out;
}

}  // namespace dynamics
