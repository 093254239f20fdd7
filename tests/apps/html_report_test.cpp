// Reports: arrays, thinning, text that stays text, and numbers that are those of the results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "hydro/base/base64.hpp"
#include "report/arrays.hpp"
#include "report/contents.hpp"
#include "report/page.hpp"
#include "report/spectra_of_run.hpp"
#include "support/scratch.hpp"

namespace html_report_test {
namespace {

namespace html = froude::html;
using ::testing::HasSubstr;
using ::testing::Not;

std::string encoded(std::string_view text) { return hydro::base64(std::as_bytes(std::span(text))); }

// RFC 4648, section 10.
TEST(ReportArrays, AreBase64AsTheStandardHasIt) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(ReportArrays, ThinnedKeepEveryExtreme) {
  std::vector<double> time, values;
  for (int i = 0; i < 10'007; ++i) time.push_back(0.1 * i), values.push_back(std::sin(0.7 * i));
  values[4321] = 5;  // single samples, which decimation would lose
  values[10'006] = -7;
  const html::Thinning thinning(values.size(), 500);
  const auto shown = thinning.values(values), at = thinning.times(time);
  EXPECT_LE(shown.size(), 502u);  // the last piece may be short
  ASSERT_EQ(shown.size(), at.size());
  EXPECT_EQ(shown.size(), thinning.shown());
  EXPECT_EQ(*std::max_element(shown.begin(), shown.end()), 5);
  EXPECT_EQ(*std::min_element(shown.begin(), shown.end()), -7);
  for (std::size_t i = 1; i < at.size(); ++i) EXPECT_GT(at[i], at[i - 1]);
  const auto peak = static_cast<std::size_t>(std::max_element(shown.begin(), shown.end()) - shown.begin());
  EXPECT_NEAR(at[peak], 432.1, 0.1 * static_cast<double>(thinning.piece()));  // a point is off by less than a piece
}

TEST(ReportArrays, ThatAreShortAreWhole) {
  const std::vector<double> values{3, 1, 2};
  EXPECT_EQ(html::Thinning(3, 3).values(values), values);
}

// All variance lies in one line, which the window spreads over three frequencies: nothing far beyond it is shown.
TEST(ReportSpectra, ReachBeyondTheLineOfASineAndLeaveOutEnergy) {
  froude::RunResult run;
  froude::Signal heave{"m.heave", "m", "", {}};
  for (int i = 0; i < 8192; ++i) {
    run.time.push_back(0.1 * i);
    heave.values.push_back(0.5 * std::sin(2 * std::numbers::pi * 0.125 * run.time.back()));
  }
  run.signals = {heave, {"energy.kinetic", "J", "", heave.values}};
  const html::Json spectra = html::spectra_of(run, 0);
  EXPECT_FALSE(spectra["signals"].contains("energy.kinetic"));
  EXPECT_EQ(spectra["frequency"]["n"], spectra["signals"]["m.heave"]["n"]);
  EXPECT_LT(spectra["low"].get<double>(), 1);
  EXPECT_GT(spectra["high"].get<double>(), 1);
  // The shown end lies beyond the line and far below half the sampling rate.
  EXPECT_GT(spectra["end"].get<double>(), 0.125);
  EXPECT_LT(spectra["end"].get<double>(), 0.5);
}

// 40 s in segments of 5 s: of a period of 10 s a segment holds the half, of one of 1 s it holds five.
TEST(ReportSpectra, NameWhatTheirSegmentsAreTooShortFor) {
  froude::RunResult run;
  froude::Signal slow{"m.surge", "m", "", {}}, fast{"m.heave", "m", "", {}};
  for (int i = 0; i < 800; ++i) {
    run.time.push_back(0.05 * i);
    slow.values.push_back(std::sin(2 * std::numbers::pi * run.time.back() / 10));
    fast.values.push_back(std::sin(2 * std::numbers::pi * run.time.back()));
  }
  run.signals = {slow, fast};
  EXPECT_EQ(html::spectra_of(run, 0)["unresolved"], html::Json::array({"m.surge"}));
}

TEST(ReportSpectra, OfTooShortARecordSayWhy) {
  froude::RunResult run;
  run.time = {0, 1, 2};
  run.signals = {{"a", "m", "", {0, 1, 0}}};
  EXPECT_TRUE(html::spectra_of(run, 0).contains("missing"));
}

// The page writes the word itself: "warning: warning: the energy residual is ...".
TEST(ReportOfASweep, SaysWarningOnce) {
  EXPECT_EQ(html::without_the_word("warning: x is off; warning: y, too"), "x is off; y, too");
  EXPECT_EQ(html::without_the_word("x is off"), "x is off");
}

// What a section carries at rest stands beside its loads in waves, and is no response itself.
TEST(ReportResponses, HaveWhatSectionsCarryAtRest) {
  const auto path = support::scratch_folder() / "sections.rao.h5";
  froude::write_rao(path, {0.5, 1}, {0}, {{"barge.mid.force_z", "N/m", "shear", {{1, 0}, {0, 2}}}}, {}, {},
                    {{"barge.mid", {5, 0, -1}, {1, 0, 0}, {1, 2, 3, 4, 5, 6}}});
  const html::Json rao = html::rao_contents(path);
  ASSERT_EQ(rao["signals"].size(), 1u);
  ASSERT_EQ(rao["sections"].size(), 1u);
  EXPECT_EQ(rao["sections"][0]["name"], "barge.mid");
  const html::Json& rest = rao["sections"][0]["at_rest"];
  EXPECT_EQ(rest["at_x"], html::Json({{"unit", "m"}, {"value", 5.0}}));
  EXPECT_EQ(rest["normal_x"]["value"], 1.0);
  EXPECT_EQ(rest["force_z"], html::Json({{"unit", "N"}, {"value", 3.0}}));
  EXPECT_EQ(rest["moment_y"], html::Json({{"unit", "N m"}, {"value", 5.0}}));
}

TEST(ReportPage, LetsNoTextEndAnElement) {
  if (!html::has_page()) GTEST_SKIP() << "this build has no reports";
  const std::string taken = "</script><b>", page = html::page_with(taken, {{"title", taken}});
  EXPECT_THAT(page, HasSubstr("<title>&lt;/script&gt;&lt;b&gt;</title>"));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>"));
  EXPECT_THAT(page, Not(HasSubstr(taken)));
}

TEST(ReportPage, HasTheLicencesOfWhatItBringsAndAsksForNothing) {
  if (!html::has_page()) GTEST_SKIP() << "this build has no reports";
  const std::string page = html::page_with("", html::Json::object());
  EXPECT_THAT(page, HasSubstr("uplot 1.6.32"));
  EXPECT_THAT(page, HasSubstr("three 0.187.0"));
  EXPECT_THAT(page, HasSubstr("Copyright (c) 2022 Leon Sorokin"));
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
}

}  // namespace
}  // namespace html_report_test
