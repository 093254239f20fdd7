#include "fit/camera/detect.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

/// Pixels of a row that are bright, from `begin` to before `end`, and the place they belong to.
struct BrightRun {
  int y, begin, end, place;
};

/// Moments of the pixels of one bright place.
struct BrightPlace {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  int left = std::numeric_limits<int>::max(), right = -1, top = std::numeric_limits<int>::max(), bottom = -1;

  void add(const BrightRun& r) {
    const double n = r.end - r.begin, first = r.begin, last = r.end - 1, mean = (first + last) / 2;
    area += n;
    x += n * mean;
    y += n * r.y;
    xx += n * (mean * mean + (n * n - 1) / 12);
    xy += n * mean * r.y;
    yy += n * static_cast<double>(r.y) * r.y;
    left = std::min(left, r.begin), right = std::max(right, r.end - 1);
    top = std::min(top, r.y), bottom = std::max(bottom, r.y);
  }
  Eigen::Vector2d centre() const { return {x / area, y / area}; }
  /// Long and short half axis of the ellipse with these moments; a pixel has 1/12 of its own.
  std::array<double, 2> axes() const {
    const Eigen::Vector2d c = centre();
    const double a = xx / area - c.x() * c.x() + 1.0 / 12, b = yy / area - c.y() * c.y() + 1.0 / 12,
                 m = xy / area - c.x() * c.y(), middle = (a + b) / 2, off = std::hypot((a - b) / 2, m);
    return {2 * std::sqrt(middle + off), 2 * std::sqrt(std::max(0.0, middle - off))};
  }
};

class Detector {
 public:
  Detector(const Picture& picture, const DetectOptions& options)
      : picture_(picture), options_(options), tile_(std::max(32, static_cast<int>(std::ceil(4 * options.largest_px)))) {
    hydro::require(picture.width > 0 && picture.height > 0, "a picture of {} x {} pixels shows nothing", picture.width,
                   picture.height);
    hydro::require(options.smallest_px >= 1.5 && options.largest_px > options.smallest_px,
                   "radii of discs must grow from 1.5 px on, got {} to {} px", options.smallest_px, options.largest_px);
    hydro::require(options.contrast > 1 && options.contrast < 255 && options.roundness > 0 && options.roundness <= 1,
                   "a contrast lies between 1 and 255 levels and a roundness between 0 and 1, got {} and {}",
                   options.contrast, options.roundness);
  }

  Detection all() {
    find_levels();
    find_runs();
    places_.resize(parent_.size());
    for (const BrightRun& r : runs_) places_[root(r.place)].add(r);
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (places_[i].area > 0) look_at(places_[i], static_cast<int>(i));
    return std::move(out_);
  }

 private:
  double grey(int x, int y) const { return options_.dark ? 255 - picture_.at(x, y) : picture_.at(x, y); }
  int tiles_across() const { return (picture_.width + tile_ - 1) / tile_; }

  /// Of each tile the level above which a pixel is bright: the median of every second pixel, and half the contrast.
  void find_levels() {
    for (int top = 0; top < picture_.height; top += tile_)
      for (int left = 0; left < picture_.width; left += tile_) {
        std::array<int, 256> count{};
        int all = 0;
        for (int y = top; y < std::min(top + tile_, picture_.height); y += 2)
          for (int x = left; x < std::min(left + tile_, picture_.width); x += 2, ++all) ++count[picture_.row(y)[x]];
        int median = 0;
        for (int below = count[0]; 2 * below < all; below += count[static_cast<std::size_t>(median)]) ++median;
        const double half = options_.contrast / 2;
        levels_.push_back(options_.dark ? median - half : median + half);
      }
  }

  std::size_t root(int place) {
    auto at = static_cast<std::size_t>(place);
    while (parent_[at] != at) at = parent_[at] = parent_[parent_[at]];
    return at;
  }

  /// Bright pixels as runs of rows; runs that touch, corners too, are one place.
  void find_runs() {
    std::size_t before = 0, after = 0;  // runs of the row above
    for (int y = 0; y < picture_.height; ++y) {
      const std::size_t first = runs_.size();
      find_runs_of_row(y);
      std::size_t above = before;
      for (std::size_t k = first; k < runs_.size(); ++k) {
        while (above < after && runs_[above].end < runs_[k].begin) ++above;
        for (std::size_t j = above; j < after && runs_[j].begin <= runs_[k].end; ++j)
          parent_[root(runs_[j].place)] = root(runs_[k].place);
      }
      before = first, after = runs_.size();
    }
  }

  void find_runs_of_row(int y) {
    const std::uint8_t* row = picture_.row(y);
    const double* level = levels_.data() + static_cast<std::ptrdiff_t>(y / tile_) * tiles_across();
    bool inside = false;
    for (int left = 0, k = 0; left < picture_.width; left += tile_, ++k) {
      const int right = std::min(left + tile_, picture_.width);
      // Of whole numbers: above a level of 80.5 is 81 and more.
      const int bright =
          options_.dark ? static_cast<int>(std::ceil(level[k])) - 1 : static_cast<int>(std::floor(level[k])) + 1;
      for (int x = left; x < right; ++x) {
        const bool now = options_.dark ? row[x] <= bright : row[x] >= bright;
        if (now == inside) continue;
        if (now) {
          runs_.push_back({y, x, x, static_cast<int>(parent_.size())});
          parent_.push_back(parent_.size());
        } else {
          runs_.back().end = x;
        }
        inside = now;
      }
    }
    if (inside) runs_.back().end = picture_.width;
  }

  void look_at(const BrightPlace& place, int index) {
    const double radius = std::sqrt(place.area / std::numbers::pi);
    const auto [long_axis, short_axis] = place.axes();
    // Bright pixels reach half a blur beyond the edge or not quite to it: what is far off is left out at once.
    if (radius < options_.smallest_px - 1) return void(++out_.small);
    if (std::min(radius, short_axis) > options_.largest_px + 2) return void(++out_.large);
    if (short_axis < options_.roundness * long_axis) return void(++out_.drawn_out);
    measure(place, index, radius, long_axis, short_axis / long_axis);
  }

  /// (V13) A plane through the ring around the disc, and the centroid of what is above it.
  void measure(const BrightPlace& place, int index, double radius, double long_axis, double ratio) {
    const double inner = long_axis + 2.5, outer = inner + std::max(3.0, 0.3 * radius);
    Eigen::Vector2d centre = place.centre();
    if (centre.x() - outer < 0 || centre.y() - outer < 0 || centre.x() + outer > picture_.width - 1 ||
        centre.y() + outer > picture_.height - 1 || has_neighbour(place, index, outer))
      return void(++out_.at_edge);
    Disc disc{.centre = {}, .radius_px = radius, .contrast = 0, .axis_ratio = ratio};
    for (int round = 0; round < 3; ++round)
      if (!centroid(centre, inner, outer, disc)) return void(++out_.small);
    disc.centre.at = centre;
    if (disc.contrast < options_.contrast || disc.radius_px < options_.smallest_px) return void(++out_.small);
    // A disc that is drawn out by its motion is larger by that, and its short axis tells its radius.
    if (disc.radius_px * std::sqrt(ratio) > options_.largest_px) return void(++out_.large);
    out_.discs.push_back(disc);
  }

  /// Whether another bright place reaches into the ring.
  bool has_neighbour(const BrightPlace& place, int index, double outer) {
    const Eigen::Vector2d c = place.centre();
    const auto first = std::lower_bound(runs_.begin(), runs_.end(), static_cast<int>(c.y() - outer),
                                        [](const BrightRun& r, int y) { return r.y < y; });
    for (auto r = first; r != runs_.end() && r->y <= c.y() + outer; ++r) {
      if (root(r->place) == static_cast<std::size_t>(index)) continue;
      if (places_[root(r->place)].area < 0.1 * place.area) continue;  // noise, of which the plane takes no notice
      const double dx = std::clamp(c.x(), static_cast<double>(r->begin), static_cast<double>(r->end - 1)) - c.x();
      if (std::hypot(dx, r->y - c.y()) <= outer) return true;
    }
    return false;
  }

  /// Calls `use` with each pixel nearer than `outer`: its offset from the centre, its grey, whether it lies in the
  /// disc.
  template <class Use>
  void each_pixel(const Eigen::Vector2d& centre, double inner, double outer, Use use) const {
    const int top = std::max(0, static_cast<int>(std::ceil(centre.y() - outer))),
              bottom = std::min(picture_.height - 1, static_cast<int>(std::floor(centre.y() + outer)));
    for (int y = top; y <= bottom; ++y) {
      const double dy = y - centre.y(), across = std::sqrt(std::max(0.0, outer * outer - dy * dy));
      const int left = std::max(0, static_cast<int>(std::ceil(centre.x() - across))),
                right = std::min(picture_.width - 1, static_cast<int>(std::floor(centre.x() + across)));
      for (int x = left; x <= right; ++x) {
        const Eigen::Vector2d d(x - centre.x(), dy);
        use(d, grey(x, y), d.squaredNorm() <= inner * inner);
      }
    }
  }

  /// The plane through the ring, without what lies further off it than three deviations: edges of bars and stickers.
  struct Surroundings {
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    double noise = std::numeric_limits<double>::infinity(), pixels = 0;
  };
  Surroundings surroundings(const Eigen::Vector2d& centre, double inner, double outer) const {
    constexpr double kept = 3, share_of_variance = 0.9733;  // of normal noise within three deviations
    constexpr int rounds = 6;
    Surroundings out = levels_around(centre, inner, outer);
    for (int round = 0; round < rounds && out.pixels > 0; ++round) {
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      double squares = 0, ring = 0;
      each_pixel(centre, inner, outer, [&](const Eigen::Vector2d& d, double g, bool in_disc) {
        const Eigen::Vector3d basis(1, d.x(), d.y());
        if (in_disc || std::abs(g - out.plane.dot(basis)) > kept * std::sqrt(out.noise)) return;
        normal += basis * basis.transpose();
        right += g * basis;
        squares += g * g;
        ++ring;
      });
      if (ring < 12) return {};
      const bool settled = ring == out.pixels;
      out.inverse = normal.inverse();
      out.plane = out.inverse * right;
      out.pixels = ring;
      // What rounding to whole levels leaves cannot be less than its own 1/12.
      out.noise = std::max(1.0 / 12, (squares - right.dot(out.plane)) / (ring - 3) / share_of_variance);
      if (settled) break;
    }
    return out;
  }

  /// Where that begins: the median of the ring and its median deviation, which bear a third of pixels that are no part
  /// of the sticker; a level at least, since light that falls off is no noise.
  Surroundings levels_around(const Eigen::Vector2d& centre, double inner, double outer) const {
    std::vector<double> levels;
    each_pixel(centre, inner, outer, [&](const Eigen::Vector2d&, double g, bool in_disc) {
      if (!in_disc) levels.push_back(g);
    });
    if (levels.size() < 12) return {};
    const auto median = [&] {
      std::nth_element(levels.begin(), levels.begin() + std::ssize(levels) / 2, levels.end());
      return levels[levels.size() / 2];
    };
    Surroundings out;
    out.pixels = static_cast<double>(levels.size()) + 1;  // another number than any round has
    out.plane[0] = median();
    for (double& level : levels) level = std::abs(level - out.plane[0]);
    out.noise = std::max(1.0, std::pow(1.4826 * median(), 2));
    return out;
  }

  /// One round: `centre` moves to the centroid. False where there is no light.
  bool centroid(Eigen::Vector2d& centre, double inner, double outer, Disc& disc) const {
    const auto [plane, inverse, noise, ring] = surroundings(centre, inner, outer);
    if (ring == 0) return false;
    double light = 0, middle = 0, squares = 0, pixels = 0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    each_pixel(centre, inner, outer, [&](const Eigen::Vector2d& d, double g, bool in_disc) {
      if (!in_disc) return;
      const double above = g - plane.dot(Eigen::Vector3d(1, d.x(), d.y()));
      light += above;
      moment += above * d;
      if (d.squaredNorm() < disc.radius_px * disc.radius_px / 4) middle += above, squares += above * above, ++pixels;
    });
    if (!(light > 0) || !(middle > 0)) return false;
    const Eigen::Vector2d move = moment / light;
    disc.contrast = middle / pixels;
    disc.radius_px = std::sqrt(light / disc.contrast / std::numbers::pi);
    // Black surroundings hide noise below zero: the middle of the disc tells it where it has pixels enough.
    const double own = pixels >= 20 ? (squares - middle * middle / pixels) / (pixels - 1) : 0;
    disc.centre.covariance = errors(centre, move, inner, outer, inverse) * (std::max(noise, own) / (light * light));
    centre += move;
    return true;
  }

  /// (V14) Of the centroid, over noise²/light²: pixels of the disc themselves, and through the plane those of the ring.
  Eigen::Matrix2d errors(const Eigen::Vector2d& centre, const Eigen::Vector2d& move, double inner, double outer,
                         const Eigen::Matrix3d& plane) const {
    Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 2, 3> through = Eigen::Matrix<double, 2, 3>::Zero();
    each_pixel(centre, inner, outer, [&](const Eigen::Vector2d& d, double, bool in_disc) {
      if (!in_disc) return;
      const Eigen::Vector2d from = d - move;
      own += from * from.transpose();
      through += from * Eigen::RowVector3d(1, d.x(), d.y());
    });
    return own + through * plane * through.transpose();
  }

  const Picture& picture_;
  const DetectOptions& options_;
  int tile_;
  std::vector<double> levels_;  // of tiles, row after row
  std::vector<BrightRun> runs_;
  std::vector<std::size_t> parent_;
  std::vector<BrightPlace> places_;
  Detection out_;
};

}  // namespace

Detection detect(const Picture& picture, const DetectOptions& options) { return Detector(picture, options).all(); }

}  // namespace fit::camera
