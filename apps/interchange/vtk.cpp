#include "interchange/vtk.hpp"

#include <cmath>
#include <complex>
#include <optional>

#include "hydro/base/error.hpp"
#include "interchange/collection.hpp"

namespace froude::interchange {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr int cells_along_a_side = 96;  // of the water, as reports have it

class Bodies : public Part {
 public:
  explicit Bodies(const view::View& v) : view_(v) {
    for (const view::Shapes& shapes : v.shapes()) {
      faces_.emplace_back();
      for (const view::Shape& shape : shapes.all) faces_.back().push_back(faces_of(shape));
    }
  }
  std::string name() const override { return "bodies"; }
  std::vector<std::string> names() const override {
    std::vector<std::string> out;
    for (const scene::Body& body : view_.scene().bodies) out.push_back(body.name);
    return out;
  }
  Grid at(std::size_t frame) const override {
    Grid out{.cell = Grid::Cell::triangle, .points = {}, .corners = {}};
    std::vector<double> number;
    for (std::size_t b = 0; b < faces_.size(); ++b)
      for (const Faces& faces : faces_[b]) {
        const auto first = static_cast<std::int32_t>(out.points.size());
        for (const Vector3d& p : faces.points) out.points.push_back(view_.motions()[b].poses[frame].of(p));
        for (const auto& triangle : faces.triangles) {
          for (const int corner : triangle) out.corners.push_back(first + corner);
          number.push_back(static_cast<double>(b + 1));
        }
      }
    out.of_cells.emplace_back("body", std::move(number));
    return out;
  }

 private:
  const view::View& view_;
  std::vector<std::vector<Faces>> faces_;  // of each shape of each body, from its origin
};

class Lines : public Part {
 public:
  explicit Lines(const view::View& v) : view_(v) {}
  std::string name() const override { return "lines"; }
  std::vector<std::string> names() const override {
    std::vector<std::string> out;
    for (const view::Line& line : view_.lines()) out.push_back(line.name);
    return out;
  }
  /// Pieces between neighbours whose places are known.
  Grid at(std::size_t frame) const override {
    Grid out{.cell = Grid::Cell::piece, .points = {}, .corners = {}};
    std::vector<double> number, tension;
    for (std::size_t k = 0; k < view_.lines().size(); ++k) {
      const view::Line& line = view_.lines()[k];
      bool follows = false;
      for (std::size_t i = 0; i < line.points; ++i) {
        const Vector3d place = line.place(i, frame);
        if (!place.allFinite()) {
          follows = false;
          continue;
        }
        const auto here = static_cast<std::int32_t>(out.points.size());
        out.points.push_back(place);
        if (follows) {
          out.corners.insert(out.corners.end(), {here - 1, here});
          number.push_back(static_cast<double>(k + 1));
          tension.push_back(line.tension(i - 1, frame));
        }
        follows = true;
      }
    }
    out.of_cells = {{"line", std::move(number)}, {"tension", std::move(tension)}};
    return out;
  }

 private:
  const view::View& view_;
};

/// ζ = r Σ a cos(ωt − k (x cos β + y sin β) + φ) on a square grid: the sum of products of a factor for each x, one for
/// each t and one for each y.
class Water : public Part {
 public:
  Water(const view::Surface& surface, const std::vector<double>& time, const Eigen::AlignedBox3d& around)
      : surface_(surface), time_(time) {
    const Vector3d size = around.sizes(), middle = around.center();
    const double side = 2.2 * std::max({size.x(), size.y(), 1.5 * size.z(), 4.0});
    x_ = Eigen::VectorXd::LinSpaced(cells_along_a_side + 1, middle.x() - side / 2, middle.x() + side / 2);
    y_ = Eigen::VectorXd::LinSpaced(cells_along_a_side + 1, middle.y() - side / 2, middle.y() + side / 2);
    const auto waves = static_cast<Eigen::Index>(surface.components.size());
    by_x_.resize(x_.size(), waves), by_y_.resize(waves, y_.size());
    for (Eigen::Index i = 0; i < waves; ++i) {
      const auto& w = surface.components[static_cast<std::size_t>(i)];
      for (Eigen::Index p = 0; p < x_.size(); ++p) by_x_(p, i) = std::polar(1.0, -w.k * std::cos(w.heading) * x_[p]);
      for (Eigen::Index p = 0; p < y_.size(); ++p) by_y_(i, p) = std::polar(1.0, -w.k * std::sin(w.heading) * y_[p]);
    }
  }
  std::string name() const override { return "surface"; }
  Grid at(std::size_t frame) const override {
    const double t = time_[frame];
    Eigen::VectorXcd by_t(by_x_.cols());
    for (Eigen::Index i = 0; i < by_t.size(); ++i) {
      const auto& w = surface_.components[static_cast<std::size_t>(i)];
      by_t[i] = std::polar(view::grown(t, surface_.ramp) * w.amplitude, w.omega * t + w.phase);
    }
    const Eigen::MatrixXd elevation = (by_x_ * by_t.asDiagonal() * by_y_).real();
    Grid out{.cell = Grid::Cell::quadrangle, .points = {}, .corners = {}};
    std::vector<double> zeta;
    for (Eigen::Index i = 0; i < x_.size(); ++i)
      for (Eigen::Index j = 0; j < y_.size(); ++j) {
        out.points.emplace_back(x_[i], y_[j], elevation(i, j));
        zeta.push_back(elevation(i, j));
      }
    const auto columns = static_cast<std::int32_t>(y_.size());
    for (std::int32_t i = 0; i < cells_along_a_side; ++i)
      for (std::int32_t j = 0; j < cells_along_a_side; ++j) {
        const std::int32_t here = i * columns + j;
        out.corners.insert(out.corners.end(), {here, here + columns, here + columns + 1, here + 1});
      }
    out.of_points.emplace_back("elevation", std::move(zeta));
    return out;
  }

 private:
  const view::Surface& surface_;
  const std::vector<double>& time_;
  Eigen::VectorXd x_, y_;
  Eigen::MatrixXcd by_x_, by_y_;
};

}  // namespace

VtkFiles write_vtk(const fs::path& collection, const view::View& v, const std::vector<double>& time) {
  hydro::ensure(time.size() == v.frames().count(), "write_vtk: one time a frame");
  const Bodies bodies(v);
  const Lines lines(v);
  std::vector<const Part*> parts;
  if (!v.scene().bodies.empty()) parts.push_back(&bodies);
  if (!v.lines().empty()) parts.push_back(&lines);
  std::optional<Water> water;
  if (v.surface()) {
    Eigen::AlignedBox3d around;
    for (const Part* part : {static_cast<const Part*>(&bodies), static_cast<const Part*>(&lines)})
      for (const Vector3d& p : part->at(0).points) around.extend(p);
    parts.push_back(&water.emplace(*v.surface(), time, around));
  }
  return write_collection(collection, parts, time);
}

}  // namespace froude::interchange
