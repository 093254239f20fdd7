#pragma once
/// \file  Private to report: what is made of the series of a run before they are thinned.
#include <cstddef>

#include "froude/result.hpp"
#include "report/arrays.hpp"

namespace froude::html {

/// One-sided densities per Hz of all signals but those of energy, by Welch in 15 segments that overlap by half, with
/// the factors of a 95 % interval, up to where 99.99 % of the variance of each lies. \return {"missing": why} for a
/// record that is too short, or sampled at uneven times
Json spectra_of(const RunResult& run, std::size_t first);

/// For phase plots and trajectories: the last samples of the record, at most 3000, and there the velocities of all
/// signals by central differences of the record: their error is Δt²/6 of the third derivative.
Json phase_of(const RunResult& run, std::size_t first);

/// True for what is told of the energy ledger, which has no spectrum to speak of.
inline bool is_of_energy(const std::string& signal) { return signal.starts_with("energy."); }

}  // namespace froude::html
