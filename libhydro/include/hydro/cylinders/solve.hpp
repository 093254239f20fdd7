#pragma once
/// \file  Exact linear radiation and diffraction of waves by bodies made of vertical cylinders.
///
/// Potential theory without approximation in the interaction: each cylinder is solved by matching, the array by
/// multiple scattering that includes evanescent waves. What is truncated (functions in the gap, partial waves) is
/// chosen from the tolerance asked, and its effect is measured by doubling. Equations (C1)-(C21) are derived and
/// sourced in docs/theory/cylinders.md.
#include <functional>
#include <optional>
#include <vector>

#include "hydro/cylinders/layout.hpp"
#include "hydro/potential/coefficients.hpp"

namespace hydro::cylinders {

/// How the equations between groups of cylinders are solved (C15).
enum class Equations {
  automatic,  ///< whichever needs fewer operations
  direct,     ///< elimination: operations as the cube, memory as the square of the number of cylinders
  iterative,  ///< block by block until the residual is far below the tolerance: both as the square, or nearly as the
              ///< number itself where cylinders stand as copies of a few on a lattice
};

struct Options {
  /// Largest relative error asked of A, B and X, an entry being measured against its two modes (P11); 1e-9 … 0.1.
  double tolerance = 1e-5;
  /// Frequencies are solved first where they are asked for, and then between these where responses bend, until what
  /// interpolation foresees at places not yet seen is met to this, 1e-6 … 0.1 and ten times `tolerance` at least (P36);
  /// the table is made so fine that cubics between its frequencies serve (P37). Empty: just those asked for.
  std::optional<double> frequency_tolerance = {};
  /// Frequencies that are solved at a time; the result does not depend on it. 0: as many as the machine has cores.
  int threads = 0;
  /// At how many frequencies the work is repeated with doubled resolution for SelfCheck::doubling; 0: none.
  int doubled_frequencies = 3;
  /// Small layouts are solved directly, some hundred cylinders with few motions by iteration.
  Equations equations = Equations::automatic;
  /// Called after each frequency, one call at a time, from any thread: how many are done, of how many.
  std::function<void(int done, int all)> progress = {};
};

/// What was kept, and what theory says about the result. Relative numbers are measured as in (P11).
struct SelfCheck {
  double energy = 0;                   ///< largest |B − power carried away by waves|, (C13)
  double haskind = 0;                  ///< largest |X − X from the waves made by motion|, (C13)
  double reciprocity = 0;              ///< largest asymmetry of A and B
  double doubling = 0;                 ///< largest change of A, B, X with all truncations doubled; NaN if not asked
  std::vector<double> doubling_omega;  ///< where it was measured, rad/s
  int gap_functions = 0;               ///< per family, (C5)
  int partial_waves = 0;               ///< per cylinder, at most over the frequencies, (C11)
  double left_out = 0;                 ///< estimated effect of partial waves beyond those that can be had; usually 0
  int steps = 0;                       ///< of the iteration between groups, at most; 0: all by elimination
  bool lattice = false;                ///< waves between groups passed over a lattice, by Fourier transforms (C21)
  std::vector<double> solved_omega;    ///< rad/s, where frequencies were chosen; the others of the table lie between
  double unseen = 0;                   ///< the largest miss at the last of those before they were solved (P36)
  double effective_depth = 0;          ///< m; differs from the water's only if that is infinite, (C14)
};

struct Solution {
  potential::Coefficients coefficients;
  SelfCheck check;
};

/// What a solution will need, told before it is computed.
struct Cost {
  int frequencies;  ///< as asked, or about as many as will be chosen
  int unknowns;     ///< complex, at the frequency that has most
  double bytes;     ///< of working memory, all threads together, estimated
  double seconds;   ///< estimated from how fast this machine multiplies matrices now; good to a factor of two
  bool iterative;   ///< Equations::automatic takes the iteration at some frequency, or it was asked for
};

/// A, B and X of `bodies` at the frequencies `omega` (rad/s, increasing) for waves going towards `heading` (rad,
/// increasing; may be empty), with A(∞), the centres of buoyancy, volumes and, where every body has a centre of
/// gravity, C. There is no A(0): in finite depth heave has none. Infinite depth is replaced by a finite one (C14).
/// \throws InputError as check(); if a frequency is not finite and positive or the lists do not increase; if the
/// tolerance is out of range or cannot be reached at a frequency (with the digits that can), or needs too many terms;
/// if frequencies are to be chosen and fewer than five are asked for, or 300 do not do
Solution solve(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& omega,
               const std::vector<double>& heading, const Options& options = {});

/// \throws InputError as solve()
Cost cost(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& omega,
          const std::vector<double>& heading, const Options& options = {});

}  // namespace hydro::cylinders
