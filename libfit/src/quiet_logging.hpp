#pragma once
/// \file  Keeps Ceres off standard error. What stopped a search is in its summary, which SearchReport takes over; glog,
/// by
///        which Ceres writes it a second time, sends to standard error all that comes before a program initialises it.

namespace fit {

/// While one lives, glog drops what is not fatal. A program that has initialised glog says by its own settings where
/// messages go: there nothing is changed. Several may live at once, in several threads.
class QuietLogging {
 public:
  QuietLogging();
  ~QuietLogging();
  QuietLogging(const QuietLogging&) = delete;
  QuietLogging& operator=(const QuietLogging&) = delete;
};

}  // namespace fit
