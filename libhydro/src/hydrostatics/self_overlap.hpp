#pragma once
/// \file  Where a closed mesh covers water twice. (H1) in docs/theory/hydrostatics.md. Not installed.
#include "hydro/hydrostatics/mesh.hpp"

namespace hydro::hydrostatics {

/// A place where two faces cross, or where what is next to a face on its inside is enclosed a second time.
struct SelfOverlap {
  Eigen::Vector3d at;
  int triangle;  ///< that is crossed, or lies inside
  int other;     ///< that crosses it; −1: a shell around it encloses the place as well
};

/// The first place found; empty if there is none deeper than `depth` [m]: faces that only touch are no overlap.
/// `open_edges`, as they run in their triangles, are closed by a cone to the mean of each opening's edge. Cost:
/// O(n log n) with a tree of boxes.
std::optional<SelfOverlap> self_overlap(const TriangleMesh& mesh, const std::vector<std::array<int, 2>>& open_edges,
                                        double depth);

}  // namespace hydro::hydrostatics
