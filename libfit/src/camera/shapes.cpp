#include "fit/camera/shapes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

/// Between pixels, by the four around.
double grey_at(const Picture& p, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  const double u = at.x() - x, v = at.y() - y;
  return (1 - v) * ((1 - u) * p.at(x, y) + u * p.at(x + 1, y)) +
         v * ((1 - u) * p.at(x, y + 1) + u * p.at(x + 1, y + 1));
}

bool within(const Picture& p, const Eigen::Vector2d& at) {
  return at.x() >= 0 && at.y() >= 0 && at.x() < p.width - 1 && at.y() < p.height - 1;
}

Eigen::Vector2d turned(const Eigen::Vector2d& d) { return {-d.y(), d.x()}; }

/// One side of a square: from a point of it along a direction, moved outwards by `off` and turned by `slope`, both with
/// their covariance.
struct Side {
  Eigen::Vector2d middle, along, outwards;
  Eigen::Vector2d fitted = Eigen::Vector2d::Zero();  // off, slope
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// How far outwards the edge lies at a point of the side: the centroid of the change of grey across it. (V16)
std::optional<double> edge_at(const Picture& p, const Eigen::Vector2d& at, const Eigen::Vector2d& outwards,
                              double reach) {
  constexpr double least_contrast = 20;  // grey levels between both sides of an edge
  const double step = 0.5;
  const int steps = static_cast<int>(std::ceil(reach / step));
  double sum = 0, moment = 0;
  for (int i = -steps; i < steps; ++i) {
    const Eigen::Vector2d a = at + step * i * outwards, b = at + step * (i + 1) * outwards;
    if (!within(p, a) || !within(p, b)) return {};
    const double change = grey_at(p, b) - grey_at(p, a);
    sum += change;
    moment += change * step * (i + 0.5);
  }
  if (sum < least_contrast || std::abs(moment) > sum * reach) return {};
  return moment / sum;
}

/// The straight line through the edges along a side.
std::optional<Side> side_of(const Picture& p, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                            const Eigen::Vector2d& middle_of_all) {
  const double length = (to - from).norm();
  if (length < 12) return {};
  Side side{.middle = (from + to) / 2, .along = (to - from) / length, .outwards = turned(to - from) / length};
  if (side.outwards.dot(side.middle - middle_of_all) < 0) side.outwards = -side.outwards;
  // The pattern begins an eighth of the side within it, and more.
  const double reach = std::clamp(0.4 * length / 8, 1.5, 4.0);
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double squares = 0, n = 0;
    for (double t = -0.35 * length; t <= 0.35 * length; t += 1.0) {
      const double expected = side.fitted[0] + side.fitted[1] * t;
      const auto edge = edge_at(p, side.middle + t * side.along + expected * side.outwards, side.outwards,
                                round == 0 ? reach + 1 : reach);
      if (!edge) continue;
      const Eigen::Vector2d basis(1, t);
      normal += basis * basis.transpose();
      right += (expected + *edge) * basis;
      squares += (expected + *edge) * (expected + *edge);
      ++n;
    }
    if (n < 6 || n < 0.5 * 0.7 * length) return {};
    const Eigen::Matrix2d inverse = normal.inverse();
    side.fitted = inverse * right;
    side.covariance = inverse * std::max(1e-6, (squares - right.dot(side.fitted)) / (n - 2));
  }
  return side;
}

using SidesFitted = Eigen::Matrix<double, 8, 1>;

Eigen::Vector2d crossing(const Eigen::Vector2d& a, const Eigen::Vector2d& along_a, const Eigen::Vector2d& b,
                         const Eigen::Vector2d& along_b) {
  Eigen::Matrix2d both;
  both << along_a, -along_b;
  return a + along_a * (both.inverse() * (b - a))[0];
}

Eigen::Vector2d middle_of(const std::array<Side, 4>& sides, const SidesFitted& fitted) {
  std::array<Eigen::Vector2d, 4> at, along, corner;
  for (std::size_t k = 0; k < 4; ++k) {
    const Side& s = sides[k];
    const auto i = static_cast<Eigen::Index>(2 * k);
    at[k] = s.middle + fitted[i] * s.outwards;
    along[k] = s.along + fitted[i + 1] * s.outwards;
  }
  for (std::size_t k = 0; k < 4; ++k) corner[k] = crossing(at[(k + 3) % 4], along[(k + 3) % 4], at[k], along[k]);
  return crossing(corner[0], corner[2] - corner[0], corner[1], corner[3] - corner[1]);
}

}  // namespace

std::optional<Sighting> middle_of_square(const Picture& picture, const std::array<Eigen::Vector2d, 4>& corners) {
  const Eigen::Vector2d rough = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  std::array<Side, 4> sides;
  SidesFitted fitted;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto side = side_of(picture, corners[k], corners[(k + 1) % 4], rough);
    if (!side) return {};
    sides[k] = *side;
    fitted.segment<2>(static_cast<Eigen::Index>(2 * k)) = side->fitted;
  }
  Sighting out{.at = middle_of(sides, fitted), .covariance = Eigen::Matrix2d::Zero()};
  constexpr double step = 1e-4;
  for (std::size_t k = 0; k < 4; ++k) {
    Eigen::Matrix2d slope;
    for (Eigen::Index j = 0; j < 2; ++j) {
      const SidesFitted by = step * SidesFitted::Unit(static_cast<Eigen::Index>(2 * k) + j);
      slope.col(j) = (middle_of(sides, fitted + by) - middle_of(sides, fitted - by)) / (2 * step);
    }
    out.covariance += slope * sides[k].covariance * slope.transpose();
  }
  // Of sides that cross far away, at the horizon of a square seen from its edge, nothing can be told.
  if (!out.at.allFinite() || (out.at - rough).norm() > 0.25 * (corners[2] - corners[0]).norm()) return {};
  return out;
}

std::optional<Sighting> middle_of_pattern(const Picture& picture, const Picture& pattern, const Eigen::Vector2d& near) {
  hydro::require(pattern.width >= 7 && pattern.height >= 7, "a pattern of {} x {} pixels is too small: 7 x 7 at least",
                 pattern.width, pattern.height);
  const Eigen::Vector2d half((pattern.width - 1) / 2.0, (pattern.height - 1) / 2.0);
  Eigen::Vector2d at = near;
  Eigen::Matrix2d covariance;
  for (int round = 0; round < 20; ++round) {  // (V17): brightness, contrast and the place, by Gauss and Newton
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0, n = 0;
    for (int y = 1; y + 1 < pattern.height; ++y)
      for (int x = 1; x + 1 < pattern.width; ++x) {
        const Eigen::Vector2d seen = at - half + Eigen::Vector2d(x, y);
        if (!within(picture, seen)) return {};
        const double across = (pattern.at(x + 1, y) - pattern.at(x - 1, y)) / 2.0,
                     down = (pattern.at(x, y + 1) - pattern.at(x, y - 1)) / 2.0, g = grey_at(picture, seen);
        const Eigen::Vector4d basis(1, pattern.at(x, y), across, down);
        normal += basis * basis.transpose();
        right += g * basis;
        squares += g * g;
        ++n;
      }
    const Eigen::Matrix4d inverse = normal.inverse();
    const Eigen::Vector4d fitted = inverse * right;  // the last two are contrast times the move, with a minus
    if (!fitted.allFinite() || fitted[1] <= 0.05) return {};
    const Eigen::Vector2d move = -fitted.tail<2>() / fitted[1];
    // Between pixels noise is less, and what neighbours share: the place feels that of the pixels themselves.
    const Eigen::Array2d part = at - half - (at - half).array().floor().matrix();
    const double smoothed = ((1 - part).square() + part.square()).prod();
    covariance = inverse.bottomRightCorner<2, 2>() *
                 (std::max(1.0 / 12, (squares - right.dot(fitted)) / (n - 4) / smoothed) / (fitted[1] * fitted[1]));
    at += move.cwiseMax(-1).cwiseMin(1);
    if ((at - near).norm() > 3) return {};
    if (move.norm() < 1e-4) return Sighting{at, covariance};
  }
  return {};
}

}  // namespace fit::camera
