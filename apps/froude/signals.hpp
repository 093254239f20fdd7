#pragma once
/// \file  Ctrl-C, and what batch systems send before they kill.
#include <stdexcept>
#include <string>

#include "answers/interruption.hpp"

namespace froude {

/// As shells tell it: of the exit status, to which the signal's number is added.
constexpr int ended_by_signal = 128;

/// While one lives, the first SIGINT or SIGTERM only asks for an end; the next one ends the program at once.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// What has come so far, in the life of the program.
  static const Interruption& asked();
};

/// What was done is kept as far as it went.
class EndedBySignal : public std::runtime_error {
 public:
  EndedBySignal(int signal, const std::string& what) : std::runtime_error(what), signal_(signal) {}
  int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

}  // namespace froude
