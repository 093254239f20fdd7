#include "compile/waves.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace froude::compile::waves_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

scene::Scene scene_of(const std::string& waves, const std::string& more = {}, const std::string& accuracy = {}) {
  return scene::parse(
      "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n" + more + "[waves]\nheading = \"0 deg\"\n" +
          waves + "[[probe]]\nat = \"(0, 0, 0) m\"\n[ask]\nwaves = { duration = \"10 s\", every = \"0.5 s\" }\n" +
          accuracy,
      "scene.toml");
}

const std::string jonswap = "kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\n";

TEST(SeaOfAScene, CarriesAllButAHundredthOfTheAccuracyOnEitherSide) {
  const auto sea = make_sea(scene_of(jonswap));
  EXPECT_LT(sea.fraction_left_out(), 2.1e-4);  // 1e-4 on either side, whole bins
  EXPECT_GT(sea.fraction_left_out(), 0);
  EXPECT_NEAR(sea.hs(), 3, 3 * 1.1e-4);
  EXPECT_EQ(sea.repetition_s(), 1800);
  const auto finer = make_sea(scene_of(jonswap, {}, "accuracy = 1e-4\n"));
  EXPECT_LT(finer.fraction_left_out(), 2.1e-6);
}

TEST(SeaOfAScene, StaysInsideTheDataAndSaysIfTheyAreTooNarrow) {
  const auto sea = make_sea(scene_of(jonswap), Band{0.3, 3.0});
  for (const auto& w : sea.components()) {
    EXPECT_GE(w.omega, 0.3 - 1e-9);
    EXPECT_LE(w.omega, 3.0 + 1e-9);
  }
  EXPECT_THAT(
      [] {
        make_sea(scene_of(jonswap), Band{0.3, 1.0});
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("scene.toml:5:1"), HasSubstr("lies outside the frequencies"))));
}

TEST(SeaOfAScene, DoesNotDependOnHowLongARecordIsTaken) {
  const auto text = [](const char* duration) {
    return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n[waves]\nheading = \"0 deg\"\n" +
           jonswap + "[[probe]]\nat = \"(0, 0, 0) m\"\n[ask]\nwaves = { duration = \"" + duration +
           "\", every = \"0.5 s\" }\n";
  };
  const auto brief = make_sea(scene::parse(text("10 s"), "a.toml")),
             lengthy = make_sea(scene::parse(text("900 s"), "a.toml"));
  ASSERT_EQ(brief.components().size(), lengthy.components().size());
  EXPECT_EQ(brief.elevation(7, 3, 4), lengthy.elevation(7, 3, 4));
}

TEST(SeaOfAScene, SystemsOfASumHavePhasesOfTheirOwn) {
  const std::string part = "[[waves.part]]\nkind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\nheading = \"0 deg\"\n";
  const auto sea = make_sea(scene_of("kind = \"sum\"\n" + part + part));
  const auto& w = sea.components();
  ASSERT_EQ(w.size() % 2, 0u);
  EXPECT_NE(w[0].phase, w[w.size() / 2].phase);
  EXPECT_EQ(w[0].omega, w[w.size() / 2].omega);
  EXPECT_NEAR(sea.hs(), 3 * std::numbers::sqrt2, 1e-3);
  EXPECT_EQ(sea.repetition_s(), 1800);
}

TEST(SeaOfAScene, RefusesWhatBreaks) {
  EXPECT_THAT([] { make_sea(scene_of("kind = \"regular\"\nheight = \"10 m\"\nperiod = \"5 s\"\n")); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("scene.toml:5:1"), HasSubstr("beyond breaking"), HasSubstr("the highest wave"))));
  EXPECT_THAT([] { make_sea(scene_of("kind = \"jonswap\"\nhs = \"12 m\"\ntp = \"5 s\"\n")); },
              ThrowsMessage<InputError>(HasSubstr("beyond breaking")));
}

TEST(SeaOfAScene, PutsTheCrestWhereTheSceneWantsIt) {
  const std::string crest = "crest = { height = \"4 m\", position = \"(5, 0, 0) m\", time = \"60 s\" }\n";
  EXPECT_NEAR(make_sea(scene_of(jonswap + crest)).elevation(60, 5, 0), 4, 1e-10);
  const std::string alone =
      "crest = { height = \"4 m\", position = \"(5, 0, 0) m\", time = \"60 s\", around = \"nothing\" }\n";
  const auto group = make_sea(scene_of(jonswap + alone));
  EXPECT_NEAR(group.elevation(60, 5, 0), 4, 1e-10);
  EXPECT_LT(std::abs(group.elevation(300, 5, 0)), 0.2);
}

// Bound waves lift it by a tenth of a metre and more, which the free crest then lacks.
TEST(FieldOfAScene, HasTheCrestAskedForTogetherWithItsBoundWaves) {
  const std::string place = "position = \"(5, 0, 0) m\", time = \"60 s\"";
  for (const std::string around : {"", ", around = \"nothing\""}) {
    const auto scene = scene_of(jonswap +
                                "components = { repetition = \"5 min\", highest = \"0.25 Hz\" }\nsecond_order = "
                                "true\ncrest = { height = \"4 m\", " +
                                place + around + " }\n");
    EXPECT_NEAR(make_field(scene)->elevation(60, 5, 0), 4, 1e-6);
    EXPECT_LT(free_waves(scene).elevation(60, 5, 0), 3.9);
  }
}

TEST(FieldOfAScene, OfARegularWaveFollowsItsTheory) {
  const auto field = [](const std::string& theory) {
    return make_field(
        scene_of("kind = \"regular\"\nheight = \"4 m\"\nperiod = \"9 s\"\ntheory = \"" + theory + "\"\n"));
  };
  EXPECT_NEAR(field("linear")->elevation(0, 0, 0), 2, 1e-14);
  const double stream = field("stream")->elevation(0, 0, 0), fifth = field("stokes5")->elevation(0, 0, 0),
               second = field("stokes2")->elevation(0, 0, 0);
  EXPECT_GT(stream, 2.2);  // crests are higher than half the height
  EXPECT_NEAR(fifth, stream, 0.03);
  EXPECT_NEAR(second, stream, 0.2);
  for (const char* theory : {"stokes2", "stokes5", "stream"}) {
    const auto f = field(theory);
    double low = 0;
    for (double t = 0; t < 9; t += 0.01) low = std::min(low, f->elevation(t, 0, 0));
    EXPECT_NEAR(f->elevation(0, 0, 0) - low, 4, 1e-3) << theory;
  }
}

TEST(FieldOfAScene, TakesTheStretchingOfTheScene) {
  const std::string regular = "kind = \"regular\"\nheight = \"4 m\"\nperiod = \"9 s\"\n";
  const auto at_crest = [&](const std::string& how) {
    return make_field(scene_of(regular + "kinematics = { above_still_water = \"" + how + "\" }\n"))
        ->at(0, {0, 0, 2})
        .velocity.x();
  };
  EXPECT_LT(at_crest("vertical"), at_crest("linear"));
  EXPECT_LT(at_crest("linear"), at_crest("none"));
  EXPECT_NEAR(at_crest("wheeler"), at_crest("vertical"), 1e-14);
}

TEST(FieldOfAScene, RefusesACurrentWhereItsTheoryHasNone) {
  const std::string current = "[current]\nvelocity = \"(0, 1, 0) m/s\"\n";
  EXPECT_THAT(
      [&] {
        make_field(scene_of("kind = \"regular\"\nheight = \"4 m\"\nperiod = \"9 s\"\ntheory = \"stream\"\n", current));
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("scene.toml:5:1"), HasSubstr("along its heading only"))));
}

TEST(SeaOfAScene, NonlinearWavesAreNoSum) {
  const auto stream = scene_of("kind = \"regular\"\nheight = \"4 m\"\nperiod = \"9 s\"\ntheory = \"stream\"\n");
  EXPECT_FALSE(is_linear_sum(*stream.waves));
  EXPECT_THAT([&] { make_sea(stream); }, ThrowsMessage<InputError>(HasSubstr("not a sum of linear waves")));
  const auto bound = scene_of(jonswap + "second_order = true\n");
  EXPECT_THAT([&] { make_sea(bound); }, ThrowsMessage<InputError>(HasSubstr("not a sum of linear waves")));
  EXPECT_TRUE(has_bound_waves(*bound.waves));
}

TEST(SteadyWaveOfAScene, ThatBreaksIsRefusedByEveryTheory) {
  // 3 m in 3 s: 0.16 of the length of 18.3 m that the fifth order gives, and 0.21 of the linear one; 0.14 is the limit.
  for (const char* theory : {"linear", "stokes2", "stokes5"})
    EXPECT_THAT(
        [&] {
          make_field(scene_of(std::string("kind = \"regular\"\nheight = \"3 m\"\nperiod = \"3 s\"\ntheory = \"") +
                              theory + "\"\n"));
        },
        ThrowsMessage<InputError>(AllOf(HasSubstr("scene.toml:5:1"), HasSubstr("is beyond breaking"))))
        << theory;
}

TEST(WaveWarnings, TellWhatIsNearALimitWithItsNumbers) {
  const auto regular = [](const char* height, const char* period) {
    return wave_warnings(
        scene_of(std::string("kind = \"regular\"\nheight = \"") + height + "\"\nperiod = \"" + period + "\"\n"));
  };
  EXPECT_THAT(regular("0.5 m", "8 s"), testing::IsEmpty());
  // 20 m deep: a wave of 30 s is 418 m long, Hλ²/h³ = 3 · 418² / 8000 = 65.
  EXPECT_THAT(regular("3 m", "30 s"), testing::Contains(HasSubstr("is above 26")));
  EXPECT_THAT(wave_warnings(scene_of(jonswap)), testing::IsEmpty());
  // 2π·6/(9.81·36) = 0.107, above 1/15.
  EXPECT_THAT(wave_warnings(scene_of("kind = \"jonswap\"\nhs = \"6 m\"\ntp = \"6 s\"\n")),
              testing::ElementsAre(AllOf(HasSubstr("0.107"), HasSubstr("0.0667"))));
}

}  // namespace
}  // namespace froude::compile::waves_test
