#pragma once
/// \file  What moves in a run, in space: bodies with shapes and poses, lines, the surface of the waves. Reports animate
/// it, `froude export` writes it for ParaView. Axes are those of the scene, z up; SI.
#include <Eigen/Geometry>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "froude/result.hpp"
#include "hydro/hydrostatics/mesh.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "scene/scene.hpp"

namespace froude::view {

/// Which samples of a run are frames.
struct Frames {
  std::vector<std::size_t> samples;
  std::size_t count() const { return samples.size(); }
};

/// Signals by name.
class Recorded {
 public:
  explicit Recorded(const RunResult& run);
  const std::vector<double>* find(const std::string& name) const;
  /// x, y and z of a place at a sample, if all three are there.
  std::optional<Eigen::Vector3d> place(const std::string& name, std::size_t sample) const;

 private:
  std::map<std::string, const Signal*> signals_;
};

/// Where a body's origin is, and how it is turned.
struct Pose {
  Eigen::Vector3d origin;
  Eigen::Quaterniond attitude;
  Eigen::Vector3d of(const Eigen::Vector3d& from_origin) const { return origin + attitude * from_origin; }
};
struct BodyMotion {
  std::vector<Pose> poses;           ///< one a frame
  std::vector<std::string> missing;  ///< free motions that the result does not keep, shown at rest
  bool moves = false;                ///< it keeps one at least
};

struct Cylinder {
  Eigen::Vector3d from, to;
  double radius;
};
struct Sphere {
  Eigen::Vector3d centre;
  double radius;
};
struct Box {
  Eigen::Vector3d low, high;
};
/// From the body's origin, in its axes.
using Shape = std::variant<Cylinder, Sphere, Box, hydro::hydrostatics::TriangleMesh>;
/// What a body looks like by what its scene says of it.
struct Shapes {
  std::vector<Shape> all;
  std::string note;  ///< what had to be assumed
};

/// A [[line]], a catenary or a connector: pieces between points.
struct Line {
  std::string name, kind;  ///< "line", "catenary", "connector"
  std::size_t points;
  std::function<Eigen::Vector3d(std::size_t point, std::size_t frame)> place;  ///< not finite where nothing is known
  /// Of the piece after a point, N, compression negative; not finite where nothing is known.
  std::function<double(std::size_t piece, std::size_t frame)> tension;
};

/// The largest components of the waves, and over how long they grow.
struct Surface {
  double ramp;  ///< s
  std::vector<hydro::waves::Component> components;
};

/// How much of their full height waves have, which grow by a half cosine over the ramp, as a run has them.
double grown(double t, double ramp);

/// Everything of a run that can be drawn.
class View {
 public:
  /// A mesh of more triangles than `most_triangles` is left out, with a note.
  View(const RunResult& run, scene::Scene scene, Frames frames, std::size_t most_triangles);
  View(const View&) = delete;  // lines look at what stands here
  View& operator=(const View&) = delete;

  const scene::Scene& scene() const { return scene_; }
  const Frames& frames() const { return frames_; }
  const std::vector<BodyMotion>& motions() const { return motions_; }  ///< one a body
  const std::vector<Shapes>& shapes() const { return shapes_; }        ///< one a body
  const std::vector<Line>& lines() const { return lines_; }
  /// None: there are no waves, or they are no sum of linear waves, or too far off the recorded elevation.
  const std::optional<Surface>& surface() const { return surface_; }
  /// What is not as it is, in whole sentences.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  scene::Scene scene_;
  Recorded recorded_;
  Frames frames_;
  std::vector<BodyMotion> motions_;
  std::vector<Shapes> shapes_;
  std::vector<std::string> notes_;
  std::vector<Line> lines_;
  std::optional<Surface> surface_;
};

}  // namespace froude::view
