#include "hydro/waves/kinematics/limits.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "support/fresh_waters.hpp"

namespace hydro::waves::limits_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

using support::deep;
using support::water_of;

WaveLimits of(double height, double length, const Water& water) {
  return wave_limits({.height_m = height, .length = Wavelength::from_metres(length), .water = water});
}

TEST(WaveLimits, HighestWaveHasItsKnownLimits) {
  EXPECT_NEAR(highest_wave(100, WaterDepth::infinite()) / 100, 0.1411, 1e-4);  // Michell's wave; Williams: 0.14106
  EXPECT_NEAR(highest_wave(1e6, WaterDepth::from_metres(1)), 0.8332, 2e-4);    // solitary wave: 0.83320
  EXPECT_NEAR(highest_wave(100, WaterDepth::from_metres(1e5 - 1)) / highest_wave(100, WaterDepth::infinite()), 1, 2e-5);
  for (double r = 1; r < 200; r *= 1.3)  // never above either, and rising with the length
    EXPECT_LT(highest_wave(r, WaterDepth::from_metres(1)), highest_wave(1.3 * r, WaterDepth::from_metres(1)));
}

TEST(WaveLimits, RegionsStandWhereTheChartHasThem) {
  // Deep water, H/gT² = (H/λ)/2π: the chart's lines are near 0.001, 0.008 and 0.02.
  EXPECT_EQ(of(0.0055 * 100, 100, deep).region, WaveRegion::linear);
  EXPECT_EQ(of(0.007 * 100, 100, deep).region, WaveRegion::stokes_second);
  EXPECT_EQ(of(0.048 * 100, 100, deep).region, WaveRegion::stokes_second);
  EXPECT_EQ(of(0.055 * 100, 100, deep).region, WaveRegion::stokes_third);
  EXPECT_EQ(of(0.105 * 100, 100, deep).region, WaveRegion::stokes_fifth);
  EXPECT_EQ(of(0.13 * 100, 100, deep).region, WaveRegion::near_breaking);
  EXPECT_EQ(of(0.15 * 100, 100, deep).region, WaveRegion::breaking);
  EXPECT_EQ(of(0.3, 40, water_of(1)).region, WaveRegion::cnoidal);
  EXPECT_EQ(of(1e-5, 40, water_of(1)).region, WaveRegion::linear);
}

TEST(WaveLimits, WarnsWithTheNumbers) {
  EXPECT_THAT(of(1, 100, deep).warnings, IsEmpty());
  EXPECT_THAT(of(0.3, 10, water_of(1)).warnings, Contains(HasSubstr("= 30 is above 26")));
  EXPECT_THAT(of(0.25, 10, water_of(1)).warnings, IsEmpty());  // 25
  EXPECT_THAT(of(0.8, 40, water_of(1)).warnings, Contains(HasSubstr("H/h = 0.8 is above 0.78")));
  EXPECT_THAT(of(14.3, 100, deep).warnings, Contains(HasSubstr("H/λ = 0.143 is above 0.142")));
  const double kh = 2 * std::numbers::pi * 0.1;
  const WaveLimits shoaling = of(0.1421 * std::tanh(kh) * 10, 10, water_of(1));
  EXPECT_THAT(shoaling.warnings, Contains(HasSubstr("Miche")));
  EXPECT_NEAR(shoaling.miche, 0.142 * 10 * std::tanh(kh), 1e-14);
}

TEST(WaveLimits, DepthRegimes) {
  EXPECT_EQ(of(0.01, 21, water_of(1)).depth_regime, DepthRegime::shallow);
  EXPECT_EQ(of(0.01, 19, water_of(1)).depth_regime, DepthRegime::intermediate);
  EXPECT_EQ(of(0.01, 1.9, water_of(1)).depth_regime, DepthRegime::deep);
  EXPECT_EQ(of(0.01, 1.9, deep).ursell, 0);
  EXPECT_EQ(name(DepthRegime::deep), "deep");
  EXPECT_EQ(name(WaveRegion::stokes_fifth), "Stokes fifth order");
}

TEST(WaveLimits, RefuseWhatIsNoWave) {
  EXPECT_THAT([] { (void)of(0, 10, deep); }, ThrowsMessage<InputError>(HasSubstr("wave height")));
  EXPECT_THAT([] { (void)highest_wave(-1, WaterDepth::infinite()); }, ThrowsMessage<InputError>(HasSubstr("-1 m")));
}

}  // namespace
}  // namespace hydro::waves::limits_test
