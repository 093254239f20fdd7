#pragma once
/// \file  Private to the commands that make time series: how they are summed up, drawn and written as CSV.
#include <map>
#include <span>
#include <string>
#include <vector>

#include "answers/plot.hpp"
#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "froude/result.hpp"

namespace froude {

/// Mean, standard deviation and extremes of each signal, for people one line each under a header, who are not told of
/// energies; in the tree under `signals`.
void add_series(Report& report, std::span<const Signal> signals);

/// One panel for each unit; `labels` names the axis of a unit, "signal" where it has none. Energies are left out.
plot::Figure series_figure(const std::string& title, const std::vector<double>& time, std::span<const Signal> signals,
                           const std::map<std::string, std::string>& labels = {});

void write_series_csv(const Path& path, const std::vector<double>& time, std::span<const Signal> signals);

}  // namespace froude
