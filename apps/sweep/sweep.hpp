#pragma once
/// \file  Cases answered by several threads and processes, and kept as they come.
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sweep/numbers.hpp"
#include "sweep/store.hpp"

namespace froude::sweep {

class Master;
class Helper;

struct Options {
  int threads = 1;
  std::size_t part = 1, parts = 1;  ///< every parts-th case, from this one on
  bool retry = false;               ///< cases that have failed, too
  Master* ranks = nullptr;          ///< other processes that help
};

/// What is told on the way, and asked.
struct Watch {
  std::function<void(std::size_t cases, double seconds_a_case)> expected;  ///< before all but the first are answered
  std::function<void(double)> progress;                                    ///< share done
  std::function<bool()> interrupted;                                       ///< no further case is begun, none ended
};

/// What a sweep comes to.
struct Tally {
  std::size_t done = 0, failed = 0, skipped = 0, warned = 0;  ///< of all that is in the folder
  std::size_t answered = 0;                                   ///< now
  std::size_t unfinished_ranks = 0;                           ///< that had died, or been ended, before they were merged
  bool interrupted = false;
  double seconds = 0;                                              ///< by the clock, for what was answered now
  std::vector<std::pair<std::size_t, std::string>> failures = {};  ///< the first few, and why

  std::size_t over() const { return done + failed + skipped; }
};

/// Answers one case; `progress` may throw, which ends it. Series are not written.
/// \throws hydro::InputError where the study itself is wrong: an output that the scene does not have
Row answer_case(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
                const std::function<void(double)>& progress = {});

/// Answers all cases that the store has not, and redoes those whose series is torn or missing. Numbers do not depend on
/// threads, order or earlier interruptions.
/// \throws hydro::InputError where the study is wrong or the folder cannot be written; what was answered is kept
Tally carry_out(const Study& study, const Cases& cases, Store& store, const Options& options, const Watch& watch);

/// What a rank other than 0 does: answers what it is given, and keeps it in folder_of_rank(), which carry_out() of rank
/// 0 takes over. \throws hydro::InputError as carry_out()
void help_out(const Study& study, const Cases& cases, const std::filesystem::path& sweep, const Identity& identity,
              int threads, Helper& helper, const std::function<bool()>& interrupted);

/// "rank-00002" in the folder of a sweep.
std::filesystem::path folder_of_rank(const std::filesystem::path& sweep, int rank);

/// Takes over what ranks have left in the folder of a sweep, and removes their folders. Returns how many there were.
/// \throws hydro::InputError where one is still at work, or its database is damaged
std::size_t take_over_ranks(Store& into);

/// Takes over what other sweeps of the same study have. Again, it changes nothing.
/// \throws hydro::InputError where they differ in a case that both have
void merge(const std::vector<std::filesystem::path>& folders, Store& into);

/// What the store holds now.
Tally tally_of(const Store& store);

}  // namespace froude::sweep
