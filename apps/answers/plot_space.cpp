#include "answers/plot_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "answers/plot_style.hpp"
#include "hydro/base/error.hpp"

namespace froude::plot {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double page_margin = 92, page_head = 44;  // px

/// The box in data: its middle and its half edges, and what of the data makes half of the unit box.
struct Box {
  Vector3d middle, half, per_half;

  Vector3d in_box(const Vector3d& data) const { return 0.5 * (data - middle).cwiseQuotient(per_half); }
  /// Of a corner, or a point on an edge: signs.
  Vector3d at(const Vector3d& signs) const { return middle + signs.cwiseProduct(half); }
};

Box box_of(const Space& space) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector3d low = Vector3d::Constant(infinity), high = -low;
  for (const SpacePath& p : space.paths) {
    hydro::ensure(p.x.size() == p.y.size() && p.x.size() == p.z.size(), "plot: a path has axes of unequal length");
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      const Vector3d at(p.x[i], p.y[i], p.z[i]);
      if (at.allFinite()) low = low.cwiseMin(at), high = high.cwiseMax(at);
    }
  }
  if (!low.allFinite()) low = -Vector3d::Ones(), high = Vector3d::Ones();
  Box box{(low + high) / 2, 0.525 * (high - low), {}};
  const double widest = box.half.maxCoeff();
  // A level path still has a box: a twentieth of its width, or a unit where there is nothing but a point.
  box.half = box.half.cwiseMax(widest > 0 ? 0.05 * widest : 0.5);
  const bool alike = space.x.unit == space.y.unit && space.x.unit == space.z.unit;
  box.per_half = alike ? Vector3d(Vector3d::Constant(box.half.maxCoeff())) : box.half;
  return box;
}

/// The box on the page.
class Page {
 public:
  explicit Page(const Space& space) : eye_(space.eye), box_(box_of(space)) {
    Vector2d low = Vector2d::Constant(1e9), high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector2d at = seen(box_.in_box(box_.at(signs_of(corner))), eye_);
      low = low.cwiseMin(at), high = high.cwiseMax(at);
    }
    const Vector2d room(space.width - 2 * page_margin, space.height - page_head - 2 * page_margin);
    scale_ = room.cwiseQuotient(high - low).minCoeff();
    shift_ = Vector2d(space.width, space.height + page_head) / 2 - scale_ * flipped((low + high) / 2);
  }
  const Box& box() const { return box_; }
  Vector2d px(const Vector3d& data) const { return shift_ + scale_ * flipped(seen(box_.in_box(data), eye_)); }
  /// Where the eye is, seen from the middle: −1 or 1 along each axis.
  Vector3d near_side() const {
    return {side(std::cos(eye_.azimuth_rad)), side(std::sin(eye_.azimuth_rad)), side(std::sin(eye_.elevation_rad))};
  }
  static Vector3d signs_of(int corner) {
    return {corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0};
  }

 private:
  static Vector2d flipped(const Vector2d& up) { return {up.x(), -up.y()}; }
  static double side(double component) { return component < 0 ? -1 : 1; }
  Eye eye_;
  Box box_;
  double scale_;
  Vector2d shift_;
};

void draw_line(Buffer& out, const char* style, const Vector2d& a, const Vector2d& b) {
  put(out, "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", style, a.x(), a.y(), b.x(),
      b.y());
}

std::vector<double> ticks_along(const Box& box, Eigen::Index axis) {
  return ticks(box.middle[axis] - box.half[axis], box.middle[axis] + box.half[axis], Scale::linear, 5);
}

/// The three faces behind the paths, with a grid.
void draw_walls(Buffer& out, const Page& page) {
  const Vector3d far = -page.near_side();
  for (Eigen::Index normal = 0; normal < 3; ++normal)
    for (Eigen::Index along = 0; along < 3; ++along) {
      if (along == normal) continue;
      const Eigen::Index across = 3 - normal - along;
      Vector3d a = page.box().at(far), b = a;
      a[across] = page.box().middle[across] - page.box().half[across];
      b[across] = page.box().middle[across] + page.box().half[across];
      for (const double t : ticks_along(page.box(), along)) {
        a[along] = b[along] = t;
        draw_line(out, "grid", page.px(a), page.px(b));
      }
      for (const double end : {-1.0, 1.0}) {
        a[along] = b[along] = page.box().middle[along] + end * page.box().half[along];
        draw_line(out, "frame", page.px(a), page.px(b));
      }
    }
}

/// Numbers and a name along one edge, on the side that is turned away from the middle of the box.
void draw_axis(Buffer& out, const Page& page, Eigen::Index axis, Vector3d edge, const Axis& words) {
  const Vector2d middle = page.px(page.box().middle);
  edge[axis] = 0;
  const Vector3d on_edge = page.box().at(edge);
  Vector3d a = on_edge, b = on_edge;
  a[axis] -= page.box().half[axis];
  b[axis] += page.box().half[axis];
  const Vector2d along = (page.px(b) - page.px(a)).normalized();
  Vector2d outward(-along.y(), along.x());
  if (outward.dot(page.px(on_edge) - middle) < 0) outward = -outward;
  const char* anchor = std::abs(outward.x()) < 0.4 ? "middle" : outward.x() > 0 ? "start" : "end";
  const auto text = [&](const char* style, const Vector2d& at, const std::string& what, const char* where) {
    put(out, "<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", style, at.x(), at.y() + 4.5,
        where, what);
  };
  for (const double t : ticks_along(page.box(), axis)) {
    Vector3d at = on_edge;
    at[axis] = t;
    const Vector2d p = page.px(at);
    draw_line(out, "frame", p, p + 5 * outward);
    text("tick", p + 12 * outward, tick_label(t), anchor);
  }
  const double away = std::abs(outward.x()) < 0.4 ? 34 : 62;
  text("label", page.px(on_edge) + away * outward, axis_text(words), anchor);
}

void draw_axes(Buffer& out, const Page& page, const Space& space) {
  const Vector3d near = page.near_side(), low(0, 0, -near.z());
  draw_axis(out, page, 0, low + near.y() * Vector3d::UnitY(), space.x);
  draw_axis(out, page, 1, low + near.x() * Vector3d::UnitX(), space.y);
  const Vector3d one(near.x(), -near.y(), 0), other = -one;  // the outlines of the box
  const bool first = page.px(page.box().at(one)).x() < page.px(page.box().at(other)).x();
  draw_axis(out, page, 2, first ? one : other, space.z);
}

/// Points closer together than a fifth of a pixel are one.
std::string path_of(const SpacePath& p, const Page& page) {
  constexpr double apart = 0.2;
  Buffer out;
  bool pen_down = false;
  Vector2d last(0, 0);
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const Vector3d at(p.x[i], p.y[i], p.z[i]);
    if (!at.allFinite()) {
      pen_down = false;
      continue;
    }
    const Vector2d px = page.px(at);
    if (pen_down && i + 1 < p.x.size() && (px - last).norm() < apart) continue;
    put(out, "{}{:.1f} {:.1f}", pen_down ? "L" : "M", px.x(), px.y());
    pen_down = true;
    last = px;
  }
  return fmt::to_string(out);
}

}  // namespace

Vector2d seen(const Vector3d& point, const Eye& eye) {
  const double ca = std::cos(eye.azimuth_rad), sa = std::sin(eye.azimuth_rad), ce = std::cos(eye.elevation_rad),
               se = std::sin(eye.elevation_rad), distance = eye_distance * std::sqrt(0.75);
  const Vector3d towards(ce * ca, ce * sa, se), right(-sa, ca, 0), up(-se * ca, -se * sa, ce);
  const double size = distance / (distance - point.dot(towards));
  return size * Vector2d(point.dot(right), point.dot(up));
}

std::string svg(const Space& space) {
  const Page page(space);
  Buffer out;
  begin_page(out, space.width, space.height, space.width / 2.0, space.title);
  draw_walls(out, page);
  for (std::size_t i = 0; i < space.paths.size(); ++i)
    put(out, "<path class=\"curve\" stroke=\"{}\"{} d=\"{}\"/>\n", colours[i % colours.size()],
        i >= colours.size() ? " stroke-dasharray=\"6 4\"" : "", path_of(space.paths[i], page));
  draw_axes(out, page, space);
  double y = page_head + 12;
  for (std::size_t i = 0; i < space.paths.size(); ++i) {
    if (space.paths[i].name.empty()) continue;
    put(out, "<line x1=\"16\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{1:.1f}\" stroke=\"{2}\" stroke-width=\"2\"/>\n",
        16 + legend_swatch - 6, y - 4, colours[i % colours.size()]);
    put(out, "<text class=\"legend\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", 16 + legend_swatch, y,
        escaped(space.paths[i].name));
    y += legend_row;
  }
  put(out, "</svg>\n");
  return fmt::to_string(out);
}

}  // namespace froude::plot
