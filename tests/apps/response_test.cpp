// `froude response` and `froude fatigue` through the functions that main.cpp calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "answers/linear_response.hpp"
#include "answers/response_check.hpp"
#include "answers/response_spectra.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "support/scratch.hpp"

namespace response_test {
namespace {

using froude::FatigueArguments, froude::ResponseArguments, hydro::InputError;
using testing::HasSubstr, testing::ThrowsMessage;

/// An upright cylinder, alike from all sides, with a linear mooring.
std::string scene_text(const std::string& waves, const std::string& ask = "") {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "60 m"
[waves]
)" + waves +
         R"(
[[body]]
name = "buoy"
mass = "603.2 t"
centre_of_gravity = "(0, 0, -8) m"
radii_of_gyration = "(4, 4, 3) m"
[body.hydrodynamics]
excitation = true
radiation = {}
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "8 m"
draught = "12 m"
frequencies = "0.2 rad/s .. 1.8 rad/s, 33 values"
[[mooring]]
on = "buoy"
kind = "linear"
stiffness = { surge = "40 kN/m", sway = "40 kN/m" }
damping = { surge = "60 kN s/m", sway = "60 kN s/m", heave = "60 kN s/m" }
[ask]
accuracy = 2e-3
)" + ask +
         R"(rao = { periods = "4 s .. 25 s, 40 values", of = ["buoy.surge", "buoy.sway", "buoy.heave", "mooring1.surge"] }
)";
}

const std::string long_crested = "kind = \"jonswap\"\nhs = \"3 m\"\ntp = \"9 s\"\nheading = \"0 deg\"\n";
const std::string short_crested = long_crested + "spreading = { kind = \"cos2s\", s = 6 }\n";

std::filesystem::path file_of(const std::string& text) {
  const auto path = support::scratch_folder() / "scene.toml";
  hydro::io::write_atomically(path, text);
  return path;
}

template <class Arguments>
nlohmann::json json_of(void (*command)(const Arguments&, const froude::Console&), const Arguments& arguments) {
  std::ostringstream out, err;
  command(arguments, {out, err, true});
  return nlohmann::json::parse(out.str());
}

froude::ResponseSpectra spectra_of(const std::string& text) {
  const auto scene = froude::scene::parse(text, "scene.toml");
  return froude::response_spectra({&scene}).front();
}

double variance(const froude::ResponseSpectra& r, std::size_t signal) {
  const auto& density = r.signals[signal].spectrum.density;
  if (std::all_of(density.begin(), density.end(), [](double d) { return d == 0; })) return 0;  // does not respond
  return hydro::signal::moments(r.signals[signal].spectrum, hydro::signal::whole(r.signals[signal].spectrum)).m0;
}

TEST(ResponseSpectra, AreASumOverManyFrequencies) {
  auto scene = froude::scene::parse(scene_text(long_crested), "scene.toml");
  const auto found = froude::response_spectra({&scene}).front();
  const auto& sea = std::get<froude::scene::RandomSea>(scene.waves->kind);
  // The plain sum: 4 000 frequencies side by side.
  const double low = scene.rao->omega.front(), high = scene.rao->omega.back();
  constexpr int n = 4000;
  scene.rao->omega.clear();
  for (int i = 0; i < n; ++i) scene.rao->omega.push_back(low + (high - low) * (i + 0.5) / n);
  const auto plain = froude::respond(scene);
  for (std::size_t s = 0; s < found.signals.size(); ++s) {
    double sum = 0;
    for (std::size_t w = 0; w < n; ++w)
      sum += sea.systems.front().spectrum->density(plain.omega[w]) * std::norm(plain.signals[s].values[w]) *
             (high - low) / n;
    EXPECT_NEAR(variance(found, s), sum, 2e-3 * sum + 1e-12) << found.signals[s].name;  // the accuracy asked
  }
  EXPECT_LT(found.error, 2e-3);
  EXPECT_GT(found.sea.frequency_hz.size(), 40u);
}

// The scene's run has no waves beyond its components: neither have its spectra.
TEST(ResponseSpectra, CutTheSeaAsTheSceneDoes) {
  const auto scene = froude::scene::parse(
      scene_text(long_crested + "components = { lowest = \"0.6 rad/s\", highest = \"0.83 rad/s\" }\n"), "scene.toml");
  const auto found = froude::response_spectra({&scene}).front();
  const auto& spectrum = *std::get<froude::scene::RandomSea>(scene.waves->kind).systems.front().spectrum;
  const double m0 = hydro::signal::moments(found.sea, hydro::signal::whole(found.sea)).m0;
  EXPECT_NEAR(m0, spectrum.energy(0.6, 0.83), 2e-3 * m0);  // the accuracy asked
  EXPECT_LT(m0, 0.9 * spectrum.moment(0));
  EXPECT_NEAR(found.left_out, 0, 1e-6);
  EXPECT_THAT(found.warnings, testing::ElementsAre(testing::HasSubstr("leave 38 % of the sea's energy out")));
}

TEST(ResponseSpectra, WarnOfEnergyOutsideTheFrequenciesAskedFor) {
  std::string shorter = long_crested;
  shorter.replace(shorter.find("9 s"), 3, "3 s");
  const auto found = spectra_of(scene_text(shorter));
  EXPECT_GT(found.left_out, 2e-3) << "the accuracy asked";
  EXPECT_THAT(found.warnings,
              testing::Contains(testing::AllOf(testing::StartsWith("warning: "),
                                               testing::HasSubstr("of the sea's energy lies outside"))));
}

TEST(ResponseSpectra, HaveTheVarianceOfARunInThatSea) {
  const auto steady = froude::scene::parse(
      scene_text(
          long_crested + "components = { repetition = \"3000 s\", lowest = \"0.04 Hz\", highest = \"0.25 Hz\" }\n",
          "run = { duration = \"3000 s\", every = \"0.5 s\", start = \"steady\", of = [\"buoy.surge\", "
          "\"buoy.heave\"] }\n"),
      "scene.toml");
  const auto found = froude::response_spectra({&steady}).front();
  const froude::Run run = froude::steady_run(steady);
  for (const std::size_t s : {0u, 2u}) {
    const auto& x = run.signal(found.signals[s].name);
    double sum = 0, squares = 0;
    for (std::size_t j = 0; j + 1 < x.size(); ++j) {  // one repetition: its last sample is its first
      sum += x[j];
      squares += x[j] * x[j];
    }
    const double n = static_cast<double>(x.size() - 1), mean = sum / n;
    // Twice the accuracy asked; bins of 1/3000 Hz that hold their energy shift the response within them.
    EXPECT_NEAR(squares / n - mean * mean, variance(found, s), 4e-3 * variance(found, s)) << found.signals[s].name;
  }
}

TEST(ResponseSpectra, OfARoundBodyInAShortCrestedSeaShareTheSurgeByTheSecondHarmonic) {
  // Surge goes with cos β and sway with sin β: their variances are (1 ± r₂)/2 of the long-crested one, and for
  // cos^2s(θ/2) r₂ = s(s − 1)/((s + 1)(s + 2)). Heave does not feel the heading.
  const double r2 = 6.0 * 5 / (7 * 8);
  const auto plane = spectra_of(scene_text(long_crested)), spread = spectra_of(scene_text(short_crested));
  EXPECT_NEAR(variance(spread, 0) / variance(plane, 0), (1 + r2) / 2, 3e-3);  // twice the accuracy asked
  EXPECT_NEAR(variance(spread, 1) / variance(plane, 0), (1 - r2) / 2, 3e-3);
  EXPECT_NEAR(variance(spread, 2) / variance(plane, 2), 1, 4e-3);
  EXPECT_EQ(variance(plane, 0) > 0, true);
  EXPECT_GE(spread.headings, 36u);
  EXPECT_EQ(plane.headings, 1u);
}

TEST(ResponseCommand, TellsStatisticsLargestValuesAndDamage) {
  const auto path = file_of(scene_text(long_crested));
  const froude::SnArguments sn{.range = "400 kN", .cycles = 1e6, .slope = 3};
  const auto table_file = support::scratch_folder() / "spectra.csv";
  const auto j =
      json_of<ResponseArguments>(&froude::response, {.scene = path, .duration = "3 h", .sn = sn, .output = table_file});
  const auto& heave = j["signals"]["buoy.heave"];
  EXPECT_DOUBLE_EQ(heave["significant_amplitude"].get<double>(), 2 * std::sqrt(heave["m0"].get<double>()));
  EXPECT_DOUBLE_EQ(heave["tz_s"].get<double>(), std::sqrt(heave["m0"].get<double>() / heave["m2"].get<double>()));
  const auto& largest = j["largest"]["buoy.heave"];
  const double n = 3 * 3600 / heave["tz_s"].get<double>();
  EXPECT_NEAR(largest["most_probable"].get<double>(),
              heave["standard_deviation"].get<double>() * std::sqrt(2 * std::log(n)), 1e-9);
  EXPECT_LT(largest["not_exceeded"][0]["rice"], largest["not_exceeded"][2]["rice"]);
  EXPECT_TRUE(j["damage"].contains("mooring1.surge"));
  EXPECT_FALSE(j["damage"].contains("buoy.heave"));  // metres are no force
  EXPECT_FALSE(j["signals"].contains("buoy.sway"));  // head sea: a note says so
  EXPECT_THAT(j["notes"].dump(), HasSubstr("buoy.sway does not respond"));
  const auto table = hydro::io::CsvTable::read(table_file);
  EXPECT_EQ(table.unit_text("buoy.heave"), "m^2/Hz");
}

TEST(ResponseCommand, OverOneSeaIsThatSea) {
  const auto scatter = support::scratch_folder() / "scatter.csv";
  hydro::io::write_atomically(scatter, "hs [m], tp [s], share\n300e-2, 9, 17\n6, 9, 0\n");
  const auto path = file_of(scene_text(long_crested));
  const froude::SnArguments sn{.range = "400 kN", .cycles = 1e6, .slope = 3, .slope_below = 5};
  const auto one = json_of<ResponseArguments>(&froude::response, {.scene = path, .duration = "1000 h", .sn = sn});
  const auto life = json_of<ResponseArguments>(&froude::response,
                                               {.scene = path, .duration = "1000 h", .sn = sn, .scatter = scatter});
  // Of a sea N independent peaks are counted, (1 − q)^N, of a life Poisson's, e^{−Nq}: they differ by q of ln N.
  for (int q = 0; q < 3; ++q)
    EXPECT_NEAR(life["signals"]["buoy.heave"]["not_exceeded"][q]["largest"].get<double>() /
                    one["largest"]["buoy.heave"]["not_exceeded"][q]["rice"].get<double>(),
                1, 1e-6);
  EXPECT_NEAR(life["signals"]["mooring1.surge"]["damage"].get<double>() /
                  one["damage"]["mooring1.surge"]["damage_dirlik"].get<double>(),
              1, 1e-12);
}

TEST(ResponseCommand, NamesWhatIsWrong) {
  const auto refused = [](const ResponseArguments& a, const char* said) {
    EXPECT_THAT([&] { json_of<ResponseArguments>(&froude::response, a); }, ThrowsMessage<InputError>(HasSubstr(said)));
  };
  refused(
      {.scene = file_of(scene_text("kind = \"regular\"\nheight = \"2 m\"\nperiod = \"8 s\"\nheading = \"0 deg\"\n"))},
      "need a random sea");
  const auto path = file_of(scene_text(long_crested));
  refused({.scene = path, .duration = "3 m"}, "--duration");
  refused({.scene = path, .quantiles = {1.5}}, "between 0 and 1");
  refused({.scene = path, .sn = {.range = "400 kN"}}, "a range, the cycles");
  refused({.scene = path, .sn = {.range = "400 Pa", .cycles = 1e6, .slope = 3}}, "of no signal");
  const auto scatter = support::scratch_folder() / "wrong.csv";
  hydro::io::write_atomically(scatter, "hs [m], tp [s], share\n3, 9, -1\n");
  refused({.scene = path, .scatter = scatter}, "wrong.csv:2:7: error: the share of a sea must not be negative");
  hydro::io::write_atomically(scatter, "hs [m], tp [s], share\n-3, 9, 1\n");
  refused({.scene = path, .scatter = scatter}, "wrong.csv:2:1: error: hs of a sea must be positive");
  refused({.scene = path, .duration = "2 s"}, "--duration: error: a duration of 2 s holds");
  refused({.scene = path, .scatter = scatter, .check = "time"}, "--scatter has many");
  refused({.scene = path, .output = "spectra.h5"}, "cannot end in \".h5\"");
}

// Of a linear scene the spectra are right, and runs scatter about them: within four standard errors of six runs, which
// one number of twelve misses once in some hundred draws of seeds, and a part for the memory of the runs (1e-3) and for
// the energy that lies outside the frequencies asked for (0.2 %). Extremes are of Rice's law to its own assumption,
// independent maxima, which in this band are in groups: 2 %.
TEST(ResponseCheck, OfALinearSceneFindsItRight) {
  const auto j = json_of<ResponseArguments>(
      &froude::response,
      {.scene = file_of(scene_text(long_crested)), .duration = "30 min", .check = "time", .check_runs = 6});
  const auto& check = j["check"];
  EXPECT_EQ(check["number_of_runs"], 6);
  for (const char* signal : {"buoy.surge", "buoy.heave", "mooring1.surge"})
    for (const auto& [what, part] :
         {std::pair("deviation", 3e-3), std::pair("tz_s", 3e-3), std::pair("largest", 2e-2)}) {
      const auto& of = check[signal][what];
      const double runs = of["runs"].get<double>();
      EXPECT_NEAR(of["linear"].get<double>(), runs, 4 * of["standard_error"].get<double>() + part * runs)
          << signal << ' ' << what;
      EXPECT_LT(of["standard_error"].get<double>(), 0.1 * runs);  // else any answer would pass
    }
  EXPECT_FALSE(check.contains("buoy.sway"));
}

TEST(ResponseCheck, IsTheSameOnAnyNumberOfThreadsAndTellsMoreBySeedsThatAreMore) {
  const auto path = file_of(scene_text(long_crested));
  const auto scene = froude::scene::read(path);
  const auto kept = std::make_shared<froude::compile::Kept>();
  const auto linear = froude::response_spectra({&scene}, kept).front();
  const auto one = froude::check_by_runs(scene, linear, 300, 3, 1, kept),
             two = froude::check_by_runs(scene, linear, 300, 3, 2, kept);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].deviation.mean, two[i].deviation.mean);
    EXPECT_EQ(one[i].largest.error, two[i].largest.error);
  }
}

const std::string dragging =
    "[[member]]\non = \"buoy\"\nfrom = \"(0, 0, -12) m\"\nto = \"(0, 0, 0) m\"\ndiameter = \"8 m\"\ndrag = { cd = ";

/// The buoy with a member of this drag coefficient.
std::string dragged(const std::string& waves, double cd) {
  return fmt::format("{}{}{} }}\n", scene_text(waves), dragging, cd);
}

// In high waves drag pushes and pulls slowly, with differences of frequencies, and a soft mooring swings with it. No
// linear answer has that.
TEST(ResponseCheck, SaysWhatALinearAnswerDoesNotKnow) {
  const auto j = json_of<ResponseArguments>(
      &froude::response,
      {.scene = file_of(dragged("kind = \"jonswap\"\nhs = \"9 m\"\ntp = \"9 s\"\nheading = \"0 deg\"\n", 4)),
       .duration = "10 min",
       .check = "time",
       .check_runs = 4});
  const auto& largest = j["check"]["buoy.surge"]["largest"];
  EXPECT_GT(largest["runs"].get<double>(), 1.2 * largest["linear"].get<double>());
  EXPECT_THAT(j["check"]["warnings"].dump(), HasSubstr("buoy.surge: the expected largest value"));
}

// (D143) through the command: less motion than without drag, none of it where the coefficient vanishes, and the same
// linear drag for twice the waves and half the coefficient.
TEST(ResponseDrag, IsLinearForTheSea) {
  const auto without = spectra_of(scene_text(long_crested)), none = spectra_of(dragged(long_crested, 1e-9)),
             with = spectra_of(dragged(long_crested, 1.2));
  EXPECT_FALSE(without.drag);
  EXPECT_LT(variance(with, 0), 0.99 * variance(without, 0));
  // Surge beside a drag of 1e-9: the same numbers but for rounding and for the 1e-9.
  EXPECT_NEAR(variance(none, 0) / variance(without, 0), 1, 1e-7);
  ASSERT_TRUE(with.drag);
  EXPECT_LE(with.drag->residual, 1e-6);  // as it promises
  EXPECT_GT(with.drag->iterations, 1);
  const std::string twice = "kind = \"jonswap\"\nhs = \"6 m\"\ntp = \"9 s\"\nheading = \"0 deg\"\n";
  const auto high = spectra_of(dragged(twice, 0.6));
  // Frequencies are put by relative moments, alike in both: what differs is where the drag settles, 1e-6.
  EXPECT_NEAR(high.drag->members.at(0).coefficient / with.drag->members.at(0).coefficient, 1, 1e-5);
  EXPECT_NEAR(variance(high, 0) / variance(with, 0), 4, 1e-4);
}

std::string with(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

// A buoy held in place has the orbits of the sea past it: F/w = ∫ ½ρ C_D D √(8/π) σ_u(z) dz, σ_u by a plain sum.
TEST(ResponseDrag, PastAHeldBodyIsThatOfTheSea) {
  std::string text = with(dragged(long_crested, 1.2), "surge = \"40 kN/m\"", "surge = \"4e4 GN/m\"");
  text = with(text, ", \"buoy.sway\", \"buoy.heave\"", "");
  text = with(text, "radii_of_gyration", "free = [\"surge\"]\nradii_of_gyration");
  const auto scene = froude::scene::parse(text, "scene.toml");
  const auto& spectrum = *std::get<froude::scene::RandomSea>(scene.waves->kind).systems.front().spectrum;
  const double low = scene.rao->omega.front(), high = scene.rao->omega.back();
  constexpr int n = 600, layers = 48;
  double coefficient = 0;
  for (int l = 0; l < layers; ++l) {
    const double z = -12 * (l + 0.5) / layers;
    double square = 0;
    for (int i = 0; i < n; ++i) {
      const double omega = low + (high - low) * (i + 0.5) / n, k = hydro::waves::wavenumber(omega, scene.water);
      const double u = omega * std::cosh(k * (z + 60)) / std::sinh(k * 60);
      square += spectrum.density(omega) * u * u * (high - low) / n;
    }
    coefficient += 0.5 * 1000 * 1.2 * 8 * std::sqrt(8 / std::numbers::pi * square) * 12 / layers;
  }
  const auto found = froude::response_spectra({&scene}).front();
  // The accuracy asked of moments, of which the coefficient has half, and the plain sums, 1e-4.
  EXPECT_NEAR(found.drag->members.at(0).coefficient / coefficient, 1, 2e-3);
}

TEST(ResponseDrag, IsTold) {
  const auto path = file_of(with(dragged(short_crested, 1.2), "accuracy = 2e-3", "accuracy = 5e-2"));
  const auto j = json_of<ResponseArguments>(&froude::response, {.scene = path});
  const auto& member = j["drag"]["members"][0];
  // Of short-crested waves the relative velocity has a second direction.
  EXPECT_GT(member["sigma_major_m_per_s"].get<double>(), member["sigma_minor_m_per_s"].get<double>());
  EXPECT_GT(member["sigma_minor_m_per_s"].get<double>(), 0);
  EXPECT_LE(j["drag"]["residual"].get<double>(), 1e-6);
  for (const auto& note : j["notes"]) EXPECT_THAT(note.get<std::string>(), Not(HasSubstr("drag")));
}

// Waves are longer or shorter on a current (a run with 1.5 m/s had 12 % less of Morison's load, and 20 degrees more).
TEST(ResponseDrag, IsForStillWater) {
  EXPECT_THAT([] { spectra_of(dragged(long_crested, 1.2) + "[current]\nvelocity = \"(1, 0, 0) m/s\"\n"); },
              ThrowsMessage<hydro::InputError>(HasSubstr("no part for a current")));
}

TEST(FatigueCommand, CountsASineOnce) {
  std::vector<double> time, force;
  for (int j = 0; j <= 4000; ++j) {  // a hundred periods of forty samples, from crest to crest
    time.push_back(0.25 * j);
    force.push_back(100e3 * std::cos(2 * std::numbers::pi * j / 40));
  }
  const auto path = support::scratch_folder() / "force.csv";
  hydro::io::write_csv(path, {{"time", "s", &time}, {"force", "kN", &force}});
  const auto j = json_of<FatigueArguments>(
      &froude::fatigue, {.file = path, .signal = "force", .sn = {.range = "100 kN", .cycles = 1e4, .slope = 3}});
  EXPECT_DOUBLE_EQ(j["cycles"].get<double>(), 100);
  EXPECT_NEAR(j["largest_range"].get<double>(), 200e3, 1e-6);
  EXPECT_NEAR(j["damage"].get<double>(), 100 * 8 / 1e4, 1e-12);
  EXPECT_NEAR(j["equivalent_range"].get<double>(), 200e3, 1e-5);
  EXPECT_THAT(
      [&] {
        json_of<FatigueArguments>(&froude::fatigue,
                                  {.file = path, .signal = "force", .sn = {.range = "1 m", .cycles = 1, .slope = 3}});
      },
      ThrowsMessage<InputError>(HasSubstr("of no signal")));
}

}  // namespace
}  // namespace response_test
