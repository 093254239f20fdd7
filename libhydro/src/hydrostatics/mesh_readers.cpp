#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "hydro/base/measurable.hpp"
#include "hydro/base/units.hpp"
#include "hydro/hydrostatics/mesh.hpp"
#include "hydro/io/atomic_file.hpp"

namespace hydro::hydrostatics {
namespace {

using Eigen::Vector3d;

/// Words of a text with the place of each, for errors.
class Words {
 public:
  Words(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool next(std::string_view& word) {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
      line_ += text_[at_++] == '\n';
    const std::size_t from = at_;
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0) ++at_;
    word = text_.substr(from, at_ - from);
    return !word.empty();
  }
  std::string_view need(std::string_view what) {
    std::string_view word;
    if (!next(word)) fail(fmt::format("the file ends where {} should be", what), "it was cut short: copy it again");
    return word;
  }
  double number(std::string_view what) {
    const std::string_view word = need(what);
    double value = 0;
    try {
      value = parse_number(word);
    } catch (const InputError& e) {
      fail(fmt::format("{} should be here: {}", what, e.rule()), {});
    }
    // Volumes are cubes of it. What is too small is rounding of somebody's sums.
    if (std::abs(value) > 1 && !is_measurable(value))
      fail(fmt::format("{} is {:g}, beyond what is computed with: sizes reach to 1e30", what, value), {});
    return value;
  }
  int integer(std::string_view what) {
    const double value = number(what);
    if (value != std::floor(value) || std::abs(value) > 1e9)
      fail(fmt::format("{} is {:g}, no integer", what, value), {});
    return static_cast<int>(value);
  }
  /// What is left of the current line.
  std::string_view rest_of_line() {
    const std::size_t from = at_;
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    return text_.substr(from, at_ - from);
  }
  /// Steps over the end of the current line; false at the end of the text.
  bool next_line() {
    rest_of_line();
    if (at_ >= text_.size()) return false;
    ++at_;
    ++line_;
    return true;
  }
  [[noreturn]] void fail(const std::string& rule, const std::string& remedy) const {
    throw InputError(rule, {.file = file_, .line = line_}, remedy);
  }

 private:
  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void add_triangle(TriangleMesh& mesh, const std::array<Vector3d, 3>& corners) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

std::size_t binary_stl_size(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);  // little-endian, as the machines that we build for
  return 84 + 50 * static_cast<std::size_t>(count);
}

/// 80 bytes of anything, the number of triangles, then 12 floats and 2 bytes for each: normal, three corners,
/// attribute.
TriangleMesh binary_stl(std::string_view bytes, const std::string& file) {
  TriangleMesh mesh{.source = file, .vertices = {}, .triangles = {}};
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    std::array<float, 9> x{};
    std::memcpy(x.data(), bytes.data() + at + 12, sizeof x);
    for (const float value : x)
      if (!std::isfinite(value))
        throw InputError(fmt::format("triangle {} has a corner that is not finite", (at - 84) / 50 + 1),
                         {.file = file});
    std::array<Vector3d, 3> corners;
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = Eigen::Vector3f(x[3 * c], x[3 * c + 1], x[3 * c + 2]).cast<double>();
    add_triangle(mesh, corners);
  }
  return mesh;
}

/// solid … { facet normal n n n  outer loop  vertex x y z (3 times)  endloop  endfacet } endsolid …, any number of
/// solids
TriangleMesh ascii_stl(std::string_view bytes, const std::string& file) {
  TriangleMesh mesh{.source = file, .vertices = {}, .triangles = {}};
  Words words(bytes, file);
  const auto expect = [&words](std::string_view word) {
    const std::string_view got = words.need(fmt::format("\"{}\"", word));
    if (got != word) words.fail(fmt::format("\"{}\" should be here, not \"{}\"", word, got), {});
  };
  std::string_view word;
  bool open = false;
  while (words.next(word)) {
    if (word == (open ? "endsolid" : "solid")) {
      open = !open;
      words.rest_of_line();  // the name
      continue;
    }
    if (!open || word != "facet")
      words.fail(fmt::format("\"{}\" should be here, not \"{}\"", open ? "facet or endsolid" : "solid", word), {});
    expect("normal");
    for (int i = 0; i < 3; ++i) words.need("a normal");
    expect("outer");
    expect("loop");
    std::array<Vector3d, 3> corners;
    for (Vector3d& p : corners) {
      expect("vertex");
      for (int i = 0; i < 3; ++i) p[i] = words.number("a coordinate");
    }
    expect("endloop");
    expect("endfacet");
    add_triangle(mesh, corners);
  }
  if (open) words.fail("the file ends before endsolid", "it was cut short: copy it again");
  return mesh;
}

/// The vertex that one word of a face names: "7", "7/1", "7//3", "-1" (the last so far).
int obj_vertex(std::string_view word, std::size_t known, const Words& words) {
  const std::string_view number = word.substr(0, word.find('/'));
  int index = 0;
  try {
    const double value = parse_number(number);
    index = static_cast<int>(value);
    if (std::abs(value) > 1e9 || index != value) throw InputError("no integer");
  } catch (const InputError&) {
    words.fail(fmt::format("\"{}\" names no vertex", word), "a face is written f 1 2 3 or f 1/1/1 2/2/2 3/3/3");
  }
  const int count = static_cast<int>(known), at = index > 0 ? index - 1 : count + index;
  if (index == 0 || at < 0 || at >= count)
    words.fail(fmt::format("a face has the vertex {}, but {} vertices come before it", index, count), {});
  return at;
}

void obj_face(TriangleMesh& mesh, std::string_view line, const Words& place) {
  Words corners(line.substr(0, line.find('#')), {});
  std::vector<int> face;
  for (std::string_view word; corners.next(word);) face.push_back(obj_vertex(word, mesh.vertices.size(), place));
  if (face.size() < 3)
    place.fail(fmt::format("a face of {} corners", face.size()), "a face has three corners at least");
  for (std::size_t i = 2; i < face.size(); ++i) mesh.triangles.push_back({face[0], face[i - 1], face[i]});
}

TriangleMesh obj(std::string_view bytes, const std::string& file) {
  TriangleMesh mesh{.source = file, .vertices = {}, .triangles = {}};
  Words words(bytes, file);
  // Says nothing of the shape of faces.
  constexpr std::array<std::string_view, 9> ignored{"vn", "vt", "g", "o", "s", "usemtl", "mtllib", "vp", "l"};
  for (std::string_view word; words.next(word);) {
    if (word.front() == '#') {
      words.rest_of_line();
    } else if (word == "v") {
      Vector3d p;
      for (int i = 0; i < 3; ++i) p[i] = words.number("a coordinate");
      mesh.vertices.push_back(p);
      words.rest_of_line();  // a weight or colours
    } else if (word == "f") {
      obj_face(mesh, words.rest_of_line(), words);
    } else if (std::find(ignored.begin(), ignored.end(), word) != ignored.end()) {
      words.rest_of_line();
    } else {
      words.fail(fmt::format("\"{}\" is not read: only vertices v and faces f make a hull", word),
                 "export the hull as polygons");
    }
  }
  return mesh;
}

/// Metres per unit of a GDF: its GRAV is in the same unit of length.
double gdf_unit(double gravity, const MeshOptions& options, const Words& words) {
  if (options.unit) return *options.unit;
  if (gravity > 9.7 && gravity < 9.9) return 1;
  words.fail(fmt::format("GRAV = {:g} is not gravity in m/s²: lengths of this file are not in metres", gravity),
             gravity > 32 && gravity < 32.4 ? "say so: unit ft" : "say what they are in: unit mm, cm, in, ft or m");
}

/// A title; ULEN GRAV; ISX ISY; the number of panels; then four corners a panel. A panel and its mirror image face the
/// water both, so the image runs through its corners the other way round.
TriangleMesh gdf(std::string_view bytes, const std::string& file, double& unit, const MeshOptions& options) {
  TriangleMesh mesh{.source = file, .vertices = {}, .triangles = {}};
  Words words(bytes, file);
  if (!words.next_line()) words.fail("a GDF begins with a line of title", "the file is empty or has one line");
  const double ulen = words.number("ULEN"), gravity = words.number("GRAV");
  if (!(ulen > 0)) words.fail(fmt::format("ULEN = {:g} must be positive", ulen), {});
  unit = gdf_unit(gravity, options, words);
  words.rest_of_line();
  std::array<int, 2> mirrored{};
  for (int& m : mirrored) {
    m = words.integer("a symmetry flag, ISX or ISY");
    if (m != 0 && m != 1) words.fail(fmt::format("a symmetry flag is {}; it is 0 or 1", m), {});
  }
  words.rest_of_line();
  const int panels = words.integer("the number of panels");
  if (panels < 1) words.fail(fmt::format("the number of panels is {}", panels), {});
  Words same_line(words.rest_of_line(), file);
  std::string_view word;
  if (same_line.next(word) && !word.empty() && std::isdigit(static_cast<unsigned char>(word.front())) != 0)
    words.fail("two integers stand where the number of panels is: a GDF of higher order (patches)",
               "export flat panels (low order)");
  for (int p = 0; p < panels; ++p) {
    std::array<Vector3d, 4> corner;
    for (Vector3d& x : corner)
      for (int i = 0; i < 3; ++i) x[i] = words.number(fmt::format("panel {} of {}", p + 1, panels));
    for (int ix = 0; ix <= mirrored[0]; ++ix)
      for (int iy = 0; iy <= mirrored[1]; ++iy) {
        std::array<Vector3d, 4> c = corner;
        for (Vector3d& x : c) x = Vector3d(ix == 1 ? -x.x() : x.x(), iy == 1 ? -x.y() : x.y(), x.z());
        if (ix != iy) std::swap(c[1], c[3]);
        add_triangle(mesh, {c[0], c[1], c[2]});
        add_triangle(mesh, {c[0], c[2], c[3]});
      }
  }
  return mesh;
}

std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

TriangleMesh stl(std::string_view bytes, const std::string& name) {
  if (bytes.size() >= 84 && binary_stl_size(bytes) == bytes.size()) return binary_stl(bytes, name);
  std::string_view first;
  if (Words(bytes, name).next(first) && first == "solid" && bytes.find("facet") != std::string_view::npos)
    return ascii_stl(bytes, name);
  throw InputError(
      bytes.size() < 84
          ? fmt::format("{} bytes are too few for an STL file", bytes.size())
          : fmt::format("neither an ASCII STL (no \"solid\" with facets) nor a whole binary one: its header "
                        "asks for {} bytes, it has {}",
                        binary_stl_size(bytes), bytes.size()),
      {.file = name}, "it was cut short or is no STL: export it again");
}

}  // namespace

TriangleMesh parse_mesh(std::string_view bytes, const std::string& name, const MeshOptions& options) {
  require(!options.unit || (*options.unit > 0 && std::isfinite(*options.unit)),
          "the unit of a mesh must be a positive length, got {} m", options.unit.value_or(0));
  const std::string ending = ending_of(name);
  double unit = options.unit.value_or(1);
  TriangleMesh mesh;
  if (ending == ".gdf") {
    mesh = gdf(bytes, name, unit, options);
  } else if (ending == ".obj") {
    mesh = obj(bytes, name);
  } else if (ending == ".stl") {
    mesh = stl(bytes, name);
  } else {
    throw InputError(fmt::format("\"{}\" is no ending of a mesh that is read", ending), {.file = name},
                     "meshes are .stl, .obj or .gdf");
  }
  if (mesh.triangles.empty()) throw InputError("there are no faces", {.file = name}, "export the hull as polygons");
  Vector3d low = mesh.vertices.front(), high = low;
  for (Vector3d& p : mesh.vertices) {
    p *= unit;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (!(high - low).allFinite() || (high - low).norm() == 0)
    throw InputError("all vertices are one, or too far apart for numbers", {.file = name});
  if (options.reverse)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return welded(std::move(mesh), options.weld * (high - low).norm());
}

TriangleMesh read_mesh(const std::filesystem::path& path, const MeshOptions& options) {
  return parse_mesh(io::read_text(path), path.string(), options);
}

}  // namespace hydro::hydrostatics
