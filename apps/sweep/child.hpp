#pragma once
/// \file  Private to sweep: a process that answers cases one after the other, and that a case can end without harm.
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace froude::sweep {

/// A fork of this process, made while no other thread answers cases: it has all that has been read, and nothing it does
/// is seen here but what it tells. It ends when this process does, however that ends.
class Child {
 public:
  using Clock = std::chrono::steady_clock;
  /// Why it is no more.
  struct Ended : std::runtime_error {
    using std::runtime_error::runtime_error;
  };

  /// `answer` is called in the process; it may not throw. `memory_bytes`: what it may take beyond what it begins with.
  Child(const std::function<std::string(std::size_t)>& answer, std::optional<double> memory_bytes);
  /// Ends the process, whatever it is at.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void give(std::size_t number);
  std::optional<std::size_t> at_work() const { return number_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - given_).count(); }  ///< since give()
  bool is_fresh() const { return cases_ <= 1; }  ///< the case that it is at, or was, is its first
  int descriptor() const { return socket_; }     ///< becomes readable when there is something for answered()
  /// The answer to the case that it was given, which it is no longer at then; none while it is not whole. \throws Ended
  std::optional<std::string> answered();

 private:
  [[noreturn]] void ended();

  pid_t process_ = -1;
  int socket_ = -1;
  std::optional<std::size_t> number_;
  Clock::time_point given_;
  std::size_t cases_ = 0;
  std::string received_;
};

}  // namespace froude::sweep
