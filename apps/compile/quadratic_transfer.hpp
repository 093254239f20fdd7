#pragma once
/// \file  Private to apps: files of second-order wave loads, read and brought to the headings of a sea. (D137)
#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hydro/base/interpolation.hpp"
#include "hydro/potential/formats/second_order.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// T(ω_k; ω_l) mode by mode, N/m² and N m/m²; of a mean drift one column.
using Matrices = std::array<Eigen::MatrixXcd, 6>;

/// What `[body.second_order]` names.
struct SecondOrderFiles {
  hydro::potential::QuadraticTransfer difference;  ///< or the mean drift
  std::optional<hydro::potential::QuadraticTransfer> sum;
};

/// `notes` are told what the files leave open. \throws hydro::InputError, at its place, for a file that has not what
/// the method needs; as hydro::potential::read_second_order()
SecondOrderFiles read_second_order_files(const scene::SecondOrder& asked, const hydro::Water& water,
                                         std::vector<std::string>& notes);

/// \throws hydro::InputError where a larger share of the waves' energy than `accuracy` is beyond T's frequencies
void require_little_outside(double share, const hydro::potential::QuadraticTransfer& T, double accuracy);
/// \throws hydro::InputError always: the waves have several headings
[[noreturn]] void refuse_newman();

/// About another point, r from the first: M + F × r.
Matrices about(Matrices m, const Eigen::Vector3d& r);

/// Between which headings of the file, and how, waves of one heading are. \throws hydro::InputError outside them
hydro::Stencil between(const hydro::potential::QuadraticTransfer& T, double heading);

/// T of a pair of headings of the file. \throws hydro::InputError where it has none
const Matrices& of_pair(const hydro::potential::QuadraticTransfer& T, std::size_t h1, std::size_t h2);

/// T(ω_k, β; ω_l, β) of waves of one heading, or the column T(ω_k, β; ω_k, β) of a mean drift: straight between the
/// headings of the file.
Matrices of_heading(const hydro::potential::QuadraticTransfer& T, double heading);

/// T(ω_k, β₁; ω_l, β₂) of waves of two headings: straight in each of them.
Matrices of_two_headings(const hydro::potential::QuadraticTransfer& T, double first, double second);

/// Of all pairs of waves those of equal ones: what a mean drift has.
hydro::potential::QuadraticTransfer of_equal_waves(hydro::potential::QuadraticTransfer T);

}  // namespace froude::compile
