// [[wind]] in runs, responses and modes, against closed forms. (D135)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/answers.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scenes.hpp"

namespace compile_wind_test {
namespace {

using namespace froude;
using froude_test::examples;
using testing::HasSubstr;

constexpr double resistance = 0.5 * 1.225 * 1.1 * 6;  // ½ρCA of the example, kg/m
const double speed = 14 * std::pow(3.0 / 10, 0.12), east = std::cos(std::numbers::pi / 6),
             north = std::sin(std::numbers::pi / 6);

std::string text() { return hydro::io::read_text(examples / "windy.toml"); }
std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// What drives it falls as U − v = U/(1 + kUt/m), along the wind.
TEST(Wind, CarriesAFreeBodyAsItsClosedForm) {
  std::string free = text();
  free.erase(free.find("[[mooring]]"), free.find("[[wind]]") - free.find("[[mooring]]"));
  const scene::Scene scene =
      scene::parse(changed(free, "modes = { about = \"equilibrium\" }\n", ""), examples / "windy.toml");
  const auto run = simulate(scene);
  EXPECT_EQ(run.stopped, "");
  const double rate = resistance * speed / 2000, T = run.time.back();
  // ∫ U − U/(1 + rate t) dt; what a run asked for 1 % leaves.
  const double way = speed * (T - std::log1p(rate * T) / rate);
  EXPECT_NEAR(run.signal("buoy.surge").back(), way * east, 1e-3 * way);
  EXPECT_NEAR(run.signal("buoy.sway").back(), way * north, 1e-3 * way);
  const double u = speed / (1 + rate * T);
  EXPECT_NEAR(run.signal("wind1.force_x").back(), resistance * u * u * east, 1e-3 * resistance * u * u);
  EXPECT_EQ(run.signal("wind1.force_z").back(), 0);
}

// ρCAU along the wind, half of it across; both modes have √(k/m).
TEST(Wind, DampsSmallMotionsAboutWhereTheBodyBalances) {
  const Modes modes = free_modes(scene::read(examples / "windy.toml"));
  ASSERT_EQ(modes.count(), 2u);
  const double critical = 2 * std::sqrt(1000.0 * 2000);
  for (const std::size_t mode : {0u, 1u}) {  // one degree of freedom each
    const double swings = std::sqrt(1 - *modes.damping_ratio(mode) * *modes.damping_ratio(mode));
    EXPECT_NEAR(*modes.damped_period(mode) * swings, modes.period(mode), 1e-9 * modes.period(mode));
  }
  std::vector<double> ratios{*modes.damping_ratio(0), *modes.damping_ratio(1)};
  std::sort(ratios.begin(), ratios.end());
  EXPECT_NEAR(ratios[0], resistance * speed / critical, 1e-6 * ratios[0]);
  EXPECT_NEAR(ratios[1], 2 * resistance * speed / critical, 1e-6 * ratios[1]);
  EXPECT_NEAR(modes.omega[0], std::sqrt(0.5), 1e-9);
}

TEST(Wind, SettlesABodyWhereItsMooringBearsIt) {
  const auto run = simulate(scene::read(examples / "windy.toml"));
  // e^{−ζωt} of the slower mode leaves some 1e-2 of the offset after 120 s; the mean of the last swing loses most of
  // it.
  const double offset = resistance * speed * speed / 1000;
  double mean = 0;
  const auto& surge = run.signal("buoy.surge");
  const std::size_t swing = static_cast<std::size_t>(std::lround(2 * std::numbers::pi / std::sqrt(0.5) / 0.1));
  for (std::size_t i = surge.size() - swing; i < surge.size(); ++i) mean += surge[i] / static_cast<double>(swing);
  EXPECT_NEAR(mean, offset * east, 0.02 * offset);
}

TEST(Wind, BelowTheWaterIsRefusedAtItsTable) {
  const scene::Scene scene = scene::parse(changed(text(), "(0, 0, 3) m", "(0, 0, -3) m"), examples / "windy.toml");
  EXPECT_THAT([&] { free_modes(scene); }, testing::ThrowsMessage<hydro::InputError>(testing::AllOf(
                                              HasSubstr("windy.toml:19:"), HasSubstr("3 m below still water"))));
}

TEST(Wind, LetsNoBodyBalanceAsPlaced) {
  const scene::Scene scene =
      scene::parse(changed(text(), "modes = { about = \"equilibrium\" }", "modes = {}"), examples / "windy.toml");
  EXPECT_THAT([&] { free_modes(scene); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("not in equilibrium as placed")));
}

}  // namespace
}  // namespace compile_wind_test
