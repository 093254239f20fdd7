#pragma once
/// \file  Private to the commands that look at time series: the steps of a record before it is looked at, which are
///        those of [prepare] in a fit.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "froude/result.hpp"

namespace froude {

/// What the steps did.
struct StepsDone {
  double step;                                                ///< s, of the record that they leave
  double steady_from_s, steady_to_s;                          ///< as fit::PreparedChannels
  std::size_t filled;                                         ///< samples that were missing, of each signal
  std::vector<std::pair<std::string, std::size_t>> outliers;  ///< samples bridged, of each signal
  std::vector<std::string> steps, cautions;                   ///< sentences, in order
};

/// A part of a record, both ends included; empty: from its beginning, or to its end. s.
struct RecordPart {
  std::optional<double> from = {}, to = {};
};

/// By two options. \throws hydro::InputError at one that is no time, or for an end before the beginning
RecordPart record_part(const std::optional<std::string>& from, const std::optional<std::string>& to);

/// A command that takes the record as it is refuses them.
bool names_a_step(const StepArguments& arguments);

/// Takes a record through the steps that are named and leaves the part of what they give; where none is named nothing
/// is done, and the part is not cut. A signal that never changes stays as it is.
/// \throws hydro::InputError at the option or the file: an option that cannot be read, a step that the record does not
/// allow, a part beyond what the steps leave
std::optional<StepsDone> take_steps(RunResult& record, const StepArguments& arguments, const RecordPart& part,
                                    const Path& file);

/// The same, and where no step is named the part is cut. Filters see the whole record, so that the part need not lose
/// its ends to them. \throws hydro::InputError as take_steps(), and for a part outside the record
std::optional<StepsDone> take_steps_of_part(RunResult& record, const StepArguments& arguments, const RecordPart& part,
                                            const Path& file);

/// Under "prepared".
Report report_of(const StepsDone& done);

}  // namespace froude
