#pragma once
/// \file  Whoever ends a run before its time. Private to apps.
#include <atomic>
#include <csignal>
#include <string>

namespace froude {

/// The number of the signal that asks a run to end; 0 while none does. A run looks at it once a step.
using Interruption = std::atomic<int>;

inline bool asks_to_end(const Interruption* signal) {
  return signal != nullptr && signal->load(std::memory_order_relaxed) != 0;
}

/// "interrupted by SIGINT"
inline std::string sentence(const Interruption& signal) {
  return signal == SIGTERM ? "interrupted by SIGTERM" : "interrupted by SIGINT";
}

/// Thrown where the runs that tell an error are ended: there is none to tell.
struct Interrupted {};

}  // namespace froude
