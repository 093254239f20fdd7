#pragma once
/// \file  Mean drift of single cylinders, or circles about hulls, from partial waves. (C24) in
/// docs/theory/cylinders.md. Not installed.
#include <Eigen/Core>

#include <vector>

#include "array.hpp"
#include "hydro/potential/body_drift.hpp"
#include "hydro/potential/wave_field.hpp"
#include "lattice.hpp"

namespace hydro::cylinders {

/// What circles stand in for.
struct CircleOwner {
  std::size_t body;
  Eigen::Vector2d about;  ///< in plan, where its moments are taken
};

/// Of all bodies, from the waves that the circles send out: by the unit wave Z_0(z) e^{−ik…} (first column of
/// `sent_out`) and by the real and the imaginary part of the velocities per metre of wave (second and third). Circles
/// are apart; one `owner` each.
potential::BodyDrift body_drift(const std::vector<Cylinder>& circles, const std::vector<CircleOwner>& owner,
                                const VerticalModes& modes, const Channels& channels, const Amplitudes& sent_out,
                                const potential::FieldQuestion& question, const Water& water, int threads);

/// How near to a circle momentum is counted, of all of them, m.
double nearest_counted(const std::vector<Cylinder>& circles);

}  // namespace hydro::cylinders
