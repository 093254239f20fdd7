#include "froude/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace progress_test {
namespace {

using froude::Progress;
using froude::progress_line;
using testing::HasSubstr;
using testing::Not;

TEST(Progress, EstimatesTheTimeLeftFromTheTimeTaken) {
  EXPECT_THAT(progress_line("run", 0.25, 10), HasSubstr(" 25 %  30 s left"));
  EXPECT_THAT(progress_line("run", 0.5, 200), HasSubstr("3 min 20 s left"));
  EXPECT_THAT(progress_line("run", 0.5, 3600 + 60), HasSubstr("1 h 01 min left"));
}

TEST(Progress, GivesNoEstimateBeforeThereIsOne) { EXPECT_THAT(progress_line("run", 0, 5), Not(HasSubstr("left"))); }

TEST(Progress, KeepsOneWidthWhateverIsDone) {
  const auto bar = [](double f) { return progress_line("run", f, 0).substr(0, 40); };
  for (const double f : {-1.0, 0.0, 0.4, 1.0, 2.0}) EXPECT_EQ(bar(f).find(']'), bar(0).find(']')) << f;
}

TEST(Progress, IsSilentWhenNobodyWatches) {
  std::ostringstream err;
  {
    Progress progress(err, "run", false);
    for (int i = 0; i < 1000; ++i) progress.update(i / 1000.0);
  }
  EXPECT_EQ(err.str(), "");
}

}  // namespace
}  // namespace progress_test
