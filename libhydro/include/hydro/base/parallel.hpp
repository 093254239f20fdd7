#pragma once
/// \file  Independent jobs on several threads.
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

#include "hydro/base/look_up.hpp"

namespace hydro {

/// Does job(i) for i = 0 … count − 1 on `threads` threads, that of the caller among them. What is thrown first by index
/// is thrown on, when all that are begun have ended and no other is begun; so results are the same for any number of
/// threads. Before each of its jobs the caller's thread looks up.
template <class Job>
void in_parallel(std::size_t count, int threads, const Job& job) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> ends{false};
  std::vector<std::exception_ptr> failed(count);
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !ends; i = next++) {
      try {
        look_up();
        job(i);
      } catch (...) {
        failed[i] = std::current_exception();
        ends = true;
      }
    }
  };
  std::vector<std::thread> pool;
  for (int t = 1; t < threads && static_cast<std::size_t>(t) < count; ++t) pool.emplace_back(work);
  work();
  for (std::thread& t : pool) t.join();
  for (const auto& error : failed)
    if (error) std::rethrow_exception(error);
}

/// One thread for each of the machine's processors.
inline int all_processors() {
  const unsigned known = std::thread::hardware_concurrency();
  return known > 1 ? static_cast<int>(known) : 1;
}

}  // namespace hydro
