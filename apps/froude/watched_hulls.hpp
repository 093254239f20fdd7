#pragma once
/// \file  Hulls of a scene while they are solved: a progress bar, and an end where one is asked for.
#include <mutex>
#include <optional>

#include "froude/commands.hpp"
#include "froude/progress.hpp"

namespace froude {

/// While one lives, hulls that this process solves for a scene show how far they are, where a person watches, and a
/// signal that asks for an end is obeyed between two frequencies: EndedBySignal is thrown.
class WatchedHulls {
 public:
  explicit WatchedHulls(const Console& console);
  ~WatchedHulls();
  WatchedHulls(const WatchedHulls&) = delete;
  WatchedHulls& operator=(const WatchedHulls&) = delete;

 private:
  void update(int done, int all);

  std::ostream& err_;
  bool shown_;
  std::mutex one_at_a_time_;
  std::optional<Progress> bar_;
};

}  // namespace froude
