// Studies: which cases they are, what is told of each, and how they are kept.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <fstream>
#include <map>
#include <mutex>
#include <numbers>
#include <set>
#include <thread>

#include "answers/plot_field.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/scratch.hpp"
#include "sweep/ranks.hpp"
#include "sweep/sweep.hpp"
#include "sweep/table.hpp"
#include "sweep/team.hpp"

namespace froude_test::sweep_of_cases {
namespace {

namespace fs = std::filesystem;
using froude::sweep::Cases, froude::sweep::Cell, froude::sweep::Row, froude::sweep::State, froude::sweep::Store,
    froude::sweep::Study;
using testing::HasSubstr, testing::ThrowsMessage, testing::AllOf;

// ω = √(k/m) = 2 rad/s, undamped, let go 0.2 m from rest.
constexpr const char* oscillator = R"(schema = 1
[water]
density = "1025 kg/m^3"
depth = "infinite"
[[body]]
name = "block"
position = "(1, 2, 0) m"        # by hand
mass = "100 kg"
free = "surge"
initial = { surge = "20 cm" }
[[mooring]]
on = "block"
kind = "linear"
stiffness = { surge = "400 N/m" }
[ask]
modes = {}
run = { duration = "15 s", every = "0.1 s", of = ["block.surge"] }
accuracy = 1e-3
)";

constexpr const char* outputs = R"(
[[output]]
kind = "run"
of = "block.*"
statistic = ["deviation", "maximum", "significant"]
[[output]]
kind = "modes"
statistic = "period"
)";

std::string axis(const std::string& key, const std::string& values, const std::string& more = "") {
  return fmt::format("[[axis]]\nkey = \"{}\"\n{}\n{}\n", key, values, more);
}
Study study_of(const std::string& axes, const std::string& of = outputs) {
  return froude::sweep::parse_study("schema = 1\nscene = \"block.toml\"\n" + axes + of, "study.toml");
}
double number(const Cell& cell) { return std::get<double>(cell); }

const std::string masses = axis("body.block.mass", "values = [\"25 kg\", \"100 kg\", \"400 kg\"]", "name = \"mass\"");
const std::string starts =
    axis("body.block.initial.surge", "range = \"0.1 m .. 0.2 m, every 0.1 m\"", "name = \"start\"");

// 4 s are 1.3 periods of π s: no three waves have a highest third.
TEST(Answers, SayWhyANumberIsMissing) {
  std::string text = oscillator;
  text.replace(text.find("15 s"), 4, "4 s");
  const Study study = study_of(starts);
  const auto found = froude::sweep::answer_of(study, Cases(study, text, {}), 1, nullptr, {});
  EXPECT_THAT(found.row.reason,
              testing::MatchesRegex("no block.surge.significant: the signal has [01] waves?, fewer than "
                                    "the 3 that have a highest third"));
}

TEST(Cases, AreEveryValueWithEveryOtherTheLastAxisFirst) {
  const Study study = study_of(masses + starts);
  const Cases cases(study, oscillator, {});
  ASSERT_EQ(cases.count(), 6u);
  const double mass[] = {25, 25, 100, 100, 400, 400};
  for (std::size_t n = 1; n <= 6; ++n) {
    EXPECT_EQ(number(cases.cells(n)[0]), mass[n - 1]);
    EXPECT_EQ(number(cases.cells(n)[1]), n % 2 == 1 ? 0.1 : 0.2);
  }
}

TEST(Cases, ChangeNothingElseInTheTextOfTheScene) {
  const Study study = study_of(masses + axis("body[1].position.y", "values = [\"250 cm\", \"7 m\"]") +
                               axis("ask.accuracy", "range = \"1e-4 .. 1e-2, 3 values\"", "spacing = \"logarithmic\""));
  const Cases cases(study, oscillator, {});
  std::string expected = oscillator;
  const auto replace = [&](const std::string& from, const std::string& to) {
    expected.replace(expected.find(from), from.size(), to);
  };
  replace("\"100 kg\"", "\"400 kg\"");
  replace("(1, 2, 0) m", "(1, 2.5, 0) m");
  replace("1e-3", "0.001");
  EXPECT_EQ(cases.scene(14), expected);  // third mass, first place, second accuracy
}

TEST(Cases, OfAxesAlongEachOtherTakeTheirValuesTogether) {
  const Study study = study_of(
      masses + axis("mooring.stiffness.surge", "values = [\"1 N/m\", \"2 N/m\", \"3 N/m\"]", "along = \"mass\"") +
      starts);
  const Cases cases(study, oscillator, {});
  ASSERT_EQ(cases.count(), 6u);
  EXPECT_EQ(number(cases.cells(5)[0]), 400);
  EXPECT_EQ(number(cases.cells(5)[1]), 3);
  EXPECT_THAT([&] { study_of(masses + axis("water.density", "values = [\"1 t/m^3\"]", "along = \"mas\"")); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("mas"), HasSubstr("did you mean \"mass\"?"))));
  const Study uneven = study_of(masses + axis("water.density", "values = [\"1 t/m^3\"]", "along = \"mass\""));
  EXPECT_THAT([&] { Cases(uneven, oscillator, {}); }, ThrowsMessage<hydro::InputError>(HasSubstr("3")));
}

/// The shares of two sampled axes, from 0 to 1.
std::vector<std::array<double, 2>> drawn(const std::string& sample) {
  const Study study = study_of(axis("body.block.mass", "range = \"100 kg .. 200 kg\"") +
                               axis("body.block.initial.surge", "range = \"1 m .. 2 m\"") + sample);
  const Cases cases(study, oscillator, {});
  std::vector<std::array<double, 2>> out;
  for (std::size_t n = 1; n <= cases.count(); ++n)
    out.push_back({number(cases.cells(n)[0]) / 100 - 1, number(cases.cells(n)[1]) - 1});
  return out;
}

TEST(LatinHypercube, HasOnePointInEachPartOfEachAxis) {
  const auto points = drawn("[sample]\nmethod = \"latin hypercube\"\nnumber = 37\nseed = 5\n");
  ASSERT_EQ(points.size(), 37u);
  for (const std::size_t a : {0u, 1u}) {
    std::set<int> parts;
    for (const auto& p : points) parts.insert(static_cast<int>(p[a] * 37));
    EXPECT_EQ(parts.size(), 37u);
  }
  EXPECT_NE(points, drawn("[sample]\nmethod = \"latin hypercube\"\nnumber = 37\nseed = 6\n"));
}

TEST(Sobol, HasOnePointInEachBoxOfANet) {
  // The first two dimensions of the sequence are a (0, m, 2)-net in base 2: each box of 2^-a by 2^-b with a + b = m has
  // one of 2^m points (Sobol 1967), and turning bits over exchanges boxes.
  for (const int seed : {1, 2}) {
    const auto points = drawn(fmt::format("[sample]\nmethod = \"sobol\"\nnumber = 16\nseed = {}\n", seed));
    for (int a = 0; a <= 4; ++a) {
      std::set<std::pair<int, int>> boxes;
      for (const auto& p : points)
        boxes.insert({static_cast<int>(p[0] * (1 << a)), static_cast<int>(p[1] * (16 >> a))});
      EXPECT_EQ(boxes.size(), 16u) << a;
    }
  }
}

TEST(Cases, AreSkippedWhereWavesAreTooSteep) {
  const std::string waves = std::string(oscillator) +
                            "[waves]\nkind = \"regular\"\nheight = \"2 m\"\nperiod = \"5 s\"\nheading = \"0 deg\"\n";
  // λ = gT²/2π in deep water: of T = 5 s it is 39.0 m, of 8 s 99.9 m.
  const Study study =
      study_of(axis("waves.height", "values = [\"2 m\", \"2.7 m\", \"2.75 m\"]", "name = \"H\"") +
               axis("waves.period", "values = [\"5 s\", \"8 s\"]") +
               "[[skip]]\nof = \"steepness\"\nabove = 0.07\n[[skip]]\nof = \"H\"\nbelow = \"210 cm\"\n");
  const Cases cases(study, waves, {});
  const double limit = 0.07 * 9.80665 * 25 / (2 * std::numbers::pi);  // 2.73 m
  ASSERT_TRUE(2.7 < limit && limit < 2.75);
  std::vector<bool> skipped;
  for (std::size_t n = 1; n <= 6; ++n) skipped.push_back(cases.skipped(n).has_value());
  EXPECT_EQ(skipped, (std::vector{true, true, false, false, true, false}));
}

TEST(Studies, RefuseWhatNoSceneCanHave) {
  const auto refused = [](const std::string& axes, const std::string& why) {
    EXPECT_THAT(
        [&] {
          const Study study = study_of(axes);
          Cases(study, oscillator, {});
        },
        ThrowsMessage<hydro::InputError>(HasSubstr(why)));
  };
  refused(axis("body.block.mas", "values = [\"1 kg\"]"), "did you mean \"mass\"?");
  refused(axis("body.block", "values = [\"1 kg\"]"), "is a table");
  refused(axis("body.block.mass", "range = \"1 kg .. 2 s, 3 values\""), "different dimensions");
  refused(axis("body.block.mass", "range = \"1 kg .. 2 kg, every 0.3 kg\""), "whole number of steps");
  refused(axis("body.block.mass", "range = \"1 kg .. 2 kg\""), "does not say how many");
  refused(axis("schema", "range = \"1 .. 2, 3 values\""), "is an integer");
  refused(axis("body.block.mass", "range = \"-1 kg .. 2 kg, 3 values\"", "spacing = \"logarithmic\""), "meets 0");
  refused(masses + axis("body[1].mass", "values = [\"1 kg\"]"), "change the same value");
  refused(masses + masses, "there is a column \"mass\" already");
  refused(axis("body.block.position.x", "values = [\"one\"]"), "component");
  refused(axis("body.block.mass", "range = \"1 kg .. 1000000 kg, every 1 g\""), "whole number of steps");
}

TEST(Studies, RefusePicturesThatCannotBe) {
  const auto refused = [](const std::string& picture, const std::string& why) {
    EXPECT_THAT([&] { study_of(masses + starts, outputs + ("[[picture]]\nfile = \"p.svg\"\n" + picture)); },
                ThrowsMessage<hydro::InputError>(HasSubstr(why)));
  };
  refused("of = \"block.surge\"\nx = \"time\"\n", "which this study does not keep");
  refused("of = \"block.surge.deviation\"\nx = \"mass\"\npanel = \"stat\"\n", "did you mean \"start\"?");
  refused("of = \"block.surge.deviation\"\nx = \"mas\"\n", "did you mean \"mass\"?");
}

TEST(Numbers, AreThoseOfTheClosedForm) {
  const Study study = study_of(masses + starts);
  const Cases cases(study, oscillator, {});
  const auto kept = std::make_shared<froude::compile::Kept>();
  for (std::size_t n = 1; n <= cases.count(); ++n) {
    const Row row = answer_case(study, cases, n, kept);
    ASSERT_EQ(row.state, State::done) << row.reason;
    const double omega = std::sqrt(400 / number(row.axes[0])), start = number(row.axes[1]);
    double mean = 0, squares = 0;
    for (int i = 0; i <= 150; ++i) mean += start * std::cos(omega * 0.1 * i) / 151;
    for (int i = 0; i <= 150; ++i) squares += std::pow(start * std::cos(omega * 0.1 * i) - mean, 2) / 151;
    const double accuracy = 1e-3;  // that the scene asks for, of deviation and extreme
    EXPECT_NEAR(number(row.numbers[0]), std::sqrt(squares), accuracy * std::sqrt(squares));
    EXPECT_NEAR(number(row.numbers[1]), start, accuracy * start);
    // Crest and trough are samples, which miss them by 1 − cos(ωΔt/2) each at most.
    const double sampled = 1 - std::cos(omega * 0.05);
    if (omega > 1.5) {  // three waves and more
      EXPECT_NEAR(number(row.numbers[2]), 2 * start, (accuracy + sampled) * 2 * start);
    }
    EXPECT_NEAR(number(row.numbers[3]), 2 * std::numbers::pi / omega, 1e-9);  // an eigenvalue of one equation
  }
}

// Sweeps

class Sweeps : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder());
    fs::create_directories(folder());
    std::ofstream(folder() / "block.toml") << oscillator;
  }
  static fs::path folder() {
    return support::scratch_folder() / testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  Study study(const std::string& axes = masses + starts) const {
    return froude::sweep::parse_study("schema = 1\nscene = \"block.toml\"\n" + axes + outputs, folder() / "study.toml");
  }
  static froude::sweep::Identity identity(const Study& study, const Cases& cases) {
    return {cases.definition(), "study.toml", study.text, oscillator, cases.count(), cases.columns()};
  }
  /// The table of a sweep into a folder.
  std::string table(const std::string& name, const froude::sweep::Options& options,
                    const std::function<bool()>& interrupted = {}) const {
    const Study of = study();
    const Cases cases(of, oscillator, {});
    Store store(folder() / name, identity(of, cases));
    carry_out(of, cases, store, options, {{}, {}, interrupted});
    return hydro::io::read_text(write_table(store));
  }
};

TEST_F(Sweeps, TellTheSameBitsWhateverTheOrder) {
  const std::string one = table("one", {.threads = 1});
  EXPECT_THAT(one, HasSubstr("case,mass [kg],start [m],block.surge.deviation [m]"));
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 7);
  EXPECT_EQ(table("two", {.threads = 2}), one);
  int asked = 0;
  const std::string begun = table("resumed", {.threads = 1}, [&] { return ++asked > 100; });
  EXPECT_LT(std::count(begun.begin(), begun.end(), '\n'), 7);  // some cases, not all
  EXPECT_EQ(table("resumed", {.threads = 2}), one);
}

TEST_F(Sweeps, MergedAreTheWholeAndMergedAgainTheSame) {
  const std::string whole = table("whole", {.threads = 2});
  table("a", {.threads = 1, .part = 1, .parts = 2});
  table("b", {.threads = 1, .part = 2, .parts = 2});
  const Study of = study();
  const Cases cases(of, oscillator, {});
  for (int times = 0; times < 2; ++times) {
    Store into(folder() / "merged", identity(of, cases));
    froude::sweep::merge({folder() / "a", folder() / "b"}, into);
    EXPECT_EQ(hydro::io::read_text(write_table(into)), whole);
  }
}

/// Ranks that are threads of this process.
class Mail {
 public:
  explicit Mail(int count)
      : boxes_(static_cast<std::size_t>(count)), answered_(static_cast<std::size_t>(count), false) {}

  class Rank : public froude::sweep::Ranks {
   public:
    Rank(Mail& mail, int rank) : mail_(mail), rank_(rank) {}
    int rank() const override { return rank_; }
    int count() const override { return static_cast<int>(mail_.boxes_.size()); }
    void send(int to, const std::string& text) override {
      const std::scoped_lock lock(mail_.mutex_);
      mail_.boxes_.at(static_cast<std::size_t>(to)).push_back({rank_, text});
      if (text.rfind("ask\n0\n", 0) != 0 && to == 0) mail_.answered_[static_cast<std::size_t>(rank_)] = true;
    }
    std::optional<Message> received() override {
      const std::scoped_lock lock(mail_.mutex_);
      auto& box = mail_.boxes_.at(static_cast<std::size_t>(rank_));
      if (box.empty()) return std::nullopt;
      const Message out = box.front();
      box.pop_front();
      return out;
    }

   private:
    Mail& mail_;
    int rank_;
  };

  /// Waits until a rank has told rank 0 of a case that it has answered, or has ended.
  void await(int rank) {
    while (true) {
      {
        const std::scoped_lock lock(mutex_);
        if (answered_.at(static_cast<std::size_t>(rank))) return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  bool empty() const {
    return std::all_of(boxes_.begin(), boxes_.end(), [](const auto& box) { return box.empty(); });
  }

 private:
  std::mutex mutex_;
  std::vector<std::deque<froude::sweep::Ranks::Message>> boxes_;
  std::vector<bool> answered_;
};

class RanksOfASweep : public Sweeps {
 protected:
  /// Where rank 1 takes the folder of the sweep to be; the others have the right one.
  std::string other_name = {};
  /// Ranks 0 and 2 take no case, but for the one that rank 0 begins with, before rank 1 has answered one.
  bool rank_1_is_first = false;
  /// The table of a sweep that three ranks share; `first` is done by rank 1 before it helps.
  std::string shared(const std::string& name, const std::function<void()>& first = {},
                     froude::sweep::Tally* told = nullptr, const std::function<bool()>& interrupted = {}) const {
    const Study of = study();
    const Cases cases(of, oscillator, {});
    Mail mail(3);
    std::vector<std::thread> helpers;
    for (const int rank : {1, 2})
      helpers.emplace_back([&, rank] {
        Mail::Rank ranks(mail, rank);
        froude::sweep::Helper helper(ranks);
        helper.run([&] {
          if (rank == 1 && first) first();
          if (rank == 2 && rank_1_is_first) mail.await(1);
          const std::string seen = rank == 1 && !other_name.empty() ? other_name : name;
          help_out(of, cases, folder() / seen, identity(of, cases), 1, helper, [] { return false; });
        });
      });
    Mail::Rank ranks(mail, 0);
    froude::sweep::Master master(ranks);
    Store store(folder() / name, identity(of, cases));
    const auto hands_out = std::this_thread::get_id();
    const auto looked_after = [&] {  // by the thread that hands out, and by the one that answers
      if (rank_1_is_first && std::this_thread::get_id() != hands_out) mail.await(1);
      return interrupted && interrupted();
    };
    std::exception_ptr thrown;
    try {
      const auto tally = carry_out(of, cases, store, {.threads = 1, .ranks = &master}, {{}, {}, looked_after});
      if (told != nullptr) *told = tally;
    } catch (...) {
      thrown = std::current_exception();
      master.dismiss();
    }
    for (std::thread& helper : helpers) helper.join();
    EXPECT_TRUE(mail.empty());  // MPI may not end before all is read
    if (thrown) std::rethrow_exception(thrown);
    return hydro::io::read_text(write_table(store));
  }
};

TEST_F(RanksOfASweep, TellTheSameBitsAsOneAndLeaveOneFile) {
  EXPECT_EQ(shared("three"), table("one", {.threads = 1}));
  EXPECT_FALSE(fs::exists(folder() / "three" / "rank-00001"));
  froude::sweep::Tally again;
  shared("three", {}, &again);  // nothing to do
  EXPECT_EQ(again.answered, 0u);
}

TEST_F(RanksOfASweep, ThatHaveDiedAreTakenOverAndTheirOtherCasesDone) {
  const std::string whole = table("whole", {.threads = 1});
  // Ranks 1 and 7 of an earlier start: one had answered two cases of six, one was killed as it began.
  table("sweep/rank-00001", {.threads = 1, .part = 3, .parts = 4});
  fs::create_directories(folder() / "sweep" / "rank-00007");
  froude::sweep::Tally told;
  EXPECT_EQ(shared("sweep", {}, &told), whole);
  EXPECT_EQ(told.unfinished_ranks, 2u);
  EXPECT_EQ(told.answered, 5u);
  EXPECT_FALSE(fs::exists(folder() / "sweep" / "rank-00007"));
}

TEST_F(RanksOfASweep, EndWhenRankZeroIsInterruptedAndKeepWhatTheyHave) {
  froude::sweep::Tally told;
  std::atomic<int> asked = 0;
  shared("sweep", {}, &told, [&] { return ++asked > 100; });
  EXPECT_TRUE(told.interrupted);
  EXPECT_LT(told.done, 6u);
  EXPECT_EQ(told.done, told.answered);
  froude::sweep::Tally again;
  EXPECT_EQ(shared("sweep", {}, &again), table("one", {.threads = 1}));
  EXPECT_EQ(again.answered, 6 - told.answered);
}

TEST_F(RanksOfASweep, ThatFailAreNamedAndWhatTheOthersDidIsKept) {
  EXPECT_THAT([&] { shared("sweep", [] { throw hydro::InputError("the disk of this machine is full"); }); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("rank 1"), HasSubstr("disk of this machine"))));
  froude::sweep::Tally again;
  EXPECT_EQ(shared("sweep", {}, &again), table("one", {.threads = 1}));
  EXPECT_EQ(again.answered, 0u);  // the other two had answered all
}

TEST_F(RanksOfASweep, ThatSeeAnotherFolderAreFoundOut) {
  other_name = "elsewhere";
  rank_1_is_first = true;
  EXPECT_THAT([&] { shared("sweep"); }, ThrowsMessage<hydro::InputError>(HasSubstr("machines see another folder")));
}

TEST_F(Sweeps, OfAnotherStudyAreRefusedWithTheFirstDifference) {
  table("sweep", {.threads = 1});
  const Study other =
      study(masses + axis("body.block.initial.surge", "values = [\"0.1 m\", \"0.3 m\"]", "name = \"start\""));
  const Cases cases(other, oscillator, {});
  EXPECT_THAT([&] { Store(folder() / "sweep", identity(other, cases)); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("value 0.2 m"), HasSubstr("value 0.3 m"))));
  const Study same = study();
  const Cases again(same, oscillator, {});
  const Store held(folder() / "sweep", identity(same, again));
  EXPECT_THAT([&] { Store(folder() / "sweep", identity(same, again)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("another sweep is at work")));
}

TEST_F(Sweeps, ThatAreReadStayAsTheyAre) {
  const std::string text = table("sweep", {.threads = 1});
  const auto whole = [&] {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder() / "sweep"))
      if (entry.is_regular_file())
        out[entry.path().string()] =
            hydro::io::read_text(entry.path()) + std::to_string(entry.last_write_time().time_since_epoch().count());
    return out;
  };
  const auto before = whole();
  {
    Store read(folder() / "sweep");
    EXPECT_EQ(read.rows().size(), 6u);
    EXPECT_THROW(read.set_columns({}), hydro::InputError);
  }
  EXPECT_EQ(whole(), before);
}

TEST_F(Sweeps, ThatAreHeldByAnotherTellWhatIsOver) {
  const Study of = study();
  const Cases cases(of, oscillator, {});
  Store store(folder() / "sweep", identity(of, cases));
  carry_out(of, cases, store, {.threads = 1, .part = 1, .parts = 2}, {});
  EXPECT_EQ(Store(folder() / "sweep").rows().size(), 3u);
}

TEST_F(Sweeps, GoOnAfterACaseThatFails) {
  const Study of = study(axis("body.block.mass", "values = [\"-1 kg\", \"100 kg\", \"-2 kg\", \"25 kg\"]"));
  const Cases cases(of, oscillator, {});
  Store store(folder() / "sweep", identity(of, cases));
  const auto tally = carry_out(of, cases, store, {.threads = 2}, {});
  EXPECT_EQ(tally.done, 2u);
  ASSERT_EQ(tally.failed, 2u);
  EXPECT_THAT(tally.failures[1].second, AllOf(HasSubstr("mass"), HasSubstr("positive")));
  EXPECT_EQ(store.rows()[0].numbers.size(), 0u);
  EXPECT_EQ(store.rows()[1].numbers.size(), 4u);
}

// Contours

TEST(Contours, LieWhereAFieldThatIsLinearSaysSo) {
  const froude::plot::Field field{{"z"}, {0, 1, 3}, {0, 2}, {{0, 1, 3}, {4, 5, 7}}};  // x + 2y
  double length = 0;
  for (const auto& p : froude::plot::contour(field, 2.5)) {
    EXPECT_NEAR(p.x1 + 2 * p.y1, 2.5, 1e-14);  // rounding of a dozen operations
    EXPECT_NEAR(p.x2 + 2 * p.y2, 2.5, 1e-14);
    length += std::hypot(p.x2 - p.x1, p.y2 - p.y1);
  }
  EXPECT_NEAR(length, std::hypot(2.5, 1.25), 1e-14);  // from (2.5, 0) to (0, 1.25), whole
}

TEST(Contours, LeaveOutWhatIsNotKnown) {
  const double none = std::nan("");
  const froude::plot::Field field{{"z"}, {0, 1, 2}, {0, 1}, {{0, 1, 2}, {0, 1, none}}};
  EXPECT_EQ(froude::plot::tiles_of(field).size(), 5u);
  for (const auto& p : froude::plot::contour(field, 1.5)) EXPECT_LE(p.y1, p.x1 - 1 + 1e-14);
}

TEST(Contours, AreOneLineWhereTheirPiecesMeet) {
  froude::plot::Field field{{"z"}, {}, {}, {}};
  for (int i = -10; i <= 10; ++i) field.xs.push_back(0.1 * i), field.ys.push_back(0.1 * i);
  for (const double y : field.ys) {
    field.values.emplace_back();
    for (const double x : field.xs) field.values.back().push_back(x * x + y * y);
  }
  const auto circle = froude::plot::joined(froude::plot::contour(field, 0.52));  // through no point of the grid
  ASSERT_EQ(circle.size(), 1u);                                                  // it closes
  EXPECT_EQ(circle[0].x.front(), circle[0].x.back());
  EXPECT_EQ(circle[0].y.front(), circle[0].y.back());
  for (std::size_t i = 0; i < circle[0].x.size();
       ++i)  // straight lines between neighbours: a chord of 0.14 leaves 0.0025
    EXPECT_NEAR(std::hypot(circle[0].x[i], circle[0].y[i]), std::sqrt(0.52), 4e-3);
  EXPECT_EQ(froude::plot::joined(froude::plot::contour(field, 1.5)).size(), 4u);  // one across each corner
}

}  // namespace
}  // namespace froude_test::sweep_of_cases
