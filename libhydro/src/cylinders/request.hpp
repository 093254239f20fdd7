#pragma once
/// \file  What is asked of the solver, before anything is computed. Not installed.
#include <vector>

#include "hydro/cylinders/solve.hpp"

namespace hydro::cylinders {

/// Partial waves below this share of the tolerance are left out: there are many of them.
constexpr double share_of_tolerance = 0.2;

/// \throws InputError as solve()
void check_request(const std::vector<double>& omega, const std::vector<double>& heading, const Options& options);

/// Frequencies that are repeated with doubled resolution: both ends and evenly between.
std::vector<std::size_t> frequencies_to_double(std::size_t all, int wanted);

}  // namespace hydro::cylinders
