#pragma once
/// \file  Private to sweep: cases that threads take one by one.
#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace froude::sweep {

class Queue {
 public:
  void add(const std::vector<std::size_t>& cases) {
    const std::scoped_lock lock(mutex_);
    cases_.insert(cases_.end(), cases.begin(), cases.end());
    changed_.notify_all();
  }
  /// Nothing more will be added.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  void clear() {
    const std::scoped_lock lock(mutex_);
    cases_.clear();
  }
  /// Waits for one. None when there will be none any more.
  std::optional<std::size_t> take() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.wait(lock, [&] { return closed_ || !cases_.empty(); });
    --waiting_;
    if (cases_.empty()) return std::nullopt;
    const std::size_t out = cases_.front();
    cases_.pop_front();
    return out;
  }
  /// Those that are there: some of them, a share of 1/`among` at most and one at least.
  std::vector<std::size_t> take(std::size_t some, std::size_t among) {
    const std::scoped_lock lock(mutex_);
    const std::size_t most = std::min(some, (cases_.size() + among - 1) / among);
    const std::vector<std::size_t> out(cases_.begin(), cases_.begin() + static_cast<std::ptrdiff_t>(most));
    cases_.erase(cases_.begin(), cases_.begin() + static_cast<std::ptrdiff_t>(most));
    return out;
  }
  /// So many wait that are no threads.
  void lack(std::size_t waiting) {
    const std::scoped_lock lock(mutex_);
    waiting_ = waiting;
  }
  /// Nothing is there, nor will be.
  bool is_over() const {
    const std::scoped_lock lock(mutex_);
    return closed_ && cases_.empty();
  }
  /// Threads for which there is nothing.
  std::size_t waiting() const {
    const std::scoped_lock lock(mutex_);
    return cases_.empty() ? waiting_ : 0;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::size_t> cases_;
  std::size_t waiting_ = 0;
  bool closed_ = false;
};

}  // namespace froude::sweep
