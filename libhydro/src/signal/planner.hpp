#pragma once
/// \file  Private: the one lock of FFTW, which executes plans from any thread but makes and destroys them in one thread
/// at a time only.
#include <mutex>

namespace hydro::signal {

inline std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace hydro::signal
