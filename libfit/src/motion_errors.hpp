#pragma once
/// \file  What noise of a measured channel makes of the columns of a Morison fit; (F68), (F69), docs/theory/fit.md.
///        Private to libfit.
#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fit/differentiate.hpp"
#include "fit/morison.hpp"

namespace fit {

/// Draws of the errors of velocity and acceleration that `motion` derived from `measured`, at its samples; empty where
/// noise is less than a ten-thousandth of the acceleration's variance, or averaged out by a Fourier series.
std::vector<MotionError> errors_of(const Motion& motion, std::span<const double> measured, bool from_velocity,
                                   std::uint64_t stream);

/// Errors of the water's motion against a body's, from those of the body and of the water; one of them may be empty.
std::vector<MotionError> relative_errors(const std::vector<MotionError>& body, const std::vector<MotionError>& water);

/// To first order what the errors of the velocity do to √(u² + w²) u; w empty: 0.
void add_drag_errors(std::span<const double> velocity, std::span<const double> across,
                     std::vector<MotionError>& errors);

/// Of a channel that rounds to steps.
struct Rounding {
  double step;
  double level;  ///< one of the values that it can show
  double total;  ///< deviation of all its noise, rounding among it
};
/// Empty where a channel does not round, or where its noise is so large that rounding is one more white noise.
std::optional<Rounding> find_rounding(std::span<const double> values, double step_s);

/// Draws of the rounding of such a channel. What it rounds is taken to be what the columns `explained_by`, shape
/// (samples, any), explain of it: samples that are smoothed keep too much of the steps themselves.
std::vector<std::vector<double>> rounding_of(std::span<const double> values, const Eigen::MatrixXd& explained_by,
                                             const Rounding& rounding, double step_s, std::uint64_t stream);

}  // namespace fit
