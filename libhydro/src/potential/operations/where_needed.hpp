#pragma once
/// \file  Frequencies where they are needed, and the table between them. (P36), (P37) in docs/theory/conventions.md.
/// Not installed.
#include <functional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// A, B and X at these frequencies, which rise; with A(∞), of bodies with reference points.
using SolveAt = std::function<Coefficients(const std::vector<double>& omega)>;

/// Frequencies at which coefficients were solved, and how well they were foreseen there.
struct ChosenFrequencies {
  std::vector<double> omega;
  double unseen = 0;                 ///< the largest miss at the last ones before they were solved
  std::vector<double> unseen_omega;  ///< those
};

/// `first`, and as many more between them as it takes until rational interpolation foresees what it has not seen to
/// `tolerance`: of B + iω(A − A(∞)) relative to the largest dampings of the two modes (P11), of X to the largest of the
/// mode. \throws InputError with the numbers where 300 frequencies do not do, or what is solved is no more certain than
/// that
ChosenFrequencies choose_frequencies(const std::vector<double>& first, double tolerance, const SolveAt& solve);

/// The table of solved frequencies, and of so many between them, by rational
/// interpolation, that a cubic (P6) misses none by more than an eighth of `tolerance`. B of the added ones has no
/// negative eigenvalues. \throws InputError where what lies between is not certain to the tolerance, as noise in what
/// is solved may leave it
Coefficients with_frequencies_between(const Coefficients& solved, double tolerance);

/// About as many frequencies as will be solved, evenly from the first to the last: `across` [m] is the distance over
/// which waves resonate, of the farthest two parts of bodies. Good to a factor of two.
std::vector<double> expected_frequencies(const std::vector<double>& first, double tolerance, double across,
                                         const Water& water);

/// What was chosen, in words, of the table that was made of it.
std::string note_of(const ChosenFrequencies& chosen, const Coefficients& table);

}  // namespace hydro::potential
