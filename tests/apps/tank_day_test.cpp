// The day at a tank, from volts to coefficients: the scenes of examples/tank_day against what make_tank_day.py put in.
#include <algorithm>
#include <cmath>
#include <utility>

#include "fit_fixture.hpp"

namespace fit_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(TankDay, CalibratesItsGauge) {
  const auto j = tree("gauge.toml")["run"][0];
  EXPECT_TRUE(holds(j["slope"], 25)) << j["slope"];
  EXPECT_TRUE(holds(j["drift"], 2e-3 / 60)) << j["drift"];
  EXPECT_LT(j["hysteresis"].get<double>(), 0.01);
  EXPECT_THAT(told({.scene = folder / "gauge.toml"}), HasSubstr("drifts by 0.03"));
}

TEST_F(TankDay, TellsDragOfItsTows) {
  const auto j = tree("tows.toml");
  for (const auto& run : j["run"]) EXPECT_TRUE(holds(run["cd"], 1.18)) << run["cd"];
  EXPECT_THAT(told({.scene = folder / "tows.toml"}), HasSubstr("calibration: V1 has 0.0933"));
}

TEST_F(TankDay, TellsDragAndAddedMassOfItsSwing) {
  const auto run = tree("swing.toml")["run"][0];
  EXPECT_TRUE(holds(run["cd"], 2.3)) << run["cd"];
  EXPECT_TRUE(holds(run["ca"], 1.1)) << run["ca"];
}

TEST_F(TankDay, TellsTheResponseOfItsFloat) {
  const auto j = tree("waves.toml");
  for (const auto& run : j["run"]) {
    const auto& r = run["response"][0];
    EXPECT_TRUE(holds(r["rao"], 1.4)) << r["rao"];  // slopes of gauge and potentiometer are known to 0.1 % each
    EXPECT_GT(r["rao"]["systematic_error"].get<double>(), 1e-3);
    EXPECT_NEAR(r["phase_rad"].get<double>(), -0.5, 0.02);
  }
  EXPECT_NEAR(j["repeated"][0]["median"].get<double>(), 1.4, 0.01);
  EXPECT_THAT(told({.scene = folder / "waves.toml"}),
              AllOf(HasSubstr("gauge by gauge.csv"), HasSubstr("in the intervals")));
}

/// What the float does of irregular waves, as make_tank_day.py has it: m/m and the phase before the wave, rad.
std::pair<double, double> truth_at(double hz) {
  const double r = hz / 0.9;
  return {1 / std::hypot(1 - r * r, 0.5 * r), -std::atan2(0.5 * r, 1 - r * r)};
}

TEST_F(TankDay, TellsTheTransferFunctionOfItsFloat) {
  const auto j = tree("sea.toml");
  EXPECT_EQ(j["segments"], 36);
  const auto& r = j["response"][0];
  EXPECT_EQ(r["name"], "float");
  EXPECT_EQ(r["unit"], "m/m");
  const auto &f = j["frequency_hz"], &waves = j["wave_density_m2_hz"];
  ASSERT_EQ(f.size(), r["gain_h1"].size());
  const double highest = *std::max_element(waves.begin(), waves.end());
  int told = 0, held = 0;
  for (std::size_t k = 1; k < f.size(); ++k) {
    if (waves[k].get<double>() < 0.1 * highest) continue;
    const auto [gain, phase] = truth_at(f[k].get<double>());
    ++told;
    held += r["gain_h1_low"][k].get<double>() < gain && gain < r["gain_h1_high"][k].get<double>() ? 1 : 0;
    EXPECT_NEAR(r["gain_h2"][k].get<double>() / gain, 1, 0.05);  // the resonance is 0.45 Hz wide, a segment's band 0.06
    EXPECT_NEAR(r["phase_rad"][k].get<double>(), phase, 0.06);
    EXPECT_GT(r["coherence"][k].get<double>(), 0.98);
  }
  EXPECT_GT(told, 12);
  EXPECT_GE(held, 0.8 * told);  // neighbours share their segments, so that the share scatters
  EXPECT_GT(r["at_peak"]["systematic_error"].get<double>(), 1e-3);  // both lines
}

TEST_F(TankDay, DrawsAndTabulatesTheTransferFunction) {
  const std::string text = told({.scene = folder / "sea.toml", .table = folder / "s.csv", .picture = folder / "s.svg"});
  EXPECT_THAT(text, AllOf(HasSubstr("36 segments of 24 s from 3 runs"), HasSubstr("float at the waves' peak, 0.66"),
                          HasSubstr("coherence 0.99"), HasSubstr("gauge by gauge.csv")));
  const std::string table = text_of("s.csv");
  EXPECT_THAT(table, HasSubstr("response,unit,frequency [Hz],wave_density [m^2/Hz],gain_h1,gain_h1_low,gain_h1_high,"
                               "gain_h2,phase [deg],coherence\n"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 151);  // a heading, and up to half of 12.5 Hz by 1/24 Hz
  EXPECT_THAT(table, HasSubstr(",,,,,,"));                       // no gain where channels may be unrelated
  EXPECT_THAT(text_of("s.svg"),
              AllOf(HasSubstr("waves [m²/Hz]"), HasSubstr("float gain [m/m]"), HasSubstr("float phase [deg]"),
                    HasSubstr("coherence"), HasSubstr("H1"), HasSubstr("H2"), HasSubstr("frequency [Hz]"),
                    HasSubstr("unrelated channels stay below")));
}

TEST_F(TankDay, TellsHowLateItsFilmIs) {
  const auto run = tree("delay.toml")["run"][0];
  EXPECT_TRUE(holds(run["delay"], 3.418)) << run["delay"];
  EXPECT_LT(run["delay"]["standard_error"].get<double>(), 2e-3);
  EXPECT_LT(run["correlation"].get<double>(), -0.99);  // pixels count downwards
  EXPECT_LT(run["chance"].get<double>(), 0.01);
  EXPECT_NEAR(run["scale"].get<double>(), -12.0 / 2400, 2e-5);  // V per pixel
}

TEST_F(TankDay, DrawsItsFilmMovedOntoThePotentiometer) {
  const std::string text =
      told({.scene = folder / "delay.toml", .output = folder / "d.toml", .picture = folder / "d.svg"});
  EXPECT_THAT(text,
              AllOf(HasSubstr("let_go.csv: y behind float"), HasSubstr("delay      3.41"), HasSubstr("float = 5.06")));
  EXPECT_THAT(text_of("d.toml"), AllOf(HasSubstr("[run.delay]"), HasSubstr("interval = [3.41")));
  EXPECT_THAT(text_of("d.svg"),
              AllOf(HasSubstr("time [s]"), HasSubstr("float of let_go.csv [V]"), HasSubstr("s earlier and scaled")));
}

}  // namespace
}  // namespace fit_test
