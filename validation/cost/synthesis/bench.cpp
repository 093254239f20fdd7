// How long does a sea take at fixed and at moving points? One record of 1 000 components and 36 000 steps; methods that
// go step by step are run over a part of it and reported for the whole.
#include <benchmark/benchmark.h>

#include "subject.hpp"

namespace froude::cost {
namespace {

void run(benchmark::State& state, Wanted wanted, std::size_t method_number) {
  const auto points = static_cast<std::size_t>(state.range(0));
  const auto method = methods(wanted, points)[method_number];
  const std::size_t part = method.at_once ? steps : std::max<std::size_t>(2, std::min(steps, 2000 / points));
  method.build();
  method.run(0, part);
  guarded_error(method, wanted, points, part);
  for (auto _ : state) method.run(0, part);
  state.SetLabel(method.name);
  state.counters["record_s_per_s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(part) * dt_s, benchmark::Counter::kIsRate);
}

void declare(const char* name, Wanted wanted, std::size_t count) {
  for (std::size_t m = 0; m < count; ++m)
    benchmark::RegisterBenchmark(name, [wanted, m](benchmark::State& state) { run(state, wanted, m); })
        ->ArgName("points")
        ->Arg(1)
        ->Arg(10)
        ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace froude::cost

int main(int argc, char** argv) {
  using namespace froude::cost;
  declare("fixed_elevation", Wanted::fixed_elevation, 6);
  declare("moving_elevation", Wanted::moving_elevation, 3);
  declare("moving_kinematics", Wanted::moving_kinematics, 3);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
