#pragma once
/// \file  A progress bar with an estimate of the time left, on stderr, only where a person watches.
#include <chrono>
#include <ostream>
#include <string>

namespace froude {

/// One line that is rewritten in place, at most ten times a second, and wiped at the end. Silent unless `shown`.
class Progress {
 public:
  /// `what` is the name of the work, "run"; `shown` is Console::show_progress.
  Progress(std::ostream& err, std::string what, bool shown);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Tells how much is done, in [0, 1]. Cheap: most calls only read the clock.
  void update(double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  std::ostream& err_;
  std::string what_;
  bool shown_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_drawn_ = start_;
};

/// The line that Progress draws: "run  [#####.....]  50 %  12 s left".
std::string progress_line(const std::string& what, double fraction, double elapsed_s);

}  // namespace froude
