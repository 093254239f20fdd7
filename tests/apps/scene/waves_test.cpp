#include <cmath>
#include <fstream>
#include <numbers>

#include "apps/scene/scenes.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "support/scratch.hpp"

namespace froude::scene::waves_test {
namespace {

namespace hw = hydro::waves;

/// A scene without bodies: water, waves, one probe.
std::string sea(const std::string& waves, const std::string& more = {}) {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n[waves]\nheading = \"10 deg\"\n" + waves +
         more + "[[probe]]\nat = \"(0, 0, 0) m\"\n[ask]\nwaves = { duration = \"10 s\", every = \"0.5 s\" }\n";
}

Waves waves_of(const std::string& text, const std::string& more = {}) {
  return *parse(sea(text, more), "scene.toml").waves;
}
RandomSea random_of(const std::string& text, const std::string& more = {}) {
  return std::get<RandomSea>(waves_of(text, more).kind);
}

class SceneWaveFiles : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Scene read_as(const std::string& text) { return parse(text, folder_ / "scene.toml"); }
  std::string refused(const std::string& text) {
    try {
      read_as(text);
    } catch (const hydro::InputError& e) {
      return e.what();
    }
    return "accepted";
  }
  std::filesystem::path folder_ =
      support::scratch_folder() /
      (std::string("waves_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST(SceneSpectra, HaveTheHeightsAndPeriodsThatAreWritten) {
  const std::string hs_tp = "hs = \"3 m\"\ntp = \"9 s\"\n";
  for (const char* kind : {"jonswap", "pierson-moskowitz", "torsethaugen", "wallops"}) {
    const auto system = random_of("kind = \"" + std::string(kind) + "\"\n" + hs_tp).systems.at(0);
    EXPECT_EQ(system.kind, kind);
    EXPECT_NEAR(system.spectrum->hs(), 3, 1e-9) << kind;
    EXPECT_NEAR(system.heading.degrees(), 10, 1e-12);
  }
  EXPECT_NEAR(random_of("kind = \"tma\"\n" + hs_tp).systems[0].spectrum->hs(), 3, 1e-9);
  const auto swell = random_of("kind = \"swell\"\nhs = \"1 m\"\ntp = \"14 s\"\nwidth = \"0.006 Hz\"\n");
  EXPECT_NEAR(swell.systems[0].spectrum->tp(), 14, 1e-9);
  const auto two = random_of(
      "kind = \"ochi-hubble\"\nhs_low = \"2 m\"\ntp_low = \"13 s\"\nlambda_low = 3\nhs_high = \"1 m\"\ntp_high = \"6 "
      "s\"\n"
      "lambda_high = 1.5\n");
  EXPECT_NEAR(two.systems[0].spectrum->hs(), std::sqrt(5), 1e-9);  // energies add
}

TEST(SceneSpectra, TakeTheMeanPeriodOfUpCrossingsInsteadOfThePeak) {
  const auto sea_of = random_of("kind = \"jonswap\"\nhs = \"3 m\"\ntz = \"7 s\"\n");
  EXPECT_NEAR(sea_of.systems[0].spectrum->tz(), 7, 1e-9);
  EXPECT_THAT(refusal(sea("kind = \"jonswap\"\nhs = \"3 m\"\ntz = \"7 s\"\ntp = \"9 s\"\n")),
              HasSubstr("may hold only one of tp, tz"));
}

TEST(SceneSpectra, AreRefusedWhereNoSeaHasThem) {
  EXPECT_THAT(refusal(sea("kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\ngamma = 0.8\n")),
              AllOf(StartsWith("scene.toml:10:9: "), HasSubstr("gamma = 0.8 must be at least 1")));
  EXPECT_THAT(refusal(sea("kind = \"jonswap\"\nhs = \"0 m\"\ntp = \"9 s\"\n")), HasSubstr("must be positive"));
  EXPECT_THAT(refusal(sea("kind = \"torsethaugen\"\nhs = \"3 m\"\ntp = \"90 s\"\n")), StartsWith("scene.toml:7:8: "));
  EXPECT_THAT(refusal(sea("kind = \"jonswop\"\nhs = \"3 m\"\ntp = \"9 s\"\n")), HasSubstr("jonswap"));
}

TEST(SceneSpreading, IsThatOfItsKind) {
  const auto spread = [](const std::string& spreading) {
    return random_of("kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\nspreading = " + spreading + "\n")
        .systems[0]
        .spreading;
  };
  const auto zero = hydro::Angle::from_radians(0), quarter = hydro::Angle::from_degrees(90);
  EXPECT_NEAR(spread("{ kind = \"cosn\", n = 2 }")->density(zero, 1), 2 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(spread("{ kind = \"cos2s\", s = 1 }")->density(zero, 1), 1 / std::numbers::pi, 1e-12);  // cos²(θ/2)/π
  const double peak = 2 * std::numbers::pi / 9;
  const auto goda = spread("{ kind = \"mitsuyasu\", s_max = 25 }");
  EXPECT_GT(goda->density(zero, peak), goda->density(zero, 2 * peak));  // narrowest at the peak
  EXPECT_LT(spread("{ kind = \"wrapped-normal\", deviation = \"10 deg\" }")->density(quarter, 1), 1e-15);
  EXPECT_GT(spread("{ kind = \"von-mises\", kappa = 4 }")->density(zero, 1), 0.7);
  EXPECT_THAT(refusal(sea("kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\nspreading = { kind = \"cosn\", n = -2 }\n")),
              HasSubstr("must be positive"));
}

TEST(SceneComponents, SayHowTheSpectrumIsCut) {
  const std::string jonswap = "kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\n";
  EXPECT_EQ(std::get<hw::FftGrid>(random_of(jonswap).bins).repetition_s, 1800);
  EXPECT_EQ(std::get<hw::FftGrid>(random_of(jonswap + "components = { repetition = \"3 h\" }\n").bins).repetition_s,
            10800);
  EXPECT_EQ(std::get<hw::EqualEnergy>(random_of(jonswap + "components = { equal_energy = 50 }\n").bins).count, 50u);
  const RandomSea random =
      random_of(jonswap + "components = { random = 60, highest = \"0.5 Hz\", amplitudes = \"rayleigh\" }\n");
  EXPECT_EQ(std::get<hw::RandomInBin>(random.bins).count, 60u);
  EXPECT_NEAR(*random.highest, std::numbers::pi, 1e-14);
  EXPECT_EQ(random.amplitudes, hw::Amplitudes::rayleigh);
  EXPECT_THAT(refusal(sea(jonswap + "components = { random = 60, equal_energy = 3 }\n")), HasSubstr("only one of"));
}

TEST(SceneSums, HoldSystemsWithHeadingsOfTheirOwn) {
  const std::string parts =
      "[[waves.part]]\nkind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\nheading = \"40 deg\"\n"
      "[[waves.part]]\nkind = \"swell\"\nhs = \"1 m\"\ntp = \"15 s\"\nwidth = \"0.006 Hz\"\nheading = \"-20 deg\"\n"
      "spreading = { kind = \"cos2s\", s = 60 }\n";
  const RandomSea sum = random_of("kind = \"sum\"\n", parts);
  ASSERT_EQ(sum.systems.size(), 2u);
  EXPECT_NEAR(sum.systems[0].heading.degrees(), 40, 1e-12);
  EXPECT_FALSE(sum.systems[0].spreading);
  EXPECT_TRUE(sum.systems[1].spreading);
  EXPECT_THAT(refusal(sea("kind = \"sum\"\n")), HasSubstr("needs the key \"part\""));
}

TEST(SceneRegularWaves, NameTheirTheory) {
  const std::string regular = "kind = \"regular\"\nheight = \"2 m\"\nperiod = \"8 s\"\n";
  EXPECT_EQ(std::get<RegularWave>(waves_of(regular).kind).theory, RegularTheory::linear);
  EXPECT_EQ(std::get<RegularWave>(waves_of(regular + "theory = \"stream\"\n").kind).theory,
            RegularTheory::stream_function);
  EXPECT_THAT(refusal(sea(regular + "theory = \"stokes3\"\n")),
              HasSubstr("is not one of linear, stokes2, stokes5, stream"));
}

TEST_F(SceneWaveFiles, ListsGiveTheirWavesInOurConvention) {
  write("list.csv", "period [s],height [m],phase [deg],heading [deg]\n8,2,90,5\n5,1,0,-5\n");
  const Scene scene = read_as(sea("kind = \"components\"\nfile = \"list.csv\"\n"));
  const auto& list = std::get<WaveList>(scene.waves->kind).waves;
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NEAR(list[0].omega.period_s(), 8, 1e-14);
  EXPECT_NEAR(list[0].amplitude.metres(), 1, 1e-15);  // half the height
  EXPECT_NEAR(list[0].phase, std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(list[1].heading.degrees(), 5, 1e-12);  // added to the heading of the scene
  const Scene other = read_as(sea("kind = \"components\"\nfile = \"list.csv\"\nphase_of = \"k x - omega t\"\n"));
  EXPECT_NEAR(std::get<WaveList>(other.waves->kind).waves[0].phase, -std::numbers::pi / 2, 1e-15);
}

TEST_F(SceneWaveFiles, ListsMayCarryTheirUnitsInTheNames) {
  write("list.csv", "frequency_Hz,amplitude_m,phase_rad\n0.1,0.5,1\n");
  const Scene scene = read_as(sea("kind = \"components\"\nfile = \"list.csv\"\n"));
  EXPECT_NEAR(std::get<WaveList>(scene.waves->kind).waves[0].omega.hertz(), 0.1, 1e-15);
}

TEST_F(SceneWaveFiles, ListsThatAreNoneAreRefusedAtTheirRow) {
  write("list.csv", "period [s],amplitude [m],phase [rad]\n8,1,0\n-5,1,0\n");
  EXPECT_THAT(refused(sea("kind = \"components\"\nfile = \"list.csv\"\n")),
              AllOf(HasSubstr("list.csv:3"), HasSubstr("positive period")));
  write("list.csv", "period [s],amplitude [m]\n8,1\n");
  EXPECT_THAT(refused(sea("kind = \"components\"\nfile = \"list.csv\"\n")),
              HasSubstr("a list of waves needs a column phase"));
  write("list.csv", "period [s],amplitude [m],phase [rad]\n8,-1,0\n");
  EXPECT_THAT(refused(sea("kind = \"components\"\nfile = \"list.csv\"\n")), HasSubstr("amplitude cannot be negative"));
  write("list.csv", "period [s],amplitude [m],phase [rad]\n");
  EXPECT_THAT(refused(sea("kind = \"components\"\nfile = \"list.csv\"\n")), HasSubstr("list.csv"));
}

TEST_F(SceneWaveFiles, TablesOfSpectraAndCurrentsAreRead) {
  write("s.csv", "frequency [Hz],density [m^2/Hz]\n0.05,0\n0.1,10\n0.2,0\n");
  write("u.csv", "z [m],u [m/s],v [m/s]\n-20,0,0\n0,1,0.5\n");
  const Scene scene = read_as(sea("kind = \"tabulated\"\nfile = \"s.csv\"\n", "[current]\nfile = \"u.csv\"\n"));
  const auto& spectrum = *std::get<RandomSea>(scene.waves->kind).systems[0].spectrum;
  EXPECT_NEAR(spectrum.moment(0), 0.5 * 0.15 * 10, 1e-12);  // area of the triangle
  EXPECT_NEAR(scene.current.at(-10).x(), 0.5, 1e-15);
  write("u.csv", "z [m],u [m/s],v [m/s]\n0,1,0.5\n-20,0,0\n");
  EXPECT_THAT(refused(sea("kind = \"tabulated\"\nfile = \"s.csv\"\n", "[current]\nfile = \"u.csv\"\n")),
              AllOf(HasSubstr("scene.toml"), HasSubstr("must increase")));
}

TEST_F(SceneWaveFiles, TanksHaveAPaddleWithARecord) {
  write("m.csv", "time [s],displacement [m]\n0,0\n0.1,0.01\n0.2,0\n");
  const std::string tank = "kind = \"tank\"\nlength = \"30 m\"\n",
                    maker = "[waves.wavemaker]\nfile = \"m.csv\"\nlowest = \"0.2 Hz\"\nhighest = \"1 Hz\"\n";
  const auto at_zero = [](std::string text) {
    return with(std::move(text), "heading = \"10 deg\"", "heading = \"0 deg\"");
  };
  const Scene scene = read_as(at_zero(sea(tank, maker + "kind = \"flap\"\nhinge = \"-20 m\"\n")));
  const WaveTank& t = std::get<WaveTank>(scene.waves->kind);
  EXPECT_EQ(*t.hinge, -20);
  EXPECT_NEAR(t.step, 0.1, 1e-15);
  EXPECT_FALSE(t.active_absorption);
  const Scene absorbing = read_as(at_zero(sea(tank, maker + "kind = \"piston\"\nactive_absorption = true\n")));
  EXPECT_TRUE(std::get<WaveTank>(absorbing.waves->kind).active_absorption);
  EXPECT_THAT(refused(at_zero(sea(tank, maker + "kind = \"flap\"\n"))), HasSubstr("needs the height of its hinge"));
  EXPECT_THAT(refused(at_zero(sea(tank, maker + "kind = \"piston\"\nhinge = \"-1 m\"\n"))),
              HasSubstr("belongs to a flap"));
  EXPECT_THAT(refused(sea(tank, maker + "kind = \"piston\"\n")), HasSubstr("go towards +x"));
}

TEST(SceneProbes, AreNamedAndTellWhatTheyAreAskedFor) {
  const Scene scene =
      parse(sea("kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\n",
                "[[probe]]\nname = \"deep\"\nat = \"(1, 2, -5) m\"\ngives = [\"velocity\", \"pressure\"]\n"),
            "scene.toml");
  ASSERT_EQ(scene.probes.size(), 2u);
  EXPECT_EQ(scene.probes[0].name, "deep");
  EXPECT_FALSE(scene.probes[0].elevation);
  EXPECT_TRUE(scene.probes[0].velocity && scene.probes[0].pressure);
  EXPECT_EQ(scene.probes[1].name, "probe1");
  EXPECT_TRUE(scene.probes[1].elevation);
}

TEST(SceneProbes, MotionNeedsBodiesAndWavesNeedProbes) {
  const std::string water = "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"20 m\"\n";
  EXPECT_THAT(refusal(water + "[ask]\nrun = { duration = \"10 s\", every = \"0.5 s\" }\n"),
              AllOf(HasSubstr("asks for motion, but the scene has no body"), HasSubstr("add a [[body]]")));
  EXPECT_THAT(refusal(water + "[waves]\nheading = \"0 deg\"\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"5 "
                              "s\"\n[ask]\nwaves = { duration = \"10 "
                              "s\", every = \"0.5 s\" }\n"),
              HasSubstr("needs a point at which the water is told"));
  EXPECT_THAT(refusal(water + "[ask]\nwaves = { duration = \"10 s\", every = \"0.5 s\" }\n"),
              HasSubstr("add a [waves] table"));
}

}  // namespace
}  // namespace froude::scene::waves_test
