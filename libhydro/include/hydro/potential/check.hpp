#pragma once
/// \file  First examination of coefficients: what theory promises about A and B, and how far the numbers are from it.
///
/// Matrices mix units, so every entry is measured against the two modes that it couples (P11):
///   relative size of A_ij = |A_ij| / sqrt(s_i s_j),   s_i = the largest |A_ii| over ω, not below 1 % of the largest of
///                                                     its kind (translations, rotations) among all bodies
#include <string>
#include <string_view>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// note: as good data are; warning: look before use; error: cannot be what it claims to be.
enum class Severity { note, warning, error };
std::string_view to_string(Severity severity);

/// One finding: which check, where in the data, what was measured, and what to do ("" if nothing).
struct Finding {
  Severity severity;
  std::string check;  ///< stable name: "symmetry of A", "sign of B", …
  std::string where;  ///< entry, mode, body and frequency
  std::string message;
  std::string remedy;
};

/// Asymmetry up to this relative size is what panel codes leave: the converged meshes of examples/data reach 0.018.
inline constexpr double usual_asymmetry = 0.02;
/// Negative damping up to this relative size is what their round-off and small frequencies leave: 0.004 there.
inline constexpr double usual_negative_damping = 0.01;
/// Beyond this a diagonal entry of B is not a number that is slightly off, but a wrong one: an irregular frequency, a
/// wrong sign, a wrong column.
inline constexpr double impossible_negative_damping = 0.05;

/// Runs every check. Each gives exactly one finding, a note where all is well, so that the numbers are on record:
///   symmetry of A, symmetry of B       largest |M_ij − M_ji|, relative; a warning beyond usual_asymmetry
///   sign of B                          most negative B_ii(ω), relative; a warning beyond the data's own asymmetry (at
///   most
///                                      usual_negative_damping), an error beyond impossible_negative_damping
///   passivity of B                     smallest eigenvalue of the symmetric part, scaled; a warning below
///                                      −usual_negative_damping
///   limit at zero, limit at infinity   whether A(0) and A(∞) are there
/// \throws InputError if the coefficients are not valid
std::vector<Finding> check(const Coefficients& coefficients);

}  // namespace hydro::potential
