#pragma once
/// \file  Equations too large for elimination, by iteration (C15). Not installed.
#include <functional>
#include <optional>

#include "between.hpp"

namespace hydro::cylinders {

struct Iterated {
  Amplitudes x;
  int steps;  ///< most of any column
};

/// Solves M x = y for all columns of y side by side, M given by what it does to a block of columns: the generalised
/// minimal residual method (Saad & Schultz 1986, "GMRES: a generalized minimal residual algorithm for solving
/// nonsymmetric linear systems", SIAM Journal on Scientific and Statistical Computing 7), not restarted. Until
/// ‖y − M x‖ <= precision ‖y‖ in every column; nothing if `most` steps do not suffice.
std::optional<Iterated> iterate(const std::function<Amplitudes(const Amplitudes&)>& M, const Amplitudes& y,
                                double precision, int most);

}  // namespace hydro::cylinders
