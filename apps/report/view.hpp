#pragma once
/// \file  Private to report: what an animation of a run is made of.
#include <Eigen/Geometry>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "froude/result.hpp"
#include "report/arrays.hpp"
#include "scene/scene.hpp"

namespace froude::html {

/// Which samples of a run are frames: every so many.
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

/// Where a body's origin is, and how it is turned, frame by frame.
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
BodyMotion motion_of(const scene::Body& body, const Recorded& recorded, const Frames& frames);

/// Shapes of a body in its axes, what they are, and what had to be assumed: {"shapes": […], "note": …}.
Json shapes_of(const scene::Scene& scene, std::size_t body);

/// [[line]] by the places of its nodes, catenaries by their tensions, connectors by their ends. Notes say what is
/// missing.
Json lines_of(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
              const std::vector<BodyMotion>& bodies, std::vector<std::string>& notes);

/// The components of the waves, largest first, {} where there are none or they are no sum of linear waves; the share of
/// their variance that is shown, and how far the surface is off the recorded elevation at the origin.
Json surface_of(const scene::Scene& scene, const RunResult& run, const Recorded& recorded,
                std::vector<std::string>& notes);

}  // namespace froude::html
