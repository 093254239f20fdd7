// Accuracy is a promise: scenes drawn at random, run with nothing but an accuracy, against runs ten times finer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "support/drawn_scenes.hpp"
#include "support/promise.hpp"
#include "support/source_dir.hpp"

namespace froude {
namespace {

/// Of all scenes at one accuracy.
struct Outcome {
  int runs = 0, kept = 0;
  double worst = 0;  // error over what was asked
  std::string missed;
};

void judge(const support::Subject& subject, double accuracy, Outcome& out) {
  const support::Runs runs(subject);
  ++out.runs;
  std::optional<froude::Run> run;
  double step = 0;
  try {
    run = runs.of(runs.read(accuracy));
    step = run->step;
  } catch (const hydro::InputError&) {
    step = runs.accepted(accuracy, {}).step;
  }
  const support::Reference reference = support::reference(runs, step);
  const double error = run ? support::judge(*run, reference, accuracy).error : 0;
  const bool kept = run ? error <= accuracy : support::is_out_of_reach(runs, reference, accuracy);
  out.kept += kept;
  out.worst = std::max(out.worst, error / accuracy);
  if (!kept) out.missed += run ? fmt::format("{}: {:.2g}; ", subject.name, error) : subject.name + ": refused; ";
}

class Promise : public testing::TestWithParam<double> {};

TEST_P(Promise, IsKeptByPendulumsAndRowsDrawnAtRandom) {
  Outcome out;
  for (const std::uint64_t seed : {0, 1, 6, 7, 12, 13, 18, 19, 24, 25, 30, 31})
    judge({fmt::format("drawn {}", seed), support::drawn_scene(seed), froude_test::source_dir() / "examples/drawn.toml",
           6},
          GetParam(), out);
  // An estimate is no bound: one run in twenty may miss, and none by more than five times.
  EXPECT_GE(out.kept, 0.95 * out.runs) << out.missed;
  EXPECT_LE(out.worst, 5) << out.missed;
}

INSTANTIATE_TEST_SUITE_P(Accuracies, Promise, testing::Values(1e-2, 1e-3));

}  // namespace
}  // namespace froude
