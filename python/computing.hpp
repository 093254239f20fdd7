#pragma once
/// \file  Private to the module: long calls. They let other threads of Python work, tell how far they are, and end at
///        Ctrl-C or when something of the caller's raises.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "hydro/base/look_up.hpp"

namespace froude::python {

/// Thrown through a computation that is to end; what was raised is thrown in its place where Python goes on. No
/// std::exception, so that nobody takes it for a failure of the computation.
struct Ended {};

class Computing {
 public:
  /// `what` is the name of the call; `progress` is called with the share done, in [0, 1], and that name; or it is None.
  Computing(std::string what, py::object progress) : what_(std::move(what)), progress_(std::move(progress)) {}

  /// What `work` returns, computed without the lock of the interpreter. \throws what it throws, or what was raised
  template <class Work>
  auto of(Work&& work) {
    try {
      const hydro::LookUps ups([this] { look_up(); });
      const py::gil_scoped_release others_may_work;
      return work();
    } catch (...) {
      if (raised_) std::rethrow_exception(raised_);
      throw;
    }
  }
  /// The same for a scene, of which one thread at a time may ask.
  template <class Work>
  auto of(const HeldScene& held, Work&& work) {
    return of([&] {
      const std::scoped_lock lock(*held.busy);
      return work(held.scene);
    });
  }

  bool tells() const { return !progress_.is_none(); }
  /// By any thread, as often as it likes.
  void done(double share) {
    share_ = share;
    look_up();
  }
  /// By any thread: true once something was raised.
  bool ended() const { return ended_; }

  /// Calls back into Python. \throws Ended where that raises
  template <class Call>
  auto call(Call&& call) {
    const py::gil_scoped_acquire lock;
    if (raised_) throw Ended{};
    try {
      return call();
    } catch (py::error_already_set&) {
      return_raised();
    } catch (py::cast_error&) {
      return_raised();
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[noreturn]] void return_raised() {
    raised_ = std::current_exception();
    ended_ = true;
    throw Ended{};
  }
  /// Twenty times a second at most. A process that was forked has no Python to ask.
  void look_up() {
    constexpr std::chrono::milliseconds rest(50);
    const auto now = Clock::now().time_since_epoch();
    auto last = looked_.load(std::memory_order_relaxed);
    if (ended_) throw Ended{};
    if (now - last < rest || ::getpid() != process_) return;
    if (!looked_.compare_exchange_strong(last, now)) return;
    call([this] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const double share = share_;
      if (tells() && share >= 0) progress_(share, what_);
    });
  }

  std::string what_;
  py::object progress_;
  pid_t process_ = ::getpid();
  std::atomic<Clock::duration> looked_{Clock::now().time_since_epoch()};
  std::atomic<double> share_{-1};  // of the work; negative: nobody has told yet
  std::atomic<bool> ended_{false};
  std::exception_ptr raised_;  // touched with the lock of the interpreter only
};

}  // namespace froude::python
