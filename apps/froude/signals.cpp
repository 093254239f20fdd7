#include "froude/signals.hpp"

#include <unistd.h>

#include <array>
#include <string_view>

namespace froude {
namespace {

Interruption signal_that_came = 0;
static_assert(Interruption::is_always_lock_free, "a handler may touch nothing else");
volatile std::sig_atomic_t somebody_watches = 0;

constexpr std::array<int, 2> asking{SIGINT, SIGTERM};

void to_default() {
  for (const int number : asking) std::signal(number, SIG_DFL);
}

void take(int which) {
  signal_that_came = which;
  to_default();
  // What is under way may take a while to come to an end at which it can be kept.
  constexpr std::string_view told = "\nending, with what is done so far; once more ends at once\n";
  if (somebody_watches != 0 && ::write(STDERR_FILENO, told.data(), told.size()) < 0) return;
}

}  // namespace

Signals::Signals() {
  somebody_watches = ::isatty(STDERR_FILENO);
  for (const int number : asking) std::signal(number, take);
}

Signals::~Signals() { to_default(); }

const Interruption& Signals::asked() { return signal_that_came; }

}  // namespace froude
