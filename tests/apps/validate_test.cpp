// The judge judged: a wrong number must fail, a limit needs a reason, absent data are told, known failures are kept
// apart.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "harness/report.hpp"
#include "harness/validate.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/scratch.hpp"
#include "support/source_dir.hpp"

namespace froude::validation::validate_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

Outcome period_of_two_seconds(const Folders&) {
  return {.numbers = {{"period", 2.0, "s"}, {"aside", 7.0, ""}},
          .pictures = {
              {"swing",
               "A swing.",
               {.title = "swing",
                .panels = {
                    {.x = {.label = "t"}, .y = {.label = "θ"}, .series = {{.name = "", .x = {0, 1}, .y = {0, 1}}}}}}}}};
}
Outcome needs_a_tank(const Folders& folders) {
  return {.numbers = {{"period", static_cast<double>(folders.shared("tank/run1.csv").string().size()), "s"}}};
}
Outcome breaks(const Folders&) { throw hydro::NumericsError("did not settle"); }
Outcome not_a_number(const Folders&) { return {.numbers = {{"period", std::nan(""), "s"}}}; }

/// A folder of cases with one case "swing", gone when the test ends.
class Harness : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = support::scratch_folder() / (std::string("froude_validate_") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "swing");
    write("README.md", "# A swing\n\nQuestion.\n\n## Physics\n\nGravity.\n");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& file, const std::string& text) { std::ofstream(folder_ / "swing" / file) << text; }
  void accept(const std::string& text) { write("accept.toml", text); }
  CaseReport run(Outcome (*function)(const Folders&) = period_of_two_seconds) {
    return run_case({"swing", function}, Folders(folder_, folder_ / "data", "swing"));
  }
  std::string listed(const std::vector<std::string>& names) {
    std::filesystem::create_directories(folder_ / "data");
    std::ostringstream out, err;
    list({{"swing", period_of_two_seconds}, {"pool", needs_a_tank, {"tank"}}},
         {.names = names, .folder = folder_, .data = folder_ / "data", .page = {}, .reference_curves = false},
         Console{.out = out, .err = err});
    return out.str();
  }

  std::filesystem::path folder_;
};

const std::string good = R"([[check]]
number = "period"
unit = "s"
expected = 2.01
limit = 0.02
reference_uncertainty = 0.005
because = "stopwatch"
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST_F(Harness, PassesWithinTheLimitAndShowsWhatItComparedWith) {
  accept(good);
  const CaseReport report = run();
  EXPECT_EQ(report.lines.at(0).verdict, Verdict::pass);
  EXPECT_FALSE(report.lines.at(1).check.has_value());
  EXPECT_TRUE(tally({report}).good());
  EXPECT_THAT(as_text(report), AllOf(HasSubstr("A swing"), HasSubstr("2.01 ± 0.02"), HasSubstr("± 0.005"),
                                     HasSubstr("passed"), HasSubstr("for information")));
}

TEST_F(Harness, FailsWhenTheNumberIsOutsideItsLimit) {
  accept(replaced(good, "2.01", "2.021"));
  const Tally sum = tally({run()});
  EXPECT_EQ(sum.failed, 1);
  EXPECT_FALSE(sum.good());
  EXPECT_THAT(as_text(run()), HasSubstr("FAILED"));
}

TEST_F(Harness, FailsOnANumberThatIsNone) {
  accept(good);
  EXPECT_EQ(tally({run(not_a_number)}).failed, 1);
  accept(replaced(replaced(good, "expected = 2.01\n", ""), "limit = 0.02", "at_most = 3"));
  EXPECT_EQ(tally({run(not_a_number)}).failed, 1);
}

TEST_F(Harness, KnowsFourKindsOfLimit) {
  const auto verdict = [&](const std::string& rule) {
    accept(replaced(good, "expected = 2.01\nlimit = 0.02", rule));
    return run().lines.at(0).verdict;
  };
  EXPECT_EQ(verdict("expected = 1.0\nlimit = 1"), Verdict::pass);  // the limit itself is inside
  EXPECT_EQ(verdict("expected = -2.5\nlimit_relative = 0.01"), Verdict::fail);
  EXPECT_EQ(verdict("expected = 2.5\nlimit_relative = 0.21"), Verdict::pass);
  EXPECT_EQ(verdict("expected = 2.5\nlimit_relative = 0.19"), Verdict::fail);
  EXPECT_EQ(verdict("at_most = 2"), Verdict::pass);
  EXPECT_EQ(verdict("at_most = 1.9"), Verdict::fail);
  EXPECT_EQ(verdict("at_least = 2"), Verdict::pass);
  EXPECT_EQ(verdict("at_least = 2.1"), Verdict::fail);
}

TEST_F(Harness, CountsAKnownFailureApart) {
  accept(replaced(good, "2.01", "2.5") + "fails = \"digits exchanged\"\n");
  const Tally sum = tally({run()});
  EXPECT_EQ(sum.known_failures, 1);
  EXPECT_EQ(sum.failed, 0);
  EXPECT_TRUE(sum.good());
  EXPECT_THAT(as_text(run()), AllOf(HasSubstr("FAILED (known)"), HasSubstr("digits exchanged")));
  EXPECT_THAT(summary(sum), HasSubstr("0 failed, 1 known failure"));
}

TEST_F(Harness, RefusesAMarkOfFailureThatIsOutOfDate) {
  accept(good + "fails = \"digits exchanged\"\n");
  EXPECT_EQ(run().lines.at(0).verdict, Verdict::unexpected_pass);
  EXPECT_FALSE(tally({run()}).good());
}

TEST_F(Harness, RefusesALimitWithoutAReason) {
  accept(replaced(good, "because = \"stopwatch\"\n", ""));
  EXPECT_THAT([&] { run(); }, ThrowsMessage<InputError>(AllOf(HasSubstr("accept.toml:1"),
                                                              HasSubstr("the limit of \"period\" has no reason"),
                                                              HasSubstr("because = "))));
  accept(replaced(good, "\"stopwatch\"", "\"  \""));
  EXPECT_THAT([&] { run(); }, ThrowsMessage<InputError>(HasSubstr("because must be a text that says something")));
}

TEST_F(Harness, RefusesARuleThatSaysNothingOrTwoThings) {
  const auto message_of = [&](const std::string& text) {
    accept(text);
    try {
      run();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(message_of(replaced(good, "limit = 0.02\n", "")), HasSubstr("exactly one limit, 0 are given"));
  EXPECT_THAT(message_of(good + "at_most = 3\n"), HasSubstr("exactly one limit, 2 are given"));
  EXPECT_THAT(message_of(replaced(good, "expected = 2.01\n", "")), HasSubstr("need an expected value"));
  EXPECT_THAT(message_of(replaced(good, "limit = 0.02", "at_most = 3")), HasSubstr("stand without an expected value"));
  EXPECT_THAT(message_of(replaced(good, "limit = 0.02", "limit = -0.02")), HasSubstr("not negative"));
  EXPECT_THAT(message_of(replaced(good, "limit = 0.02", "limit = \"0.02\"")), HasSubstr("limit must be a number"));
  EXPECT_THAT(message_of(replaced(good, "expected = 2.01\nlimit", "expected = 0\nlimit_relative")),
              HasSubstr("around zero"));
  EXPECT_THAT(message_of(replaced(good, "limit =", "limt =")),
              AllOf(HasSubstr("accept.toml:5"), HasSubstr("did you mean \"limit\"?")));
  EXPECT_THAT(message_of(good + good), HasSubstr("checked twice"));
  EXPECT_THAT(message_of(""), HasSubstr("without a check accepts everything"));
  EXPECT_THAT(message_of("limit = 3\n"), HasSubstr("[[check]] tables only"));
  EXPECT_THAT(message_of(replaced(good, "\"period\"", "\"priod\"")), HasSubstr("did you mean \"period\"?"));
  EXPECT_THAT(message_of(replaced(good, "unit = \"s\"", "unit = \"min\"")),
              HasSubstr("is in \"s\", the check in \"min\""));
}

TEST_F(Harness, TellsAbsentDataAndIsNotBrokenByThem) {
  accept(good);
  const CaseReport report = run(needs_a_tank);
  EXPECT_THAT(as_text(report), HasSubstr("skipped, no data: tank/run1.csv"));
  EXPECT_EQ(tally({report}).cases_skipped, 1);
  EXPECT_TRUE(tally({report}).good());
  EXPECT_THAT(summary(tally({report})), HasSubstr("1 case skipped for want of data"));
}

TEST_F(Harness, CountsACaseThatThrowsAsBroken) {
  accept(good);
  EXPECT_THAT(as_text(run(breaks)), HasSubstr("BROKEN: did not settle"));
  EXPECT_FALSE(tally({run(breaks)}).good());
}

TEST_F(Harness, WritesAPageWithItsPictures) {
  accept(good);
  const auto page = folder_ / "validation.md";
  write_page({run(), run(needs_a_tank)}, page, ReferenceCurves::left_out);
  const std::string text = hydro::io::read_text(page);
  EXPECT_THAT(text,
              AllOf(HasSubstr("## A swing"), HasSubstr("### Physics"), HasSubstr("| period | 2 | s | 2.01 ± 0.02 |"),
                    HasSubstr("stopwatch"), HasSubstr("](validation/swing-swing.svg)"), HasSubstr("Skipped, no data")));
  EXPECT_THAT(hydro::io::read_text(folder_ / "validation" / "swing-swing.svg"), HasSubstr("</svg>"));
}

TEST_F(Harness, DrawsCurvesOfOthersOnlyIfAsked) {
  accept(good);
  auto report = run();
  report.pictures.at(0).shows_reference_curves = true;
  const auto page = folder_ / "validation.md";
  write_page({report}, page, ReferenceCurves::left_out);
  EXPECT_THAT(hydro::io::read_text(page), AllOf(Not(HasSubstr("swing-swing.svg")), HasSubstr("--reference-curves")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "validation"));
  write_page({report}, page, ReferenceCurves::drawn);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "validation" / "swing-swing.svg"));
}

TEST_F(Harness, ListsTheQuestionInOneLineAndAbsentData) {
  write("README.md", "# A swing\n\n**Question.** Does it\nswing? \n\n**Physics in play.** Gravity.\n");
  std::filesystem::copy(folder_ / "swing", folder_ / "pool");
  EXPECT_EQ(listed({}),
            "swing  Does it swing?\n"
            "pool   Does it swing? (reference data are absent: tank)\n");
  std::filesystem::create_directories(folder_ / "data" / "tank");
  EXPECT_EQ(listed({"pool"}), "pool  Does it swing?\n");
}

TEST_F(Harness, RefusesToListACaseThatAsksNothing) {
  EXPECT_THAT([&] { listed({"swing"}); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("README.md"), HasSubstr("asks no question"), HasSubstr("**Question.**"))));
}

// ---- the command, with the cases as they are ----

#ifdef FROUDE_VALIDATION_CASES
/// A copy of two of the shipped cases in which a test may plant faults.
class ValidateCommand : public Harness {
 protected:
  void SetUp() override {
    Harness::SetUp();
    for (const std::string name : {"dispersion", "hulme"})
      std::filesystem::copy(froude_test::source_dir() / "validation" / name, folder_ / name,
                            std::filesystem::copy_options::recursive);
    std::filesystem::create_directories(folder_ / "no_data");
  }
  int validate_copy(const std::vector<std::string>& names, bool json = false) {
    out_.str("");
    const Console console{.out = out_, .err = err_, .json = json};
    return validate(
        cases(),
        {.names = names, .folder = folder_, .data = folder_ / "no_data", .page = {}, .reference_curves = false},
        console);
  }
  std::ostringstream out_, err_;
};

TEST_F(ValidateCommand, ReturnsZeroForGoodNumbersAndOneForAPlantedWrongOne) {
  EXPECT_EQ(validate_copy({"dispersion"}), 0) << out_.str();
  EXPECT_THAT(out_.str(), HasSubstr("2 passed, 0 failed"));
  const auto file = folder_ / "dispersion" / "accept.toml";
  const std::string planted = replaced(hydro::io::read_text(file), "at_most = 1e-14", "at_most = 1e-20");
  std::ofstream(file) << planted;
  EXPECT_EQ(validate_copy({"dispersion"}), 1);
  EXPECT_THAT(out_.str(), HasSubstr("1 passed, 1 failed"));
}

TEST_F(ValidateCommand, SkipsWhatNeedsAbsentData) {
  EXPECT_EQ(validate_copy({"hulme", "dispersion"}), 0);
  EXPECT_THAT(out_.str(),
              AllOf(HasSubstr("skipped, no data: hulme_hemisphere/heave.csv"), HasSubstr("1 case skipped")));
}

TEST_F(ValidateCommand, SpeaksJsonAndNothingElse) {
  EXPECT_EQ(validate_copy({"dispersion", "hulme"}, true), 0);
  const auto document = nlohmann::json::parse(out_.str());
  EXPECT_EQ(document["passed"], 2);
  EXPECT_EQ(document["cases_skipped"], 1);
  EXPECT_EQ(document["cases"][0]["numbers"][0]["verdict"], "passed");
  EXPECT_LT(document["cases"][0]["numbers"][0]["value"].get<double>(), 1e-14);
}

TEST_F(ValidateCommand, RefusesUnknownCasesAndFolders) {
  EXPECT_THAT([&] { validate_copy({"dispersal"}); },
              ThrowsMessage<InputError>(HasSubstr("did you mean \"dispersion\"?")));
  const Console console{.out = out_, .err = err_};
  EXPECT_THAT(
      [&] {
        validate(cases(),
                 {.names = {}, .folder = folder_ / "nowhere", .data = {}, .page = {}, .reference_curves = false},
                 console);
      },
      ThrowsMessage<InputError>(HasSubstr("no such folder of cases")));
  EXPECT_THAT(
      [&] {
        validate(cases(),
                 {.names = {}, .folder = folder_, .data = folder_ / "nowhere", .page = {}, .reference_curves = false},
                 console);
      },
      ThrowsMessage<InputError>(HasSubstr("no such folder of reference data")));
}

TEST(ShippedCases, HaveAFolderWithReadmeAndRuleAndEveryFolderHasACase) {
  const std::filesystem::path folder = froude_test::source_dir() / "validation";
  std::vector<std::string> names, folders;
  for (const Case& c : cases()) {
    names.push_back(c.name);
    EXPECT_FALSE(read_checks(folder / c.name / "accept.toml").empty());
    const std::string readme = hydro::io::read_text(folder / c.name / "README.md");
    EXPECT_THAT(readme, AllOf(HasSubstr("**Question.**"), HasSubstr("**Physics in play.**"),
                              HasSubstr("**What agreement would not show.**")))
        << c.name;
    EXPECT_EQ(std::filesystem::exists(folder / c.name / "reference"),
              std::filesystem::exists(folder / c.name / "reference" / "SOURCE.md"))
        << c.name;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(entry.path() / "accept.toml")) folders.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(folders));
}

TEST(ShippedCases, SayWhichReferenceDataTheyTake) {
  for (const Case& c : cases()) {
    const auto file = froude_test::source_dir() / "validation" / c.name / "case.cpp";
    if (!std::filesystem::exists(file)) continue;  // shares the file of another case
    const std::string code = hydro::io::read_text(file);
    const bool takes =
        code.find("folders.shared(") != std::string::npos || code.find("read_scene(") != std::string::npos;
    EXPECT_EQ(takes, !c.reference_data.empty()) << c.name;
    for (const std::string& folder : c.reference_data) EXPECT_THAT(code, HasSubstr('"' + folder + '/')) << c.name;
  }
}
#endif

}  // namespace
}  // namespace froude::validation::validate_test
