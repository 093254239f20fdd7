#pragma once
/// \file  The doctor of coefficients: what theory promises about A, B, X and C, and how far the numbers are from it.
///
/// Matrices mix units, so every entry is measured against the two modes that it couples (P11):
///   relative size of A_ij = |A_ij| / sqrt(s_i s_j),   s_i = the largest |A_ii| over ω, not below 1 % of the largest of
///                                                     its kind (translations, rotations) among all bodies
/// Laws and limits are derived in docs/theory/doctor.md, (P60)-(P76).
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// note: as good data are; warning: look before use; error: cannot be what it claims to be.
enum class Severity { note, warning, error };
std::string_view to_string(Severity severity);

/// One finding: which check, what was measured, where in the data, why it matters and what to do.
struct Finding {
  Severity severity = Severity::note;
  std::string check = {};                        ///< stable name, one of check_names()
  std::string where = {};                        ///< entry, mode, body and frequency, for people
  std::string message = {};                      ///< what was measured and what is usual
  std::string why = {};                          ///< "" for a note
  std::string remedy = {};                       ///< "" if there is nothing to do
  std::optional<int> body = {};                  ///< from 1
  std::optional<std::array<int, 2>> entry = {};  ///< row and column, from 1
  std::optional<double> omega = {};              ///< rad/s
};

/// Asymmetry up to this relative size is what panel codes leave: the converged meshes of examples/data reach 0.018.
inline constexpr double usual_asymmetry = 0.02;
/// Negative damping up to this relative size is what their round-off and small frequencies leave: 0.004 there.
inline constexpr double usual_negative_damping = 0.01;
/// Beyond this a diagonal entry of B is not a number that is slightly off, but a wrong one: an irregular frequency, a
/// wrong sign, a wrong column.
inline constexpr double impossible_negative_damping = 0.05;

/// The name of every check, in the order of check():
///
///   symmetry of A, symmetry of B         M_ij = M_ji within a body; warning beyond usual_asymmetry, error if the two
///                                        are far apart all along the frequencies, or opposite
///   reciprocity of A, reciprocity of B   the same between bodies
///   sign of B                            most negative B_ii(ω); warning beyond the data's own asymmetry (at most
///                                        usual_negative_damping), error beyond impossible_negative_damping
///   passivity of B                       smallest eigenvalue of the symmetric part; warning below
///                                        −usual_negative_damping, error if it stays there
///   positivity of A(inf)                 smallest eigenvalue: A(∞) is a kinetic energy
///   limit at zero, limit at infinity     whether A(0) and A(∞) are there
///   repeated frequency                   the matrices of one frequency are, digit for digit, those of another
///   spikes                               values that do not fit between their neighbours, with what they may be
///   Kramers-Kronig                       A from B, and B from A
///   A(inf) by Ogilvie                    the stated A(∞) against the one that A(ω) and B(ω) tell
///   low-frequency tail, high-frequency tail  what the ends of the table cost in the memory K(t)
///   Haskind relation                     B from the excitation of all headings
///   heave in long waves                  X₃ against C₃₃
///   surge and sway in long waves         X₁, X₂ against A, displaced mass and the way of the waves
///   moments in long waves                X₄, X₅ against C₃₄, C₃₅
///   place of the bodies                  phase of X₃ against the reference point
///   restoring matrix                     symmetry and zeros of C, C₃₃ > 0
///   waterplane and volume                C against displaced volume and centres
///   added mass and volume                A against displaced volume
const std::vector<std::string>& check_names();

/// Runs every check. Each that has the data that it needs gives a finding, a note where all is well, so that the
/// numbers are on record; one that has not, says so in a note.
/// \throws InputError if the coefficients are not valid
std::vector<Finding> check(const Coefficients& coefficients);

/// The findings of severity error whose check is not among `accepted`.
/// \throws InputError for an accepted name that is no check's, with the nearest one
std::vector<Finding> refused(const std::vector<Finding>& findings, const std::vector<std::string>& accepted);

}  // namespace hydro::potential
