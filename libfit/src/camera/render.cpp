#include "fit/camera/render.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace fit::camera {
namespace {

/// Samples of a pixel along each side: a blur of half a pixel and more leaves nothing that two do not see.
int samples_across(double blur_px) { return blur_px >= 0.5 ? 2 : 4; }
/// How far an edge reaches, px: beyond it less than 2e-4 of its light is left.
double reach_of(double blur_px) { return 1 + 3.5 * blur_px; }

/// Share of a disc's light at a distance from its edge (positive inside), both in px; the optics' blur and the size of
/// a sample soften it.
float share_of(double inside_px, double blur_px) {
  const double soft = std::max(blur_px, 0.125);
  return static_cast<float>(0.5 * std::erfc(-inside_px / (std::sqrt(2.0) * soft)));
}

void cover(float& light, float level, float share) { light += share * (level - light); }

/// Draws what is drawn of one frame, piece over piece.
class Drawing {
 public:
  Drawing(const Filming& filming, Light& light) : filming_(filming), light_(light) {}

  /// A disc at each of these places for an equal part of the exposure.
  void add_disc(const std::vector<Eigen::Vector2d>& places, double radius, double level) {
    Eigen::Array4i box(light_.cols(), -1, light_.rows(), -1);
    std::vector<Spot> spots;
    for (const Eigen::Vector2d& place : places) {
      const Eigen::Vector2d pixel = pixel_of(filming_.view, place);
      const Eigen::Matrix2d slope = point_slope(filming_.view, pixel);
      const double scale = std::sqrt(std::abs(slope.determinant()));
      spots.push_back({place, scale, slope});
      // Where the disc ends along x and y: rows of the inverse slope.
      const Eigen::Matrix2d inverse = slope.inverse();
      const Eigen::Vector2d reach =
          radius * inverse.rowwise().norm() + Eigen::Vector2d::Constant(reach_of(filming_.blur_px));
      box[0] = std::min(box[0], static_cast<int>(std::floor(pixel.x() - reach.x())));
      box[1] = std::max(box[1], static_cast<int>(std::ceil(pixel.x() + reach.x())));
      box[2] = std::min(box[2], static_cast<int>(std::floor(pixel.y() - reach.y())));
      box[3] = std::max(box[3], static_cast<int>(std::ceil(pixel.y() + reach.y())));
    }
    for (int y = std::max(0, box[2]); y <= std::min<int>(box[3], static_cast<int>(light_.rows()) - 1); ++y)
      for (int x = std::max(0, box[0]); x <= std::min<int>(box[1], static_cast<int>(light_.cols()) - 1); ++x)
        cover(light_(y, x), static_cast<float>(level), share(spots, x, y, radius));
  }

  /// (V24) A pattern of square cells, upright, its middle at each of these places for an equal part of the exposure.
  /// Samples lie in a box whose variance is that of a pixel and of the blur together.
  void add_pattern(const std::vector<Eigen::Vector2d>& places, const Picture& cells, double cell) {
    constexpr int across = 6;
    const double box = std::sqrt(1 + 12 * filming_.blur_px * filming_.blur_px);
    const Eigen::Vector2d size(cells.width, cells.height);
    for (const Eigen::Vector2d& place : places) {
      const Eigen::Vector2d pixel = pixel_of(filming_.view, place);
      const Eigen::Vector2d reach =
          (point_slope(filming_.view, pixel).inverse().cwiseAbs() * (cell / 2 * size)).array() + box;
      const Eigen::Array2i last(static_cast<int>(light_.cols()) - 1, static_cast<int>(light_.rows()) - 1),
          from = (pixel - reach).array().floor().cast<int>().max(0),
          to = (pixel + reach).array().ceil().cast<int>().min(last);
      for (int y = from.y(); y <= to.y(); ++y)
        for (int x = from.x(); x <= to.x(); ++x) {
          const Eigen::Vector2d middle(x, y), point = point_of(filming_.view, middle);
          const Eigen::Matrix2d slope = point_slope(filming_.view, middle);
          float level = 0, share = 0;
          for (int i = 0; i < across; ++i)
            for (int j = 0; j < across; ++j) {
              const Eigen::Vector2d off((i + 0.5) / across - 0.5, (j + 0.5) / across - 0.5),
                  at = (point + box * (slope * off) - place) / cell;
              const double right = filming_.view.leftwards ? -at.x() : at.x();       // it faces the camera
              const Eigen::Array2d in(right + size.x() / 2, size.y() / 2 - at.y());  // rows count down
              if ((in < 0).any() || (in >= size.array()).any()) continue;
              level += cells.at(static_cast<int>(in.x()), static_cast<int>(in.y()));
              share += 1;
            }
          if (share == 0) continue;
          cover(light_(y, x), level / share, share / static_cast<float>(across * across * std::ssize(places)));
        }
    }
  }

  /// A bar between two places, sharp: what it does to discs is that it ends under their stickers.
  void add_bar(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d a = pixel_of(filming_.view, from), b = pixel_of(filming_.view, to);
    const double scale = std::sqrt(std::abs(point_slope(filming_.view, a).determinant())),
                 half = filming_.bar_width / 2 / scale, length = (b - a).squaredNorm();
    const Eigen::Vector2d low = a.cwiseMin(b).array() - half - 1, high = a.cwiseMax(b).array() + half + 1;
    for (int y = std::max(0, static_cast<int>(low.y()));
         y <= std::min<double>(high.y(), static_cast<double>(light_.rows() - 1)); ++y)
      for (int x = std::max(0, static_cast<int>(low.x()));
           x <= std::min<double>(high.x(), static_cast<double>(light_.cols() - 1)); ++x) {
        const Eigen::Vector2d p(x, y);
        const double along = std::clamp((p - a).dot(b - a) / length, 0.0, 1.0);
        cover(light_(y, x), static_cast<float>(filming_.bar),
              share_of(half - (p - a - along * (b - a)).norm(), filming_.blur_px));
      }
  }

 private:
  struct Spot {
    Eigen::Vector2d place;
    double scale;  // m/px
    Eigen::Matrix2d slope;
  };

  /// Of one pixel: its middle is mapped to the plane of motion as the lens has it, samples around it by the slope at
  /// the disc, since what that differs by across a disc only softens its edge a little otherwise.
  float share(const std::vector<Spot>& spots, int x, int y, double radius) const {
    const Eigen::Vector2d middle(x, y), point = point_of(filming_.view, middle);
    bool near = false, within = true;
    for (const Spot& s : spots) {
      const double inside = (radius - (point - s.place).norm()) / s.scale;
      near = near || inside > -reach_of(filming_.blur_px);
      within = within && inside > reach_of(filming_.blur_px);
    }
    if (!near) return 0;
    if (within) return 1;
    float sum = 0;
    const int across = samples_across(filming_.blur_px);
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < across; ++j) {
        const Eigen::Vector2d off((i + 0.5) / across - 0.5, (j + 0.5) / across - 0.5);
        for (const Spot& s : spots)
          sum += share_of((radius - (point + s.slope * off - s.place).norm()) / s.scale, filming_.blur_px);
      }
    return sum / static_cast<float>(across * across * static_cast<int>(spots.size()));
  }

  const Filming& filming_;
  Light& light_;
};

/// The places of each marker over the exposure, by the midpoint rule in steps of a quarter of a pixel, 32 at the most.
std::vector<std::vector<Eigen::Vector2d>> places_in_exposure(const Filming& filming, const Places& places,
                                                             double time) {
  const auto begin = places(time - filming.exposure_s / 2), end = places(time + filming.exposure_s / 2);
  double farthest = 0;
  for (std::size_t k = 0; k < begin.size() && filming.exposure_s > 0; ++k)
    farthest = std::max(farthest, (pixel_of(filming.view, end[k]) - pixel_of(filming.view, begin[k])).norm());
  const int steps = std::clamp(static_cast<int>(std::ceil(4 * farthest)), 1, 32);
  std::vector<std::vector<Eigen::Vector2d>> out(begin.size());
  for (int i = 0; i < steps; ++i) {
    const auto now = places(time + filming.exposure_s * ((i + 0.5) / steps - 0.5));
    for (std::size_t k = 0; k < now.size(); ++k) out[k].push_back(now[k]);
  }
  return out;
}

/// A million normal numbers, entered at another place for each row of each frame: noise of films takes more of them
/// than there is time to draw.
const std::vector<float>& normals() {
  static const std::vector<float> all = [] {
    constexpr std::size_t count = 1 << 20;
    std::vector<float> out(count);
    const hydro::RandomStream random(0, 4242);
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(random.normal(i));
    return out;
  }();
  return all;
}

enum Stream : std::uint64_t { rows_of_noise = 9001, flicker = 9002, losses = 9003 };

}  // namespace

Light light_of(const Filming& filming, const Places& places, double time_s) {  // (V15)
  hydro::require(
      (filming.size.array() > 0).all() && (filming.disc_radius > 0 || !filming.patterns.empty()) &&
          filming.exposure_s >= 0,
      "a film needs a size and a radius of its discs that are positive, and an exposure that is not negative");
  Light out = Light::Constant(filming.size.y(), filming.size.x(), static_cast<float>(filming.background));
  Drawing frame(filming, out);
  const auto middle = places(time_s);
  if (filming.bar_width > 0)
    for (const auto& [a, b] : filming.bars) frame.add_bar(middle.at(a), middle.at(b));
  const auto moving = places_in_exposure(filming, places, time_s);
  if (!filming.patterns.empty()) {
    for (std::size_t k = 0; k < moving.size(); ++k) frame.add_pattern(moving[k], filming.patterns.at(k), filming.cell);
    return out;
  }
  for (const auto& one : moving)
    if (filming.sticker_radius > 0) frame.add_disc(one, filming.sticker_radius, filming.sticker);
  for (const auto& one : moving) frame.add_disc(one, filming.disc_radius, filming.disc);
  return out;
}

Picture exposed(const Filming& filming, const Light& light, std::uint64_t frame) {
  Picture out(static_cast<int>(light.cols()), static_cast<int>(light.rows()));
  const std::vector<float>& table = normals();
  const hydro::RandomStream rows(filming.seed, rows_of_noise);
  const double of_frame = 1 + filming.flicker * hydro::RandomStream(filming.seed, flicker).normal(frame);
  const std::size_t mask = table.size() - 1;
  const auto noise = static_cast<float>(filming.noise);
  std::vector<float> brightness(static_cast<std::size_t>(out.width));
  for (int x = 0; x < out.width; ++x)
    brightness[static_cast<std::size_t>(x)] =
        static_cast<float>(of_frame * (1 - filming.fall_of_light * x / std::max(1, out.width - 1)));
  for (int y = 0; y < out.height; ++y) {
    const auto row = static_cast<std::uint64_t>(y) + frame * static_cast<std::uint64_t>(out.height);
    const auto begin = static_cast<std::size_t>(rows.uniform(row) * static_cast<double>(table.size()));
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < out.width; ++x) {
      const float level = brightness[static_cast<std::size_t>(x)] * light(y, x) +
                          noise * table[(begin + static_cast<std::size_t>(x)) & mask];
      to[x] = static_cast<std::uint8_t>(std::clamp(level + 0.5f, 0.0f, 255.0f));
    }
  }
  return out;
}

bool is_lost(const Filming& filming, std::uint64_t frame) {
  return hydro::RandomStream(filming.seed, losses).uniform(frame) < filming.lost;
}

namespace {

/// +1 over squares of even number and −1 over the others, with edges as soft as a sample is wide: samples on a grid
/// alone would shift edges that run along it by an eighth of a pixel.
double square_wave(double at, double width) {
  const double edge = std::round(at), side = std::clamp(2 * (at - edge) / width, -1.0, 1.0);
  return std::fmod(edge, 2) == 0 ? side : -side;
}

/// Which pixels a board may cover: those around its outline, which the lens bends between its corners.
struct Box {
  Eigen::Array2i from, to;  // both counted
};
Box box_of(const Board& board, const View& view, const Eigen::Vector2i& size) {
  constexpr int pieces = 16;
  constexpr double margin = 4;  // px: of the bend between two points, and of the blur
  const Eigen::Array2d low(-1, -1), side(board.columns + 1, board.rows + 1);
  Eigen::Array2d least = Eigen::Array2d::Constant(1e9), most = -least;
  for (int i = 0; i < pieces; ++i)
    for (const Eigen::Array2d& at : {Eigen::Array2d(i, 0), Eigen::Array2d(pieces, i),
                                     Eigen::Array2d(pieces - i, pieces), Eigen::Array2d(0, pieces - i)}) {
      const Eigen::Array2d corner = board.square * (low + side * at / pieces);
      const Eigen::Array2d pixel = pixel_of(view, Eigen::Vector2d(corner.x(), -corner.y()));
      least = least.min(pixel);
      most = most.max(pixel);
    }
  const Eigen::Array2i last = size.array() - 1;
  return {(least - margin).max(0).min(last.cast<double>()).cast<int>(),
          (most + margin).max(0).min(last.cast<double>()).cast<int>()};
}

}  // namespace

Light light_of_board(const Filming& filming, const Board& board, const PlanePose& pose) {
  hydro::require(filming.view.lens.has_value(), "a board is seen through a lens, which this film has not");
  constexpr double black = 25, white = 230, wall = 180;
  View view{.lens = filming.view.lens, .pose = pose};
  // Axes of the board: y down, counted from its first inner corner, which the pivot is to be.
  view.pivot = pixel_of(*view.lens, Eigen::Vector2d(pose.translation.head<2>() / pose.translation.z()));
  Light out = Light::Constant(filming.size.y(), filming.size.x(), static_cast<float>(wall));
  constexpr int across = 4;
  const Box box = box_of(board, view, filming.size);
  const auto squares = [&](int x, int y) -> Eigen::Vector2d { return point_of(view, {x, y}) / board.square; };
  std::vector<Eigen::Vector2d> row, below;
  const auto fill = [&](int y, std::vector<Eigen::Vector2d>& points) {
    points.clear();
    for (int x = box.from.x(); x <= box.to.x() + 1; ++x) points.push_back(squares(x, y));
  };
  fill(box.from.y(), below);
  for (int y = box.from.y(); y <= box.to.y(); ++y) {
    std::swap(row, below);
    fill(y + 1, below);
    for (int x = box.from.x(); x <= box.to.x(); ++x) {
      const auto k = static_cast<std::size_t>(x - box.from.x());
      const Eigen::Vector2d middle = row[k], right = (row[k + 1] - middle) / 2, down = (below[k] - middle) / 2;
      // A ramp of width w has the variance w²/12, as blur of w/3.46.
      const Eigen::Vector2d sample = (2.0 / across + 2 * 3.46 * filming.blur_px) * (right.cwiseAbs() + down.cwiseAbs());
      double sum = 0;
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
          const Eigen::Vector2d at =
              middle + (2 * (i + 0.5) / across - 1) * right + (2 * (j + 0.5) / across - 1) * down;
          const bool outside = at.x() < -1 || -at.y() < -1 || at.x() > board.columns || -at.y() > board.rows;
          const double wave = square_wave(at.x(), sample.x()) * square_wave(-at.y(), sample.y());
          sum += outside ? wall : (black + white) / 2 - (white - black) / 2 * wave;
        }
      out(y, x) = static_cast<float>(sum / (across * across));
    }
  }
  return out;
}

}  // namespace fit::camera
