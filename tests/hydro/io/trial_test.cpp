// What a child process finds out about reading a file (decision 30).
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <stdexcept>

#include "hydro/base/error.hpp"
#include "hydro/io/trial.hpp"

namespace trial_test {
namespace {

using hydro::io::try_in_child;

/// A number that a child and its parent share.
class Shared {
 public:
  Shared()
      : count_(new (::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1,
                           0)) std::atomic<int>(0)) {}
  ~Shared() { ::munmap(count_, sizeof(std::atomic<int>)); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  std::atomic<int>& operator*() const { return *count_; }

 private:
  std::atomic<int>* count_;
};

TEST(TrialInAChild, LeavesToTheCallerWhatReadingThrowsOrChanges) {
  int read = 0;
  Shared called;
  try_in_child("some.h5", [&] {
    ++read;
    ++*called;
    throw std::runtime_error("not for the caller");
  });
  EXPECT_EQ(*called, 1);
  EXPECT_EQ(read, 0) << "the child has its own";
}

TEST(TrialInAChild, RefusesAFileThatEndsItByASignalOrHoldsItForEver) {
  EXPECT_THROW(try_in_child("some.h5", [] { std::raise(SIGSEGV); }), hydro::InputError);
  std::atomic<bool> goes_on = true;
  const auto endless = [&] {
    while (goes_on) {
    }
  };
  EXPECT_THROW(try_in_child("some.h5", endless, {.processor = 1, .clock = 60}), hydro::InputError);
}

TEST(TrialInAChild, IsTriedAgainWhereItWaitsForWhatAnotherThreadHeld) {
  Shared called;
  const auto waits_at_first = [&] {
    if (++*called == 1) ::pause();
  };
  EXPECT_NO_THROW(try_in_child("some.h5", waits_at_first, {.processor = 1, .clock = 1}));
  EXPECT_EQ(*called, 2);
  const auto always_waits = [&] {
    ++*called;
    ::pause();
  };
  *called = 0;
  EXPECT_THROW(try_in_child("some.h5", always_waits, {.processor = 1, .clock = 1}), hydro::InputError);
  EXPECT_EQ(*called, 3) << "and no more";
}

}  // namespace
}  // namespace trial_test
