#pragma once
/// \file  A pole model as the state space that other programs read.
#include <Eigen/Core>

#include <filesystem>
#include <string>

#include "hydro/radiation/rational.hpp"

namespace hydro::radiation {

/// ẋ = A x + B v, ∫K(t−τ) v dτ = C x, every mode with the oscillations of all poles; (n·order) states, mode after mode.
struct StateSpace {
  Eigen::MatrixXd A, B, C;
};
StateSpace state_space(const PoleModel& model);

/// OpenFAST's `.ss` of HydroDyn: title, a flag for each mode, number of states, states of each mode, rows of A, B, C.
/// Its output is the load on the platform, so C is written with a minus. SI, about the point of the coefficients.
/// \throws InputError if the modes are not six a body, or the file cannot be written
void write_openfast(const PoleModel& model, const std::string& title, const std::filesystem::path& file);

/// The groups /bodyN/hydro_coeffs/radiation_damping/state_space/{A,B,C,D,it} of a BEMIO file, a realisation for each
/// pair of modes with C over the density, and impulse_response_fun/{K,t}, K over the density, up to `length` seconds in
/// steps of `step`. \throws InputError as write_openfast
void write_bemio_state_space(const PoleModel& model, double density, double step, double length,
                             const std::filesystem::path& file);

}  // namespace hydro::radiation
