// How far does a body swing with another mass, damping, wave?  vary SCENE PARAMETER VALUE…
//   vary examples/buoy.toml body.mass 4500 5000 5500
#include <fmt/core.h>

#include <algorithm>
#include <froude/scene.hpp>
#include <hydro/base/error.hpp>
#include <string>

int main(int argc, char** argv) try {
  if (argc < 4) return fmt::print(stderr, "vary SCENE PARAMETER VALUE…\n"), 2;
  const froude::Scene scene = froude::read(argv[1]);
  const froude::Parameter parameter = scene.parameter(argv[2]);
  for (int i = 3; i < argc; ++i) {
    const froude::Run run = scene.with(parameter, std::stod(argv[i])).run();
    if (!run.stopped.empty()) fmt::print("stopped: {}\n", run.stopped);
    const froude::Signal& first = run.signals.front();
    const auto [low, high] = std::minmax_element(first.values.begin(), first.values.end());
    fmt::print("{} = {} {}: {} from {:.4g} to {:.4g} {}\n", parameter.path, argv[i], parameter.unit, first.name, *low,
               *high, first.units);
    run.write(fmt::format("{}.run.h5", i - 2));
  }
} catch (const hydro::InputError& error) {
  return fmt::print(stderr, "{}\n", error.what()), 2;
}
