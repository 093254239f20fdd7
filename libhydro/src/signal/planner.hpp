#pragma once
/// \file  Private: plans of FFTW, and its one lock: it executes plans from any thread but makes and destroys them in
/// one thread at a time only.
#include <fftw3.h>

#include <memory>
#include <mutex>
#include <type_traits>

namespace hydro::signal {

inline std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

struct FreePlan {
  void operator()(fftw_plan plan) const {
    const std::lock_guard lock(planner());
    fftw_destroy_plan(plan);
  }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, FreePlan>;

}  // namespace hydro::signal
