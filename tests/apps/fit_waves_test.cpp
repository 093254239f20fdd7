// `froude fit` of responses in regular waves; by the function of main.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "fit_fixture.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace fit_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST_F(Fit, OfRegularWavesHasTheTruthInItsIntervals) {
  const auto j = nlohmann::json::parse(
      told({.scene = examples / "waves_runs.toml", .table = folder / "w.csv", .picture = folder / "w.svg"}, true));
  ASSERT_EQ(j["run"].size(), 8u);
  int held = 0;
  for (const auto& run : j["run"]) {
    const double omega = run["omega_rad_s"], r = omega * 1.5 / (2 * M_PI);  // the body of make_waves_runs.py
    const std::complex<double> heave = 1.0 / std::complex<double>(1 - r * r, 2 * 0.15 * r);
    const std::pair<double, double> truth[] = {{std::abs(heave), std::arg(heave)}, {900, 0.3 * omega}};
    for (std::size_t c = 0; c < 2; ++c) {
      const auto& response = run["response"][c];
      const auto& interval = response["rao"]["interval"];
      held += interval[0].get<double>() < truth[c].first && truth[c].first < interval[1].get<double>() ? 1 : 0;
      EXPECT_NEAR(std::remainder(response["phase_rad"].get<double>() - truth[c].second, 2 * M_PI), 0,
                  4 * response["phase_error_rad"].get<double>() + 0.02);  // 3 m of k, known to 1e-3 with the period
    }
    EXPECT_NEAR(run["response"][1]["motion"]["amplitudes"][1].get<double>(), 0.08 * 900 * 0.03, 0.3);
  }
  EXPECT_GE(held, 13);  // 15.2 of 16 expected, with a deviation of 0.9
  ASSERT_EQ(j["repeated"].size(), 2u);
  EXPECT_EQ(j["repeated"][0]["runs"].get<int>(), 3);
  EXPECT_THAT(hydro::io::read_text(folder / "w.svg"), AllOf(HasSubstr("heave RAO"), HasSubstr("by peaks")));
  EXPECT_THAT(hydro::io::read_text(folder / "w.csv"), HasSubstr("run_8.csv,"));
}

// The ratio is free of the band, whose ends leave other periods of the same run: both intervals overlap.
TEST_F(Fit, OfRegularWavesInABandAboutThemIsThatOfTheWaves) {
  const auto runs_of = [&](const char* scene) {
    return nlohmann::json::parse(told({.scene = examples / scene}, true))["run"];
  };
  const auto banded = runs_of("waves_band.toml"), plain = runs_of("waves_runs.toml");
  ASSERT_EQ(banded.size(), 7u);
  for (std::size_t i = 0; i < banded.size(); ++i) {
    const auto &a = banded[i]["response"][0]["rao"]["interval"], &b = plain[i]["response"][0]["rao"]["interval"];
    EXPECT_LT(a[0].get<double>(), b[1].get<double>()) << i;
    EXPECT_GT(a[1].get<double>(), b[0].get<double>()) << i;
  }
  EXPECT_THAT(banded[0]["steps"].dump(), AllOf(HasSubstr("trend: elevation"), HasSubstr("band-pass from")));
}

TEST_F(Fit, OfRegularWavesRefusesWhatDoesNotGoTogether) {
  const auto refused = [&](const char* from, const char* to) {
    return [=, this] { told({.scene = changed("waves_runs.toml", from, to)}); };
  };
  EXPECT_THAT(refused("end = \"60 m\"", "end = \"22 m\""),
              ThrowsMessage<InputError>(HasSubstr("lies before the gauge")));
  EXPECT_THAT(refused("end = \"60 m\"", "end = \"24 m\""), ThrowsMessage<InputError>(HasSubstr("no three periods of")));
  EXPECT_THAT(refused("[\"heave\", \"F\"]", "[\"heave\", \"heave\"]"), ThrowsMessage<InputError>(HasSubstr("twice")));
  EXPECT_THAT(refused("[\"heave\", \"F\"]", "[\"heav\"]"), ThrowsMessage<InputError>(HasSubstr("heave")));
  EXPECT_THAT(refused("[\"heave\", \"F\"]", "[]"), ThrowsMessage<InputError>(HasSubstr("is empty")));
  EXPECT_THAT(refused("tank = {", "#"), ThrowsMessage<InputError>(HasSubstr("tank")));
  EXPECT_THAT(refused("ramp = \"2 s\"", "ramp = \"2 s\"\nharmonics = 0"),
              ThrowsMessage<InputError>(HasSubstr("between 1 and 20")));
  EXPECT_THAT(refused("[ask]", "[prepare]\nmean_cycle = true\n[ask]"),
              ThrowsMessage<InputError>(HasSubstr("acts on forces and motions of a cylinder")));
  EXPECT_THAT(refused("[ask]", "[prepare]\nband_pass = { kind = \"edges\", low = \"2 Hz\", high = \"1 Hz\" }\n[ask]"),
              ThrowsMessage<InputError>(HasSubstr("must be higher than low")));
}

TEST_F(Fit, OfOneRunInRegularWavesDrawsItsRecord) {
  told({.scene = changed("waves_runs.toml", "run_*.csv", "run_3.csv"), .picture = folder / "w.svg"});
  EXPECT_THAT(hydro::io::read_text(folder / "w.svg"), AllOf(HasSubstr("elevation"), HasSubstr("fitted")));
}

}  // namespace
}  // namespace fit_test
