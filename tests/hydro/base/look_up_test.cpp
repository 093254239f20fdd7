// A caller ends what it has begun.
#include "hydro/base/look_up.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "hydro/base/parallel.hpp"

namespace hydro::look_up_test {
namespace {

struct Enough {};

TEST(LookUp, IsSilentWhereNobodyListens) { EXPECT_NO_THROW(look_up()); }

TEST(LookUp, AsksTheInnermostListenerOfItsThread) {
  int outer = 0, inner = 0;
  const LookUps first([&] { ++outer; });
  look_up();
  {
    const LookUps second([&] { ++inner; });
    look_up();
    look_up();
  }
  look_up();
  std::thread([] { look_up(); }).join();
  EXPECT_EQ(outer, 2);
  EXPECT_EQ(inner, 2);
}

TEST(LookUp, EndsJobsInParallelForAnyNumberOfThreads) {
  for (const int threads : {1, 3}) {
    std::atomic<int> begun = 0;
    int asked = 0;
    const LookUps third([&] {
      if (++asked == 3) throw Enough{};
    });
    // Others do not come to the end of all jobs while this thread waits for a core: that would take them minutes.
    EXPECT_THROW(in_parallel(1000000, threads,
                             [&](std::size_t) {
                               if (++begun > 1000) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                             }),
                 Enough);
    EXPECT_LE(begun, threads == 1 ? 2 : 999999);
  }
}

}  // namespace
}  // namespace hydro::look_up_test
