#include "quiet_logging.hpp"

#include <glog/logging.h>

#include <mutex>
#include <optional>

namespace fit {
namespace {

// The level is one for the whole process: the first to come lowers it, and the last to go puts it back.
std::mutex guard;
int alive = 0;
std::optional<int> level_before;

}  // namespace

QuietLogging::QuietLogging() {
  const std::lock_guard lock(guard);
  if (alive++ > 0 || google::IsGoogleLoggingInitialized()) return;
  level_before = FLAGS_minloglevel;
  FLAGS_minloglevel = google::GLOG_FATAL;
}

QuietLogging::~QuietLogging() {
  const std::lock_guard lock(guard);
  if (--alive > 0 || !level_before) return;
  FLAGS_minloglevel = *level_before;
  level_before.reset();
}

}  // namespace fit
