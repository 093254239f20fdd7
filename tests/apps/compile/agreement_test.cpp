#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <ostream>
#include <tuple>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/signal_list.hpp"
#include "hydro/signal/harmonics.hpp"
#include "support/pontoons.hpp"

namespace agreement_test {
namespace {

using namespace froude;

struct Setting {
  const char* file;  // five bodies that feel each other's waves, or one that each of the five is by itself
  double period;     // s
};

void PrintTo(const Setting& s, std::ostream* out) { *out << s.file << " " << s.period << " s"; }

/// Five coupled modules, linear: moored and joined with dampers, so that a run settles.
std::string scene_text(const Setting& setting, const std::string& joined) {
  return fmt::format(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "regular"
amplitude = "0.01 m"
period = "{} s"
heading = "45 deg"
ramp = "100 s"
{}[body.hydrodynamics]
file = "{}"
excitation = true
{}radiation = {{ memory_tolerance = 1e-4, accept_error = 0.5 }}
hydrostatics = true
[[mooring]]
on = ["m*"]
kind = "linear"
stiffness = {{ surge = "4280 N/m", sway = "10348 N/m", yaw = "15839 N m/rad" }}
damping = {{ surge = "4 kN s/m", sway = "4 kN s/m", yaw = "60 kN m s/rad" }}
{}[ask]
run = {{ duration = "400 s", every = "0.1 s", of = ["m*"] }}
accuracy = 1e-3
)",
                     setting.period, support::pontoons(5, "(-26, 0, 0) m"), setting.file,
                     std::string(setting.file) == "pontoon1.nc" ? "interaction = \"self\"\n" : "", joined);
}

const std::string springs = R"([[connector]]
between = "neighbours of m"
ends = ["(6, ±5, 0.5) m", "(-6, ±5, 0.5) m"]
kind = "bushing"
stiffness = "(20, 5, 5) kN/m"
damping = "(2, 2, 2) kN s/m"
)";
const std::string hinges = R"([[joint]]
name = "m_hinge"
between = "neighbours of m"
kind = "hinge"
at = "(-19.5, 0, 0.5) m"
axis = "y"
)";

class Agreement : public testing::TestWithParam<Setting> {};

// One linear scene, two solutions: the frequency domain, and a run in a small regular wave until it is steady.
TEST_P(Agreement, OfTimeAndFrequencyDomainInEveryDegreeOfFreedom) {
  const double period = GetParam().period;
  const double omegas[] = {2 * std::numbers::pi / period};
  const scene::Scene scene = froude_test::parse(scene_text(GetParam(), springs));
  const compile::Prepared prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  const Cells cells{{omegas[0]}, {scene.waves->heading.radians()}};
  const auto found = dynamics::frequency::response_amplitudes(model, prepared.groups, cells.omega, cells.headings, {});
  const froude::Run run = simulate(scene);
  ASSERT_EQ(run.stopped, "");
  std::vector<double> time, values;
  const auto begin = static_cast<std::size_t>(std::lround(300 / 0.1));
  time.assign(run.time.begin() + static_cast<std::ptrdiff_t>(begin), run.time.end());
  double largest[2] = {0, 0};  // translations, rotations
  std::vector<std::complex<double>> from_run, from_rao;
  const dynamics::frequency::SmallMotions about(model);
  for (const auto& probe : compile::signal_list(scene, prepared, model)) {
    if (!probe.name.starts_with("m")) continue;
    if (probe.name.starts_with("mooring")) continue;
    const auto& all = run.signal(probe.name);
    values.assign(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end());
    from_run.push_back(hydro::signal::fit_harmonics(time, values, omegas).amplitude.at(0) / 0.01);
    from_rao.push_back(linear_responses({probe}, about, found, cells).front().values.front());
    double& l = largest[(from_rao.size() - 1) % 6 / 3];
    l = std::max(l, std::abs(from_rao.back()));
  }
  ASSERT_EQ(from_rao.size(), 30u);
  for (std::size_t i = 0; i < from_rao.size(); ++i) {
    if (std::abs(from_rao[i]) < 0.01 * largest[i % 6 / 3]) continue;
    // 1 % is the promise; both solve the same equations, with the memory cut and the step at 1e-3 accuracy.
    EXPECT_LT(std::abs(from_run[i] - from_rao[i]), 0.01 * std::abs(from_rao[i]))
        << "body " << i / 6 + 1 << " " << hydro::mode_names[i % 6] << ", period " << period << " s: run " << from_run[i]
        << ", rao " << from_rao[i];
  }
}

// With interaction the array has resonances narrower than the 0.1 rad/s between the data's frequencies, at periods of 3
// s and less. What lies between the frequencies is told by the poles of what lies at them; at 3 s that is good for 3 %,
// not for 1 (docs/decisions/0006), so the long period is the test there.
// The same with hinges: angles, and what the hinges carry.
TEST(HingeAgreement, OfTimeAndFrequencyDomainInHinges) {
  const double period = 5;
  const std::vector<double> omegas{2 * std::numbers::pi / period};
  const scene::Scene scene = froude_test::parse(scene_text({"pontoon5.nc", period}, hinges));
  const compile::Prepared prepared = compile::prepare(scene);
  const dynamics::Model model = compile::frequency_model(prepared);
  const Cells cells{omegas, {scene.waves->heading.radians()}};
  const auto found = dynamics::frequency::response_amplitudes(model, prepared.groups, cells.omega, cells.headings, {});
  const froude::Run run = simulate(scene);
  ASSERT_EQ(run.stopped, "");
  const auto begin = static_cast<std::ptrdiff_t>(std::lround(300 / 0.1));
  const std::vector<double> time(run.time.begin() + begin, run.time.end());
  std::map<std::string, double> largest;  // by unit
  std::vector<std::tuple<std::string, std::string, std::complex<double>, std::complex<double>>> pairs;
  const dynamics::frequency::SmallMotions about(model);
  for (const auto& probe : compile::signal_list(scene, prepared, model)) {
    if (!probe.name.starts_with("m_hinge")) continue;
    const auto of_rao = linear_responses({probe}, about, found, cells).front().values.front();
    const auto& all = run.signal(probe.name);
    const std::vector<double> values(all.begin() + begin, all.end());
    const auto of_run = hydro::signal::fit_harmonics(time, values, omegas).amplitude.at(0) / 0.01;
    largest[probe.unit] = std::max(largest[probe.unit], std::abs(of_rao));
    pairs.emplace_back(probe.name, probe.unit, of_rao, of_run);
  }
  ASSERT_EQ(pairs.size(), 4u + 4 * 2 * 6);
  for (const auto& [name, unit, of_rao, of_run] : pairs)
    // As above; small loads against the largest of their kind, since what is left over of a run is that of all.
    EXPECT_LT(std::abs(of_run - of_rao), 0.01 * std::abs(of_rao) + 2e-3 * largest[unit])
        << name << ": run " << of_run << ", rao " << of_rao;
}

INSTANTIATE_TEST_SUITE_P(Modules, Agreement,
                         testing::Values(Setting{"pontoon1.nc", 3.0}, Setting{"pontoon1.nc", 5.0},
                                         Setting{"pontoon5.nc", 7.0}));

/// One module that surges, heaves and pitches in a regular wave, its radiation constant.
Run with_constant_radiation(const std::string& solve) {
  return simulate(froude_test::parse(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "regular"
amplitude = "0.1 m"
period = "5 s"
heading = "0 deg"
)" + support::pontoons(1) + R"(free = ["surge", "heave", "pitch"]
initial_velocity = { heave = "0.2 m/s" }
[body.hydrodynamics]
file = "pontoon1.nc"
excitation = true
radiation = { method = "constant" }
hydrostatics = true
[[mooring]]
on = "m1"
kind = "linear"
stiffness = { surge = "4280 N/m" }
[ask]
run = { duration = "40 s", every = "0.1 s", of = ["m1.surge", "m1.heave", "m1.pitch"] }
[solve]
)" + solve));
}

// Constant radiation has no past that whole steps would have to keep: methods that look between steps have it too, from
// the first instant on (Fagerbakke 2023, 4.2 steps so by orders 4 and 5).
TEST(ConstantRadiation, IsTheSameByTheExplicitPair) {
  const froude::Run pair = with_constant_radiation("integrator = { name = \"explicit_pair\" }\n"),
                    fine = with_constant_radiation("step = \"5 ms\"\n");
  for (const char* name : {"m1.surge", "m1.heave", "m1.pitch"}) {
    double largest = 0, off = 0;
    for (std::size_t i = 0; i < pair.time.size(); ++i) {
      largest = std::max(largest, std::abs(fine.signal(name)[i]));
      off = std::max(off, std::abs(pair.signal(name)[i] - fine.signal(name)[i]));
    }
    EXPECT_GT(largest, 1e-3);
    // The finer run's own error: periods of 2 s and more off by (ωh)²/12 = 2e-5, over twenty of them.
    EXPECT_LT(off, 3e-3 * largest) << name;
  }
}

}  // namespace
}  // namespace agreement_test
