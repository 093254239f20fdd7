#pragma once
/// \file  Cases answered on several threads and kept as they come.
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sweep/numbers.hpp"
#include "sweep/store.hpp"

namespace froude::sweep {

struct Options {
  int threads = 1;
  std::size_t part = 1, parts = 1;  ///< every parts-th case, from this one on
  bool retry = false;               ///< cases that have failed, too
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

/// Takes over what other sweeps of the same study have. Again, it changes nothing.
/// \throws hydro::InputError where they differ in a case that both have
void merge(const std::vector<std::filesystem::path>& folders, Store& into);

/// What the store holds now.
Tally tally_of(const Store& store);

}  // namespace froude::sweep
