#pragma once
/// \file  A number for each field that is made, by which what a thread keeps of it is known again.
#include <atomic>
#include <cstdint>

namespace hydro::waves {

inline std::uint64_t next_field_number() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace hydro::waves
