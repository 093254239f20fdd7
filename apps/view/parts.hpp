#pragma once
/// \file  Private to view: what a View is put together from.
#include "view/view.hpp"

namespace froude::view {

BodyMotion motion_of(const scene::Body& body, const Recorded& recorded, const Frames& frames);

Shapes shapes_of(const scene::Scene& scene, std::size_t body, std::size_t most_triangles);

/// [[line]] by the places of its nodes, catenaries by their tensions, connectors by their ends. All arguments must
/// outlive what is returned.
std::vector<Line> lines_of(const scene::Scene& scene, const Recorded& recorded, const Frames& frames,
                           const std::vector<BodyMotion>& bodies, std::vector<std::string>& notes);

/// Notes tell the share of the variance that is shown, and how far the surface is off the recorded elevation at the
/// origin.
std::optional<Surface> surface_of(const scene::Scene& scene, const RunResult& run, const Recorded& recorded,
                                  std::vector<std::string>& notes);

}  // namespace froude::view
