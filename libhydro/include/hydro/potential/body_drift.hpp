#pragma once
/// \file  Mean drift of each body by itself, from the momentum that goes through a surface about it. (P41) in
/// docs/theory/conventions.md.
#include <Eigen/Core>

#include "hydro/potential/far_field.hpp"

namespace hydro::potential {

/// To second order, per m² of wave amplitude.
struct BodyDrift {
  /// (N, 3), a row for each body: mean force of the waves along x and y, N/m², and mean moment about the vertical
  /// through its point of reference at rest, N m/m².
  Eigen::MatrixX3d load;
  /// m, how far from that vertical the surfaces reach at most: by which moments are measured beside forces.
  double length = 0;
  /// How far loads are off by what the method truncates, over the largest: see difference().
  double estimate = 0;
};

/// The larger of two: the largest difference of forces over the largest force of `finer`, and that of moments over the
/// largest moment, or the largest force times `length` where that is more. 0 where there is none.
double difference(const BodyDrift& coarser, const BodyDrift& finer);

/// By how much the forces on all bodies miss the one that waves far away tell (P39), over the largest force on a body,
/// or the one on all.
double missed(const BodyDrift& drift, const MeanDrift& together);

}  // namespace hydro::potential
