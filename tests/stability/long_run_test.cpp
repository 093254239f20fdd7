// A day of sea: what goes wrong slowly. A phase that drifts, a memory that fills, energy that creeps.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "scene/scene.hpp"
#include "support/source_dir.hpp"

namespace long_run_test {
namespace {

using namespace froude;

constexpr std::size_t hour = 3600, day = 24 * hour;  // samples of 1 s

/// A moored module with all linear effects in a sea that does not repeat within the day.
scene::Scene day_of_sea(const std::string& start, const std::string& signals) {
  return scene::parse(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "jonswap"
hs = "0.5 m"
tp = "6 s"
heading = "0 deg"
components = { repetition = "24 h", lowest = "0.6 rad/s", highest = "2 rad/s" }
[[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
free = ["heave"]
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = { accept_error = 0.03 }
hydrostatics = true
[ask]
run = { duration = "24 h", every = "1 s", of = [")" +
                          signals + "\"], start = \"" + start + "\" }\n[solve]\nstep = \"0.1 s\"\n",
                      froude_test::source_dir() / "examples/data/day.toml");
}

/// Root mean square of a − b over one hour, over that of b.
double apart(const std::vector<double>& a, const std::vector<double>& b, std::size_t from) {
  double difference = 0, size = 0;
  for (std::size_t i = from; i < from + hour; ++i) {
    difference += std::pow(a[i] - b[i], 2);
    size += std::pow(b[i], 2);
  }
  return std::sqrt(difference / size);
}

/// What the run holds of memory, in the heap and in maps of their own.
std::size_t bytes_in_use() {
  const auto heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// By how much a follows b within one hour, s: the shift of b that comes nearest to a.
double delay(const std::vector<double>& a, const std::vector<double>& b, std::size_t from) {
  double product = 0, square = 0;
  for (std::size_t i = from + 1; i + 1 < from + hour; ++i) {
    const double rate = (b[i + 1] - b[i - 1]) / 2;  // per s: samples of 1 s
    product += (b[i] - a[i]) * rate;
    square += rate * rate;
  }
  return product / square;
}

// The transfer functions know no time: what 864 000 steps do to the phase shows against them. Both differ by the error
// of the step, (ωh)²/12 over the damping of a heave of 2.5 rad/s, and by that of the memory, the same at any hour.
void expect_constant_phase(const std::vector<double>& stepped, const std::vector<double>& steady) {
  const double early = apart(stepped, steady, hour), late = apart(stepped, steady, day - hour);
  EXPECT_LT(early, 0.02);
  EXPECT_LT(std::abs(late - early), 0.2 * early) << "as other waves make of the same error";
  EXPECT_NEAR(delay(stepped, steady, day - hour), delay(stepped, steady, hour), 1e-3)
      << "s; likewise. It is 1e-8 of a day";
}

void expect_constant_energy(const froude::Run& run) {
  const auto share = [&](std::size_t i) {
    return std::abs(run.signal("energy.residual")[i]) / run.signal("energy.excitation.supplied")[i];
  };
  EXPECT_LT(share(day), 1e-4) << "second order of the step: (ωh)²/12 of energy that comes and goes, added up";
  EXPECT_LT(share(day), 2 * share(hour)) << "the residual grows as the energy does, no faster";
}

TEST(DayOfSea, KeepsItsPhaseItsEnergyAndItsMemory) {
  std::size_t samples = 0, bytes_of_an_hour = 0, bytes_of_a_day = 0;
  const froude::Run run =
      simulate(day_of_sea("as placed", R"(m.heave", "energy.residual", "energy.excitation.supplied)"), [&](double) {
        if (++samples == hour) bytes_of_an_hour = bytes_in_use();
        if (samples == day) bytes_of_a_day = bytes_in_use();
      });
  ASSERT_TRUE(run.stopped.empty()) << run.stopped;
  expect_constant_energy(run);
  expect_constant_phase(run.signal("m.heave"), simulate(day_of_sea("steady", "m.heave")).signal("m.heave"));
  // There is room for all samples from the start. A megabyte is for what the C library keeps. (The address sanitizer
  // has a heap of its own, of which it tells nothing.)
  EXPECT_LT(bytes_of_a_day, bytes_of_an_hour + (1u << 20));
}

}  // namespace
}  // namespace long_run_test
