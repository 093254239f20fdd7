#pragma once
/// \file  Private to the commands that look at time series: what is wrong with a record as it was measured, before laws
///        are drawn from it.
#include <span>
#include <string>
#include <vector>

#include "froude/commands.hpp"
#include "froude/result.hpp"

namespace froude {

/// The names of --accept that this command knows. \throws hydro::InputError at --accept for another
void require_known(const std::vector<std::string>& accepted, const std::vector<std::string>& known);
bool accepts(const std::vector<std::string>& accepted, const std::string& name);

/// Signals that stand at an end of their range, three samples and more in a row, one sentence each; (F19).
std::vector<std::string> cautions_of_stops(std::span<const Signal> signals);

/// Which ends of the range a command draws its numbers from.
enum class Ends { low, high, both };
/// Of a measured table: largest values and damage of what a stop has cut off are not in the record. A result of a run
/// has no sensor, and a level of exactly 0 may be a slack line or a dry gauge: these pass.
/// \throws hydro::InputError that names the level and `--accept stop`
void require_free_of_stops(const Signal& signal, Ends ends, const Path& file);

/// Times of a record without the gaps in it.
struct MeasuredTime {
  std::vector<double> time;  ///< s; each gap is as long as the steps around it
  std::size_t gaps = 0;
  double missing = 0;             ///< s, all gaps
  double longest = 0, after = 0;  ///< s; the longest gap, and when it begins

  std::vector<std::string> cautions() const;  ///< empty without gaps
};
/// A gap is a step more than three times as long as the median of those around it, fifteen on each side.
MeasuredTime measured_time(const std::vector<double>& time);

}  // namespace froude
