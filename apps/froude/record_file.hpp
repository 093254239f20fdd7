#pragma once
/// \file  Private to the commands that look at time series: records from results of `froude run` and from CSV files.
#include <string>
#include <vector>

#include "froude/commands.hpp"
#include "froude/result.hpp"

namespace froude {

/// By the ending of the name: .h5 or .nc of `froude run`; .csv, .txt or .dat with a header and a column "time" or "t".
/// \throws hydro::InputError
RunResult read_record(const Path& path);

/// Where samples miss more than 1 % of the height of crests on average (`missed`, of hs::missed_of_crests()), what that
/// does: ", and levels are too low by as much". Empty where they do not.
std::vector<std::string> cautions_of_samples(double missed, const std::string& consequence);

/// Leaves out the samples before a time, s. \throws hydro::InputError if nothing is left
void drop_before(RunResult& record, double from, const Path& file);

/// Leaves out the samples after a time, s. \throws hydro::InputError if the record ends before it, or nothing is left
void drop_after(RunResult& record, double to, const Path& file);

/// Those that one of the patterns fits, in their order. \throws hydro::InputError for a pattern that fits none, with
/// the nearest name
std::vector<Signal> signals_like(const RunResult& record, const std::vector<std::string>& patterns, const Path& file);

/// \throws hydro::InputError with the nearest name
const Signal& signal_of(const RunResult& record, const std::string& name, const Path& file);

}  // namespace froude
