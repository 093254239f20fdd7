#include "interchange/grid.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "answers/plot.hpp"
#include "hydro/base/base64.hpp"

namespace froude::interchange {
namespace {

using Eigen::Vector3d;

constexpr int sides = 48;  // of what is round: 0.2 % of the radius off the circle
constexpr int rings = 24;  // of a sphere

static_assert(std::endian::native == std::endian::little, "the files say that their numbers are little-endian");

/// Two directions across one, of length 1, that turn anticlockwise about it.
std::pair<Vector3d, Vector3d> across(const Vector3d& along) {
  const Vector3d u = along.unitOrthogonal();
  return {u, along.cross(u)};
}

void add_quadrangle(Faces& f, int a, int b, int c, int d) {
  f.triangles.push_back({a, b, c});
  f.triangles.push_back({a, c, d});
}

Faces faces_of_kind(const view::Cylinder& c) {
  Faces out;
  const Vector3d axis = c.to - c.from;
  const Vector3d along = axis.norm() > 0 ? Vector3d(axis.normalized()) : Vector3d::UnitZ();
  const auto [u, v] = across(along);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const Vector3d out_to = c.radius * (std::cos(angle) * u + std::sin(angle) * v);
    out.points.push_back(c.from + out_to);
    out.points.push_back(c.to + out_to);
  }
  out.points.push_back(c.from), out.points.push_back(c.to);
  for (int i = 0; i < sides; ++i) {
    const int low = 2 * i, next = 2 * ((i + 1) % sides);
    add_quadrangle(out, low, next, next + 1, low + 1);
    out.triangles.push_back({2 * sides, next, low});
    out.triangles.push_back({2 * sides + 1, low + 1, next + 1});
  }
  return out;
}

Faces faces_of_kind(const view::Sphere& s) {
  Faces out;
  for (int r = 1; r < rings; ++r)
    for (int i = 0; i < sides; ++i) {
      const double polar = std::numbers::pi * r / rings, turn = 2 * std::numbers::pi * i / sides;
      out.points.push_back(s.centre + s.radius * Vector3d(std::sin(polar) * std::cos(turn),
                                                          std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  const int top = static_cast<int>(out.points.size()), bottom = top + 1, last = (rings - 2) * sides;
  out.points.push_back(s.centre + s.radius * Vector3d::UnitZ());
  out.points.push_back(s.centre - s.radius * Vector3d::UnitZ());
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    out.triangles.push_back({top, i, next});
    out.triangles.push_back({bottom, last + next, last + i});
    for (int r = 0; r + 2 < rings; ++r)
      add_quadrangle(out, r * sides + i, (r + 1) * sides + i, (r + 1) * sides + next, r * sides + next);
  }
  return out;
}

Faces faces_of_kind(const view::Box& b) {
  Faces out;
  for (int i = 0; i < 8; ++i)
    out.points.emplace_back((i & 1 ? b.high : b.low).x(), (i & 2 ? b.high : b.low).y(), (i & 4 ? b.high : b.low).z());
  add_quadrangle(out, 0, 2, 3, 1), add_quadrangle(out, 4, 5, 7, 6);  // below, above
  add_quadrangle(out, 0, 1, 5, 4), add_quadrangle(out, 2, 6, 7, 3);  // to -y, to +y
  add_quadrangle(out, 0, 4, 6, 2), add_quadrangle(out, 1, 3, 7, 5);  // to -x, to +x
  return out;
}

Faces faces_of_kind(const hydro::hydrostatics::TriangleMesh& mesh) { return {mesh.vertices, mesh.triangles}; }

/// Bytes under their number, as VTK wants them in one piece of base64.
template <class T>
std::string encoded(const std::vector<T>& values) {
  const std::uint64_t count = values.size() * sizeof(T);
  std::vector<std::byte> bytes(sizeof count + count);
  std::memcpy(bytes.data(), &count, sizeof count);
  if (count > 0) std::memcpy(bytes.data() + sizeof count, values.data(), count);
  return hydro::base64(bytes);
}

template <class T>
std::string data_array(const char* type, const std::string& name, int components, const std::vector<T>& values) {
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type, plot::escaped(name), components, encoded(values));
}

std::string numbers_of(const char* element, const std::vector<std::pair<std::string, std::vector<double>>>& of) {
  std::string out = fmt::format("<{}>\n", element);
  for (const auto& [name, values] : of)
    out += data_array("Float32", name, 1, std::vector<float>(values.begin(), values.end()));
  return out + fmt::format("</{}>\n", element);
}

}  // namespace

Faces faces_of(const view::Shape& shape) {
  return std::visit([](const auto& of_kind) { return faces_of_kind(of_kind); }, shape);
}

std::string vtu_of(const Grid& grid, double time_s) {
  const std::size_t each = grid.corners_of_a_cell(), cells = grid.corners.size() / each;
  std::vector<float> places;
  for (const Vector3d& p : grid.points)
    for (const double x : p) places.push_back(static_cast<float>(x));
  std::vector<std::int32_t> ends;
  for (std::size_t i = 1; i <= cells; ++i) ends.push_back(static_cast<std::int32_t>(i * each));
  const std::vector<std::uint8_t> kinds(cells, static_cast<std::uint8_t>(grid.cell));
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n";
  out += fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n", time_s);
  out += fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.points.size(), cells);
  out += "<Points>\n" + data_array("Float32", "Points", 3, places) + "</Points>\n<Cells>\n";
  out += data_array("Int32", "connectivity", 1, grid.corners) + data_array("Int32", "offsets", 1, ends) +
         data_array("UInt8", "types", 1, kinds);
  out += "</Cells>\n" + numbers_of("PointData", grid.of_points) + numbers_of("CellData", grid.of_cells);
  return out + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace froude::interchange
