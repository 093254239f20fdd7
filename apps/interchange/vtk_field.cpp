#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "hydro/base/error.hpp"
#include "interchange/collection.hpp"
#include "interchange/content.hpp"

namespace froude::interchange {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Amplitudes = std::vector<std::complex<double>>;

/// Re(a e^{iωt}) of each, at a share of the period.
std::vector<double> at_phase(const Amplitudes& of, double share) {
  const std::complex<double> turn = std::polar(1.0, 2 * std::numbers::pi * share);
  std::vector<double> out;
  for (const auto& a : of) out.push_back((a * turn).real());
  return out;
}

std::vector<double> moduli(const Amplitudes& of) {
  std::vector<double> out;
  for (const auto& a : of) out.push_back(std::abs(a));
  return out;
}

class FieldSurface : public Part {
 public:
  FieldSurface(const Content& content, std::size_t instants)
      : x_(content.array("x").values),
        y_(content.array("y").values),
        elevation_(content.array("elevation").amplitudes),
        instants_(static_cast<double>(instants)) {}
  std::string name() const override { return "surface"; }
  Grid at(std::size_t frame) const override {
    Grid out{.cell = Grid::Cell::quadrangle, .points = {}, .corners = {}};
    std::vector<double> elevation = at_phase(elevation_, static_cast<double>(frame) / instants_);
    for (std::size_t p = 0; p < elevation.size(); ++p)
      out.points.emplace_back(x_[p % x_.size()], y_[p / x_.size()], is_told(p) ? elevation[p] : 0);
    for (std::size_t j = 0; j + 1 < y_.size(); ++j)
      for (std::size_t i = 0; i + 1 < x_.size(); ++i) add_cell(j * x_.size() + i, out);
    out.of_points = {{"elevation", std::move(elevation)}, {"amplitude", moduli(elevation_)}};
    return out;
  }

 private:
  bool is_told(std::size_t point) const { return std::isfinite(elevation_[point].real()); }
  void add_cell(std::size_t corner, Grid& out) const {
    const std::array<std::size_t, 4> around{corner, corner + 1, corner + 1 + x_.size(), corner + x_.size()};
    for (const std::size_t p : around)
      if (!is_told(p)) return;
    for (const std::size_t p : around) out.corners.push_back(static_cast<std::int32_t>(p));
  }

  std::vector<double> x_, y_;
  Amplitudes elevation_;
  double instants_;
};

/// Panels as fans of triangles, each with the values of its panel.
class FieldHulls : public Part {
 public:
  FieldHulls(const Content& content, std::size_t instants)
      : content_(content), instants_(static_cast<double>(instants)) {
    const Array& corner = content.array("panel_corner");
    const std::size_t most = corner.shape[1];
    for (std::size_t i = 0; i < corner.shape[0]; ++i) {
      const auto first = static_cast<std::int32_t>(points_.size());
      for (std::size_t c = 0; c < most; ++c) {
        const Vector3d at(&corner.values[3 * (i * most + c)]);
        if (at.allFinite()) points_.push_back(at);
      }
      for (auto next = first + 1; next + 1 < static_cast<std::int32_t>(points_.size()); ++next) {
        corners_.insert(corners_.end(), {first, next, next + 1});
        panel_.push_back(i);
      }
    }
  }
  std::string name() const override { return "hulls"; }
  std::vector<std::string> names() const override { return content_.array("hull").texts; }
  Grid at(std::size_t frame) const override {
    const double share = static_cast<double>(frame) / instants_;
    const Amplitudes &dynamic = content_.array("pressure").amplitudes,
                     &hydrostatic = content_.array("hydrostatic_pressure").amplitudes;
    return {.cell = Grid::Cell::triangle,
            .points = points_,
            .corners = corners_,
            .of_cells = {{"body", of_triangles(content_.array("panel_body").values)},
                         {"pressure", of_triangles(at_phase(dynamic, share))},
                         {"amplitude", of_triangles(moduli(dynamic))},
                         {"hydrostatic_pressure", of_triangles(at_phase(hydrostatic, share))}}};
  }

 private:
  std::vector<double> of_triangles(const std::vector<double>& of_panels) const {
    std::vector<double> out;
    for (const std::size_t i : panel_) out.push_back(of_panels[i]);
    return out;
  }

  const Content& content_;
  double instants_;
  std::vector<Vector3d> points_;
  std::vector<std::int32_t> corners_;
  std::vector<std::size_t> panel_;  // of each triangle
};

bool has(const Content& content, const std::string& name) {
  return std::any_of(content.arrays.begin(), content.arrays.end(), [&](const Array& a) { return a.name == name; });
}

}  // namespace

VtkFiles write_field_vtk(const fs::path& collection, const fs::path& result, std::size_t instants) {
  const Content content = read_content(result);
  if (content.kind != "froude field" || !has(content, "elevation"))
    throw hydro::InputError("not a result of `froude field`", {.file = result.string()},
                            "give the .h5 file that `froude field` wrote");
  const double period = 2 * std::numbers::pi / content.array("omega").values.front();
  std::vector<double> time;
  for (std::size_t f = 0; f < instants; ++f)
    time.push_back(period * static_cast<double>(f) / static_cast<double>(instants));
  const FieldSurface surface(content, instants);
  std::vector<const Part*> parts{&surface};
  std::optional<FieldHulls> hulls;
  if (has(content, "pressure")) parts.push_back(&hulls.emplace(content, instants));
  return write_collection(collection, parts, time);
}

}  // namespace froude::interchange
