#pragma once
/// \file  What problems of several kinds have in common when they are solved and told. Private to libfit.
#include <string>
#include <utility>
#include <vector>

#include "fit/diagnose.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"
#include "fit/runs.hpp"
#include "hydro/base/error.hpp"

namespace fit {

/// Thrown on the way to a solution, which then holds its refusal and nothing else.
struct Refused {
  Refusal refusal;
};

/// What `work` gives; what the user's mistake is there is told of this run's file.
template <class Work>
auto of_run(const Source& source, const Work& work) {
  try {
    return work();
  } catch (const hydro::InputError& e) {
    throw e.at({.file = source.file.string()});
  }
}

/// (F121) A body that swings about its rest, or is driven, stays within half a turn of its mean. \throws
/// hydro::InputError for a record of an angle, rad, that does not: its header names another unit than its numbers have
void require_within_half_a_turn(const std::vector<double>& angle);

/// (F79) Negative beyond twice its interval.
inline bool is_surely_negative(const Interval& i) { return i.high + (i.high - i.low) / 2 < 0; }
/// Of a damping or drag that is: `what` comes out negative.
Refusal drives_the_motion(const std::string& what, const Source& source);

/// The middle of the interval: the value also of what is not identifiable.
inline double middle(const Coefficient& c) { return (c.interval.low + c.interval.high) / 2; }

/// The part of a report that tells one run of several.
Report begin_run(const Source& source);
/// Labels of a run, if it has any.
void add_labels(Report& report, const Source& source);
/// Harmonics and whiteness of the residuals; harmonics one by one where they have a `unit`.
void add_residuals(Report& report, const ResidualReport& left, const std::string& unit = {});
/// One line and one entry of the list `key` for each row: `tell` gives its facts and its words.
template <class Row, class Tell>
void add_rows(Report& report, const char* key, const std::vector<Row>& rows, const Tell& tell) {
  std::vector<Facts> all;
  for (const Row& row : rows) {
    auto [facts, words] = tell(row);
    all.push_back(std::move(facts));
    report.remarks.push_back(std::move(words));
  }
  if (!all.empty()) report.facts.emplace_back(key, std::move(all));
}

/// Runs that were fitted each by itself, put together: each as far as its own error goes without what is the same in
/// all, which is then counted once (F93). Values are those in the middle of the intervals, without their sign where
/// asked. Errors of a run are placed at its file.
RandomEffects together(const std::vector<Coefficient>& runs, const std::vector<std::string>& files, double confidence,
                       bool sizes = false);
/// The files of runs, for that.
template <class Runs>
std::vector<std::string> files_of(const Runs& runs) {
  std::vector<std::string> out;
  for (const auto& run : runs) out.push_back(run.source.file.string());
  return out;
}

/// One coefficient over several runs, tests …, each fitted alone, without a law.
Report over_runs(const std::string& name, const std::string& unit, const RandomEffects& law, const std::string& runs,
                 std::size_t count, double confidence);

}  // namespace fit
