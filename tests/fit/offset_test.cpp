#include "fit/offset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "fit/problem/delay.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"
#include "support/two_clocks.hpp"

namespace offset_test {
namespace {

using fit::offset_between;
using fit::supposed;
using support::refused;
using testing::HasSubstr;

/// Two swings that die away, from a release at half a second.
double motion(double t) {
  const double since = t - 0.5;
  return since < 0 ? 0.6 : std::exp(-0.15 * since) * (0.5 * std::cos(3.1 * since) + 0.1 * std::cos(7.3 * since));
}

struct Both {
  std::vector<double> time, value, record_time, record;
};
/// A film of 25 frames a second, uneven and with gaps, and a record of 100 Hz in another unit whose clock is ahead.
Both both(std::uint64_t seed, double lag) {
  const hydro::RandomStream random(seed, 3);
  Both out;
  for (int i = 0; i < 250; ++i) {
    const auto k = static_cast<std::uint64_t>(i);
    out.time.push_back(0.04 * i + 0.004 * std::sin(1.7 * i));
    out.value.push_back(i % 17 == 3 ? std::numeric_limits<double>::quiet_NaN()
                                    : motion(out.time.back()) + 0.01 * random.normal(k));
  }
  for (int i = 0; i < 1400; ++i) {
    out.record_time.push_back(0.01 * i);
    out.record.push_back(3 - 57.3 * motion(out.record_time.back() - lag) +
                         0.3 * random.normal(1000 + static_cast<std::uint64_t>(i)));
  }
  return out;
}

TEST(Offset, IsFoundWithItsError) {
  double squares = 0, weighed = 0;
  constexpr int trials = 60;
  for (std::uint64_t k = 1; k <= trials; ++k) {
    const double lag = 1.5 + 0.01 * static_cast<double>(k) + 0.0037;
    const Both b = both(k, lag);
    const auto found = offset_between(b.time, b.value, b.record_time, b.record);
    squares += std::pow(found.lag - lag, 2) / trials;
    weighed += std::pow((found.lag - lag) / found.deviation, 2) / trials;
    EXPECT_LT(found.correlation, -0.99) << "the record is positive the other way";
  }
  EXPECT_LT(std::sqrt(squares), 0.002);
  EXPECT_NEAR(weighed, 1, 0.55);  // three deviations of the mean of 60 squares, each 1 with a deviation of 1.41
}

// All nine pairs of clocks, 400 sets each, are the case `clock-offset` of `froude validate`.
TEST(Offset, HasAnIntervalThatHolds) {
  froude_test::OffsetErrors all;
  for (const auto& of : froude_test::two_clocks) {
    const auto some = froude_test::errors_of_offsets(of, 20);
    all.sets += some.sets;
    all.refused += some.refused;
    all.within += some.within;
    all.squares += some.squares;
    all.quantiles += some.quantiles;
    // 20 squares, each 1 with a deviation of 1.41 and a little more by Student's: four of their mean, 0.32. Of a
    // deviation that is 1.5 times too small they are 2.25.
    EXPECT_LT(some.squares / some.sets, 2.25) << of.name;
    // Of a swing with noise that lasts the next one is often as likely.
    EXPECT_LE(some.refused, of.shown == froude_test::Shown::swing && of.memory > 0 ? 15 : 1) << of.name;
  }
  // Of 180 squares and intervals together: three deviations, 0.105 of the mean and 2.9 intervals of 171.
  EXPECT_NEAR(all.squares / all.sets, 1, 0.32);
  EXPECT_NEAR(all.within, 0.95 * all.sets, 8.8);
  // Student's quantile for 95 %: 1.96 of whoever has many independent samples, 2.3 of eight.
  EXPECT_NEAR(all.quantiles / all.sets, 2.1, 0.17);
}

// Of the same swing, whose next one is 1.65 s away: who knows the offset to half a second has it told, and its
// intervals hold as they do elsewhere (92 % of 60, two deviations of 2.1 less).
TEST(Offset, OfASwingIsToldWithinWhatIsKnownOfIt) {
  using enum fit::OffsetOptions::Sign;
  const auto& swing = froude_test::two_clocks.back();
  const auto anywhere = froude_test::errors_of_offsets(swing, 60);
  EXPECT_GE(anywhere.refused, 15);
  const auto known = froude_test::errors_of_offsets(swing, 60, {.sign = same, .around = 0.8, .longest = 0.5});
  EXPECT_EQ(known.refused, 0);
  EXPECT_GE(known.within, 51);
  EXPECT_EQ(supposed({.sign = same, .around = 0.8, .longest = 0.5}, "an offset"),
            "supposed: an offset between 0.3 s and 1.3 s, and record goes as film");
  EXPECT_EQ(supposed({.sign = opposite}, "an offset"), "supposed: record goes against film");
  EXPECT_EQ(supposed({}, "an offset"), "");
}

TEST(Offset, SaysWhereThereIsNone) {
  Both b = both(1, 2);
  for (std::size_t i = 0; i < b.record.size(); ++i) b.record[i] = std::sin(31 * b.record_time[i]);
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }),
              HasSubstr("do not show the same"));
  for (std::size_t i = 0; i < b.record.size(); ++i) b.record[i] = std::sin(3 * b.record_time[i]);
  for (std::size_t i = 0; i < b.value.size(); ++i) b.value[i] = std::sin(3 * b.time[i]);
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }),
              HasSubstr("two offsets fit nearly alike"));
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }), HasSubstr("repeats itself"));
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record, {.around = 100, .longest = 2}); }),
              HasSubstr("those that are looked for go from 98 s to 102 s"));
  b.record.resize(8);
  b.record_time.resize(8);
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }), HasSubstr("16 samples"));
}

/// A sea of so many waves about `centre` Hz, within `width` of it relatively, by its seed.
class Sea {
 public:
  Sea(std::uint64_t seed, double centre, double width) : random_(seed, 8), centre_(centre), width_(width) {}
  double at(double t) const {
    double sum = 0;
    for (std::uint64_t k = 0; k < 40; ++k)
      sum +=
          random_.normal(100 + k) / std::sqrt(40.0) *
          std::cos(2 * std::numbers::pi * (centre_ * (1 + width_ * random_.normal(k)) * t + random_.normal(200 + k)));
    return sum;
  }

 private:
  hydro::RandomStream random_;
  double centre_, width_;
};

/// Two probes of one sea, the second `late` and of another unit, 80 s at 20 Hz, with white noise on both.
fit::delay::Run two_probes(std::uint64_t seed, const Sea& first, const Sea& second, double late, double noise) {
  const hydro::RandomStream random(seed, 9);
  fit::delay::Run out{{"probes.csv"}, {}, {}, {}, {}};
  for (std::uint64_t i = 0; i < 1600; ++i) {
    const double t = 0.05 * static_cast<double>(i);
    out.time.push_back(t);
    out.first.push_back(0.1 + first.at(t) + noise * random.normal(i));
    out.second.push_back(2 - 25 * (second.at(t - late) + noise * random.normal(10'000 + i)));
  }
  out.second_time = out.time;
  return out;
}

// Of 100 intervals that hold with 95 % each, 95 do, with a deviation of 2.2: 89 and more is three of them.
TEST(Delay, OfTwoChannelsOfOneRecordIsWithinItsInterval) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Sea sea(seed, 0.6, 0.3);
    const double late = 0.31 + 0.001 * static_cast<double>(seed);
    fit::delay::Problem problem{{two_probes(seed, sea, sea, late, 0.3)}, {}};
    problem.options.search.longest = 1.5;
    const auto found = solve(problem);
    const fit::Estimate* delay = found.report.find("delay");
    ASSERT_NE(delay, nullptr);
    held += delay->coefficient.interval.low < late && late < delay->coefficient.interval.high;
    EXPECT_LT(found.runs[0].offset.scale, 0) << "the second is positive the other way";
  }
  EXPECT_GE(held, 89);
}

// A logger whose clock runs 0.15 % fast is 0.12 s apart at the end of 80 s: halves tell 0.057 s of that.
TEST(Delay, OfClocksThatRunApartIsRefused) {
  const Sea sea(5, 0.6, 0.3);
  fit::delay::Problem problem{{two_probes(5, sea, sea, 0.4, 0.05)}, {}};
  problem.options.search.longest = 1.5;
  EXPECT_NO_THROW(solve(problem));
  for (double& t : problem.runs[0].second_time) t *= 1.0015;
  EXPECT_THAT([&] { solve(problem); },
              testing::ThrowsMessage<hydro::InputError>(testing::AllOf(testing::HasSubstr("probes.csv"),
                                                                       testing::HasSubstr("run apart by 1.4 s in 1000"),
                                                                       testing::HasSubstr("correct the rate"))));
}

TEST(Delay, OfThreeRunsIsToldTogether) {
  fit::delay::Problem problem{{}, {}};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Sea sea(seed, 0.6, 0.3);
    problem.runs.push_back(two_probes(seed, sea, sea, -0.4, 0.2));
  }
  const auto found = solve(problem);
  ASSERT_TRUE(found.together);
  EXPECT_LT(found.together->intervals[0].low, -0.4);
  EXPECT_GT(found.together->intervals[0].high, -0.4);
}

TEST(Delay, TellsTheFirstChannelByTheSecond) {
  const Sea sea(3, 0.6, 0.3);
  const auto found = solve(fit::delay::Problem{{two_probes(3, sea, sea, 0.4, 0)}, {}}).runs[0].offset;
  EXPECT_NEAR(found.lag, 0.4, 1e-4);
  EXPECT_NEAR(found.scale, -1 / 25.0, 1e-5);
  EXPECT_NEAR(found.level, 0.1 + 2 / 25.0, 1e-4);
}

/// One sinusoid of 0.5 Hz on both, the second late.
fit::delay::Run sinusoids(double late) {
  fit::delay::Run out{{"steady.csv"}, {}, {}, {}, {}};
  const hydro::RandomStream random(1, 2);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double t = 0.02 * static_cast<double>(i);
    out.time.push_back(t);
    out.first.push_back(std::sin(std::numbers::pi * t) + 0.05 * random.normal(i));
    out.second.push_back(std::sin(std::numbers::pi * (t - late)) + 0.05 * random.normal(10'000 + i));
  }
  out.second_time = out.time;
  return out;
}

TEST(Delay, OfANarrowBandIsToldWithinTheBoundsAndTheSignThatAreKnown) {
  using enum fit::OffsetOptions::Sign;
  const auto solved = [&](double longest, fit::OffsetOptions::Sign sign, double around = 0) {
    fit::delay::Problem problem{{sinusoids(0.23)}, {}};
    problem.options.search.longest = longest;
    problem.options.search.around = around;
    problem.options.search.sign = sign;
    problem.options.one_source = true;
    return solve(problem).runs[0].offset.lag;
  };
  const double anywhere = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refused([&] { solved(anywhere, same); }), HasSubstr("repeats itself after "));
  EXPECT_THAT(refused([&] { solved(0.9, either); }), HasSubstr("repeats itself after 1 s"));  // turned round
  EXPECT_NEAR(solved(0.9, same), 0.23, 0.01);
  EXPECT_NEAR(solved(0.9, opposite), 0.23 - 1, 0.01);
  // A period of 2 s later, where it is known to be there.
  EXPECT_NEAR(solved(0.9, same, 2.5), 2.23, 0.01);
  EXPECT_NEAR(solved(0.9, same, -1.5), -1.77, 0.01);
  fit::delay::Problem unrelated{{sinusoids(0.23)}, {}};
  unrelated.options.search.longest = 0.9;
  unrelated.options.search.sign = same;
  EXPECT_THAT(refused([&] { solve(unrelated); }), HasSubstr("may have nothing in common"));
  EXPECT_THAT(refused([&] { solved(0.1, same); }), HasSubstr("at the end of the offsets that are looked for"));
}

// A search over 80 s of lags finds some correlation in any two narrow seas. Of 30 pairs 0.3 may be let through.
TEST(Delay, OfWhatHasNothingInCommonIsRefused) {
  int told = 0;
  double largest = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Sea first(seed, 0.6, 0.03), second(1000 + seed, 0.6, 0.03);
    try {
      const auto found = solve(fit::delay::Problem{{two_probes(seed, first, second, 0, 0.1)}, {}});
      largest = std::max(largest, std::abs(found.runs[0].offset.correlation));
      ++told;
    } catch (const hydro::InputError&) {
    }
  }
  EXPECT_LE(told, 1) << largest;
}

}  // namespace
}  // namespace offset_test
