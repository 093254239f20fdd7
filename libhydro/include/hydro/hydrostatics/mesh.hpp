#pragma once
/// \file  Hulls as triangles: reading them from files, and making sure that they enclose something.
///
/// z is up and z = 0 is the water of the hull as it is drawn. A triangle's corners run anticlockwise seen from outside,
/// so that (b − a) × (c − a) points out of the hull. What the integrals of immersion.hpp need of a mesh is (H1).
#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/error.hpp"

namespace hydro::hydrostatics {

/// Triangles over shared vertices, unchecked.
struct TriangleMesh {
  std::string source;                         ///< file or shape, for messages
  std::vector<Eigen::Vector3d> vertices;      ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
  std::vector<std::string> notes = {};        ///< what the reader had to decide, one sentence each
};

/// What a file leaves unsaid.
struct MeshOptions {
  std::optional<double> unit;  ///< metres per unit of the file; empty: metres, but see read_mesh() on GDF
  bool reverse = false;        ///< turn every triangle inside out
  /// Vertices nearer than this are one, as a fraction of the diagonal of the bounding box. The default is ten times
  /// the precision of the 32-bit numbers that STL keeps.
  double weld = 1e-6;
};

/// Reads STL (ASCII or binary, told apart by content), Wavefront OBJ and low-order WAMIT GDF, by the ending of the
/// name.
///   STL  the corners count, the stored normals are not read
///   OBJ  `v` and `f`; faces of more than three corners are cut from their first corner, so they must be convex
///   GDF  panels of four corners; ISX, ISY mirror them; lengths are in the unit that GRAV is in (9.8: metres), ULEN
///   does
///        not scale them
/// \throws InputError with file, line and remedy: no such format, a file cut short, numbers that are none or not
/// finite, a face without its vertices, a GDF of higher order, GRAV that is not that of metres while no unit is given
TriangleMesh read_mesh(const std::filesystem::path& path, const MeshOptions& options = {});
/// The same from text or bytes in memory; `name` tells the format by its ending.
TriangleMesh parse_mesh(std::string_view bytes, const std::string& name, const MeshOptions& options = {});

/// Makes one vertex of those nearer than `distance` [m] and leaves out triangles that lose a corner by it. Triangles
/// without area but with three corners stay: they may join their neighbours. Notes how many.
TriangleMesh welded(TriangleMesh mesh, double distance);

/// Walls straight up from the edge of an opening, and a flat deck at `height` [m] above it: the part of a hull that a
/// panel code never sees. Every opening must lie at one level (to 1e-6 of the size); each deck is cut into triangles
/// from the mean of its edge, which that point must see. \throws InputError otherwise, if there is no opening or height
/// <= 0
TriangleMesh with_freeboard(TriangleMesh mesh, double height);

/// A hull fit for integrals: triangles agree on what is outside, and enclose a positive volume but for openings,
/// through which water may not come in. Immutable.
class Hull {
 public:
  /// \throws InputError saying where: fewer than four triangles; a vertex that is not finite; neighbours that disagree
  /// on what is outside; a part that is inside out; faces that cross, or shells inside one another, by more than 1e-5
  /// of the diagonal; a size that cannot be in metres (diagonal above 5 km or below 1 mm).
  explicit Hull(TriangleMesh mesh);

  const std::string& source() const { return mesh_.source; }
  const std::vector<std::string>& notes() const { return mesh_.notes; }
  const std::vector<Eigen::Vector3d>& vertices() const { return mesh_.vertices; }
  const std::vector<std::array<int, 3>>& triangles() const { return mesh_.triangles; }
  /// Vertices at the edges of openings; empty for a closed hull.
  const std::vector<int>& rim() const { return rim_; }
  bool closed() const { return rim_.empty(); }
  double diagonal() const { return diagonal_; }              ///< of the bounding box, m
  const Eigen::Vector3d& middle() const { return middle_; }  ///< of the bounding box, m
  /// Enclosed volume, m³; an opening is closed by the cone from its edge to the mean of all edges.
  double volume() const { return volume_; }
  double area() const { return area_; }     ///< of all triangles, m²
  int parts() const { return parts_; }      ///< that share no vertex
  int slivers() const { return slivers_; }  ///< triangles of no area, kept

 private:
  void measure();
  void check_doubled() const;
  void check_edges();
  void check_parts();

  TriangleMesh mesh_;
  std::vector<int> rim_;
  std::vector<std::array<int, 2>> open_edges_;  // as they run in their triangle
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double diagonal_ = 0, volume_ = 0, area_ = 0;
  int parts_ = 0, slivers_ = 0;
};

/// What flat triangles lack of the volume of the smooth hull they were taken from, m³, to first order (H2): positive
/// where the hull bulges. Edges sharper than 30° are taken for knuckles of the hull itself. An estimate, not a bound.
double chord_volume(const Hull& hull);

}  // namespace hydro::hydrostatics
