// What commands tell: each fact once, for people and for programs.
#include "froude/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <sstream>

#include "froude/commands.hpp"

namespace report_test {
namespace {

using froude::fact;
using froude::Json;
using froude::Report;

TEST(Report, TellsAFactOnceForPeopleAndForPrograms) {
  Report report;
  report.say("{} samples every {:.6g} s", fact("samples", 3000), fact("step_s", 0.2));
  report.say("{:>9.2f}% slack on {:<8}|", fact("slack_share", 0.25, 25.0), fact("line", std::string("bow")));
  EXPECT_EQ(report.text(), "3000 samples every 0.2 s\n    25.00% slack on bow     |\n");
  EXPECT_EQ(report.tree().dump(), R"({"samples":3000,"step_s":0.2,"slack_share":0.25,"line":"bow"})");
}

TEST(Report, PutsMatricesIntoTheTreeAndWhatIsAbsentWhereItIsKeptOnPurpose) {
  Report report;
  report.say("GM {}", fact("gm_m", std::optional<double>(), "unknown")).keep("bm_m", std::optional<double>());
  report.keep("centre", Eigen::Vector3d(1, 2, 3)).keep("C", Eigen::Matrix2d{{1, 2}, {3, 4}});
  report.keep("column", Eigen::MatrixXd::Ones(2, 1)).keep("mass", std::optional(5.0));
  EXPECT_EQ(report.text(), "GM unknown\n");
  EXPECT_EQ(report.tree(),
            Json::parse(R"({"bm_m":null,"centre":[1.0,2.0,3.0],"C":[[1.0,2.0],[3.0,4.0]],"column":[[1.0],[1.0]],
                            "mass":5.0})"));
}

TEST(Report, GoesDownALevelWithASlashInTheKeyOfAFactButNotOfAPart) {
  Report report;
  report.say("{} of {}", fact("pose/heel_deg", 5), fact("pose/trim_deg", 1)).part("drag/lift", Report().keep("of", 2));
  EXPECT_EQ(report.tree(), Json::parse(R"({"pose":{"heel_deg":5,"trim_deg":1},"drag/lift":{"of":2}})"));
}

TEST(Report, TellsPartsRowsAndSentencesInTheirOrder) {
  Report report, peak;
  peak.say("  peak at {} s", fact("period_s", 8));
  report.say("signals:");
  report.row("signals", "  {}", fact("name", "heave")).row("signals", "  {}", fact("name", "pitch"));
  report.part("peak", peak).part("", Report().keep("beside", true));
  report.sentences("notes", "note: {}", {"short"}).sentences("notes", "note: {}", {"noisy"});
  report.sentences("warnings", "warning: {}", {});
  report.wrote("a.csv").wrote(std::nullopt);
  report.part("", Report().say("{}", fact("energy_J", 5)).untold());
  EXPECT_EQ(report.text(), "signals:\n  heave\n  pitch\n  peak at 8 s\nnote: short\nnote: noisy\nwrote a.csv\n");
  EXPECT_EQ(report.tree().dump(),
            R"({"signals":[{"name":"heave"},{"name":"pitch"}],"peak":{"period_s":8},"beside":true,)"
            R"("notes":["short","noisy"],"warnings":[],"written":["a.csv"],"energy_J":5})");
}

TEST(Report, IsOneDocumentForAProgramAndTextForAPerson) {
  Report report;
  report.say("{} bodies", fact("bodies", 2));
  std::ostringstream text, json, err;
  froude::tell(report, {.out = text, .err = err});
  froude::tell(report, {.out = json, .err = err, .json = true});
  EXPECT_EQ(text.str(), "2 bodies\n");
  EXPECT_EQ(json.str(), "{\n \"bodies\": 2\n}\n");
}

TEST(Report, MayReachPeopleInPartsAndProgramsAsAWhole) {
  std::ostringstream text, json, err;
  for (const froude::Console& console :
       {froude::Console{.out = text, .err = err}, froude::Console{.out = json, .err = err, .json = true}}) {
    Report all;
    for (const char* name : {"a.nc", "b.nc"})
      all.one_of("files", froude::tell_people(Report().say("{}", fact("file", name)), console));
    froude::tell(all.untold(), console);
  }
  EXPECT_EQ(text.str(), "a.nc\nb.nc\n");
  EXPECT_EQ(Json::parse(json.str()), Json::parse(R"({"files":[{"file":"a.nc"},{"file":"b.nc"}]})"));
}

TEST(Report, OfAFitIsTomlThatKeepsFloatsAndQuotesWhatIsNoBareKey) {
  Report report, run;
  run.keep("cd", 1.0).keep("labels", Json{{"speed [m/s]", "2"}});
  report.part("water", Report().keep("depth", std::optional<double>()).keep("law", "line \"a\""));
  report.keep("interval", std::vector{0.5, 2.0}).keep("runs", 3).one_of("run", run);
  report.keep("wild", std::numeric_limits<double>::infinity());
  EXPECT_EQ(froude::toml_of(report.tree(), "Estimates."),
            "# Estimates.\ninterval = [0.5, 2.0]\nruns = 3\nwild = inf\n\n[water]\nlaw = \"line \\\"a\\\"\"\n\n"
            "[[run]]\ncd = 1.0\n\n[run.labels]\n\"speed [m/s]\" = \"2\"\n");
}

}  // namespace
}  // namespace report_test
