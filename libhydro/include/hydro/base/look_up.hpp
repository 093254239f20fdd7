#pragma once
/// \file  Long computations that their caller may end: between two steps, frequencies or trials they look up, and what
///        the caller has to say may be an exception.
#include <functional>
#include <utility>

namespace hydro {

/// While one lives, look_up() of the thread that made it calls `said`, which may throw; that ends the computation as
/// any error does. One within another stands for it. Other threads, those of in_parallel() too, do not look up: they
/// end with the one that shares its work.
class LookUps {
 public:
  explicit LookUps(std::function<void()> said) : said_(std::move(said)), before_(std::exchange(current(), this)) {}
  ~LookUps() { current() = before_; }
  LookUps(const LookUps&) = delete;
  LookUps& operator=(const LookUps&) = delete;

  /// That of this thread; null where there is none.
  static LookUps*& current() {
    thread_local LookUps* one = nullptr;
    return one;
  }
  void call() const { said_(); }

 private:
  std::function<void()> said_;
  LookUps* before_;
};

/// Called by computations at times; nothing happens where nobody listens. \throws whatever the listener does
inline void look_up() {
  if (const LookUps* one = LookUps::current()) one->call();
}

}  // namespace hydro
