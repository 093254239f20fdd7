// Transfer functions of irregular waves from the segments of several runs. (F107)
#include "fit/problem/irregular_waves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/coloured_noise.hpp"

namespace irregular_waves_test {
namespace {

using fit::irregular_waves::Problem;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double step = 0.1, gain = 1.4;

/// White waves of a deviation that is the run's own, and a response of them with noise: 14 samples a segment.
fit::WaveRun white_run(std::uint64_t stream, std::size_t samples, double slope = 1) {
  fit::WaveRun out{{fmt::format("run_{}.csv", stream)}, {}, froude_test::ar1_noise(samples, 0, 0.05, 2 * stream), {}};
  const auto noise = froude_test::ar1_noise(samples, 0, 0.04, 2 * stream + 1);
  fit::WaveChannel heave{"heave", {}};
  for (std::size_t i = 0; i < samples; ++i) {
    out.time.push_back(step * static_cast<double>(i));
    heave.values.push_back(slope * (gain * out.elevation[i] + noise[i]));
  }
  out.responses = {heave};
  return out;
}

Problem pooled(std::uint64_t seed, std::size_t runs, double slope = 1) {
  Problem out{.runs = {}, .units = {"m"}, .options = {.segment_s = 6.4}};
  for (std::size_t r = 0; r < runs; ++r)
    out.runs.push_back(white_run(1000 * seed + r, 200 + 60 * r, slope));  // of different lengths
  return out;
}

// 300 seeds of 31 frequencies, four runs: of 9300 intervals 95 % hold. Those of one seed are independent but for their
// neighbours, which Hann correlates: a deviation of 0.3 %, three of them.
TEST(IrregularWaves, OfSeveralRunsHoldTheTruthAsOftenAsTheySay) {
  int held = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    for (const auto response = solve(pooled(seed, 4)).responses[0]; const fit::Coefficient& c : response.gain) {
      if (&c == &response.gain.front() || &c == &response.gain.back()) continue;  // real: half the freedom
      held += c.interval.low < gain && gain < c.interval.high;
      ++all;
    }
  EXPECT_NEAR(static_cast<double>(held) / all, 0.95, 0.01);
}

TEST(IrregularWaves, OfSeveralRunsAreKnownBetterThanOfOne) {
  const auto one = solve(pooled(7, 1)), four = solve(pooled(7, 4));
  // 5, 7, 9 and 10 segments.
  EXPECT_EQ(one.segments, 5u);
  EXPECT_EQ(four.segments, 31u);
  // Windows that overlap share a little, the less the fewer of them do: 2 %.
  EXPECT_NEAR(four.responses[0].transfer.averages / one.responses[0].transfer.averages, 31 / 5.0, 0.02 * 31 / 5.0);
}

/// |H| of a float whose resonance is at 0.12 Hz, damping 8 % of critical.
std::complex<double> float_at(double f) {
  const double r = f / 0.12;
  return 1.0 / std::complex<double>(1 - r * r, 2 * 0.08 * r);
}

/// Half an hour of a sea of Pierson and Moskowitz with its peak at 0.1 Hz, waves at every frequency of the record, and
/// the float with noise of a tenth of the waves' deviation.
Problem sea_and_float(std::uint64_t seed) {
  constexpr std::size_t n = 3600;
  constexpr double between = 0.5, peak = 0.1;
  const hydro::RandomStream random(seed, 118);
  std::vector<std::complex<double>> waves(n / 2 + 1), response(n / 2 + 1);
  double variance = 0;
  for (std::size_t k = 1; k < n / 2; ++k) {
    const double f = static_cast<double>(k) / (between * n);
    if (f < 0.02) continue;
    const double density = std::pow(f, -5) * std::exp(-1.25 * std::pow(peak / f, 4));
    waves[k] = std::sqrt(density) * std::complex<double>(random.normal(2 * k), random.normal(2 * k + 1));
    response[k] = waves[k] * float_at(f);
    variance += 2 * std::norm(waves[k]);
  }
  Problem out{.runs = {{{"sea.csv"},
                        {},
                        hydro::signal::inverse_real_fft(waves, n),
                        {{"heave", hydro::signal::inverse_real_fft(response, n)}}}},
              .units = {"m"},
              .options = {}};
  const auto noise = froude_test::ar1_noise(n, 0, 0.1 * std::sqrt(variance), seed);
  for (std::size_t i = 0; i < n; ++i) {
    out.runs[0].time.push_back(between * static_cast<double>(i));
    out.runs[0].responses[0].values[i] += noise[i];
  }
  return out;
}

/// How many of the intervals at a frequency hold the float's gain, and how many of those without the resolution do.
struct Held {
  int with = 0, without = 0;
};
Held held_at(double hz, int seeds) {
  Held out;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto r = solve(sea_and_float(static_cast<std::uint64_t>(seed))).responses[0];
    const auto& f = r.transfer.frequency_hz;
    const auto k = static_cast<std::size_t>(std::lround(hz / f[1]));
    const double truth = std::abs(float_at(f[k])), found = std::abs(r.transfer.h1[k]);
    out.with += r.gain[k].interval.low < truth && truth < r.gain[k].interval.high;
    out.without += std::abs(found - truth) < r.half_width[k];
  }
  return out;
}

// At 0.07 Hz the sea rises by a factor of ten in 0.01 Hz, and segments of 225 s take in what lies above: the gain comes
// out too large by most of a half-width. At 0.2 Hz it changes little over the resolution. 95 of 100 are expected, with
// a deviation of 2.2, three of them allowed; the interval that reaches over a shift may hold more often.
TEST(IrregularWaves, CountTheResolutionOnASteepFlank) {
  const Held flank = held_at(0.071, 100), flat = held_at(0.2, 100);
  EXPECT_LE(flank.without, 75);
  EXPECT_GE(flank.with, 88);
  EXPECT_GE(flat.with, 88);
}

// The mean of 40 seeds is known to a seventh of a half-width of one; Richardson's rest is a quarter of the shift there.
TEST(IrregularWaves, KnowWhichWayTheResolutionMovesAGain) {
  double bias = 0, shift = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto r = solve(sea_and_float(seed)).responses[0];
    const auto k = static_cast<std::size_t>(std::lround(0.071 / r.transfer.frequency_hz[1]));
    bias += (std::abs(r.transfer.h1[k]) - std::abs(float_at(r.transfer.frequency_hz[k]))) / r.half_width[k] / 40;
    shift += r.resolution[k] / r.half_width[k] / 40;
  }
  EXPECT_GT(bias, 0.5);
  EXPECT_NEAR(shift, -bias, 0.15 + 0.25 * bias);
}

TEST(IrregularWaves, AreSaidToHaveShortSegmentsByName) {
  const auto found = solve(sea_and_float(1));
  EXPECT_THAT(found.report.parts.back().cautions,
              testing::Contains(testing::AllOf(HasSubstr("the resolution of the segments moves the gain of heave"),
                                               HasSubstr("% too "))));
  // A gain that is the same at all frequencies has no bias of resolution: what is left is noise of the estimate, a
  // tenth of a half-width, and twice that is a chance of a few in a hundred.
  const auto white = solve(pooled(3, 40)).responses[0];
  int beyond = 0;
  for (std::size_t k = 1; k + 1 < white.gain.size(); ++k)
    beyond += std::abs(white.resolution[k]) > 0.2 * white.half_width[k];
  EXPECT_LE(beyond, 3);
}

// Each seed has a slope of its own, off by 3 %: at one frequency 190 of 200 intervals hold, with a deviation of 3.1.
TEST(IrregularWaves, CountTheErrorsOfTheSlopes) {
  int with = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Problem problem = pooled(seed, 6, 1 + 0.06 * hydro::RandomStream(seed, 11).normal(0));
    const auto held = [&] {
      const fit::Interval i = solve(problem).responses[0].gain[10].interval;
      return i.low < gain && gain < i.high;
    };
    without += held();
    problem.response_slopes = {{0.06, 1.96 * 0.06}};
    with += held();
  }
  EXPECT_NEAR(with, 190, 9);
  EXPECT_LT(without, 181);
}

/// Forty waves that go from the gauge to the body, which follows the surface there.
Problem between(double gauge, double body) {
  const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(1.25)};
  Problem out{.runs = {{{"run.csv"}, {}, {}, {{"heave", {}}}}},
              .units = {"m"},
              .options = {.segment_s = 51.2, .tank = fit::WaveTank{.water = water, .gauge = gauge, .body = body}}};
  const hydro::RandomStream random(3, 1);
  for (std::size_t i = 0; i < 6000; ++i) {
    const double t = step * static_cast<double>(i);
    double at_gauge = 0, at_body = 0;
    for (std::uint64_t n = 0; n < 200; ++n) {
      const double omega = 3.6 + 0.01 * static_cast<double>(n) + 0.005 * random.normal(n),
                   phase = omega * t + 6.28 * random.normal(1000 + n), k = hydro::waves::wavenumber(omega, water);
      at_gauge += 0.01 * std::cos(phase - k * gauge);
      at_body += 0.01 * std::cos(phase - k * body);
    }
    auto& run = out.runs[0];
    run.time.push_back(t);
    run.elevation.push_back(at_gauge);
    run.responses[0].values.push_back(at_body);
  }
  return out;
}

// What follows the surface has a gain of 1 and no phase, wherever the gauge stands. From 3.6 to 5.6 rad/s energy goes
// at 1.5 to 0.9 m/s: over 6 m it is up to 2.8 s early or late of the shift, ⅔(π 2.8/51)² = 2 % of the gain; 1 % is left
// for waves that leak. What a segment loses is as noise to the phase: four of its errors in 34 phases.
TEST(IrregularWaves, HaveThePhaseOfTheWaveAtTheBody) {
  for (const double gauge : {17.0, 26.0}) {
    const auto found = solve(between(gauge, 23));
    const auto& t = found.responses[0].transfer;
    for (std::size_t k = 0; k < t.h1.size(); ++k) {
      if (t.frequency_hz[k] < 0.6 || t.frequency_hz[k] > 0.86) continue;
      EXPECT_NEAR(std::abs(t.h1[k]), 1, 0.03) << gauge << " m, " << t.frequency_hz[k] << " Hz";
      EXPECT_LT(t.gain_relative_error[k], 0.025);
      EXPECT_NEAR(std::arg(t.h1[k]), 0, 0.01 + 4 * t.gain_relative_error[k])
          << gauge << " m, " << t.frequency_hz[k] << " Hz";
    }
  }
}

TEST(IrregularWaves, SayWhereSegmentsAreShortAgainstWhatWavesDifferBy) {
  Problem p = between(17, 23);
  EXPECT_TRUE(solve(p).report.cautions.empty());
  p.options.segment_s = 12.8;  // sixteen times as much
  const auto found = solve(p);
  ASSERT_EQ(found.report.cautions.size(), 1u);
  EXPECT_THAT(found.report.cautions[0], HasSubstr("too small"));
}

TEST(IrregularWaves, RefuseWhatCannotBePooled) {
  const auto solved = [](Problem p) { return [p] { solve(p); }; };
  Problem p = pooled(1, 2);
  for (double& t : p.runs[1].time) t *= 2;
  EXPECT_THAT(solved(p), ThrowsMessage<hydro::InputError>(HasSubstr("run_1001.csv: error: it is sampled every 0.2 s")));
  p = pooled(1, 2);
  p.options.segment_s = 100;
  EXPECT_THAT(solved(p),
              ThrowsMessage<hydro::InputError>(HasSubstr("run_1000.csv: error: a segment of 100 s has 1000 samples")));
  p = pooled(1, 1);
  p.options.segment_s = 20;
  EXPECT_THAT(solved(p), ThrowsMessage<hydro::InputError>(HasSubstr("at least two segments")));
  p.runs.clear();
  EXPECT_THAT(solved(p), ThrowsMessage<hydro::InputError>(HasSubstr("no runs")));
}

// Unrelated channels have a coherence below the threshold at 95 % of the frequencies: no gain is told there.
TEST(IrregularWaves, TellNoGainOfWhatIsUnrelated) {
  int told = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Problem p = pooled(seed, 3);
    for (std::size_t r = 0; r < 3; ++r)
      p.runs[r].elevation = white_run(9000 + 10 * seed + r, p.runs[r].time.size()).elevation;
    const auto found = solve(p);
    for (std::size_t k = 1; k < 32; ++k, ++all) told += found.responses[0].gain[k].value.has_value();
  }
  EXPECT_NEAR(static_cast<double>(told) / all, 0.05, 0.02);  // 1240 of them, a deviation of 0.6 %
}

// Of white waves what the band passes has the gain that it has without it, to three of its errors; where the filters
// leave less than half nothing is told.
TEST(IrregularWaves, TellNoGainOfWhatFiltersTake) {
  Problem p{.runs = {white_run(5, 8000)}, .units = {"m"}, .options = {.segment_s = 25.6}};
  p.options.prepare.detrend = true;
  p.options.prepare.band_pass = fit::BandEdges{0.5, 2};
  const auto found = solve(p);
  const auto& r = found.responses[0];
  for (std::size_t k = 1; k + 1 < r.gain.size(); ++k) {
    const double hz = r.transfer.frequency_hz[k];
    if (hz < 0.48 || hz > 2.04) {
      EXPECT_FALSE(r.gain[k].value) << hz;
      EXPECT_THAT(r.gain[k].why_not, HasSubstr("the filters of [prepare] leave"));
    } else if (hz > 0.52 && hz < 1.96) {
      ASSERT_TRUE(r.gain[k].value) << hz;
      EXPECT_NEAR(*r.gain[k].value, gain, 4 * gain * r.transfer.gain_relative_error[k]) << hz;
    }
  }
}

// Runs of two rates are put together at one.
TEST(IrregularWaves, OfTwoRatesArePooledAtOne) {
  const double coarse = 2 * step;
  Problem p{.runs = {white_run(5, 8000), white_run(6, 8000)}, .units = {"m"}, .options = {.segment_s = 25.6}};
  auto& second = p.runs[1];
  for (double& t : second.time) t *= 2;
  p.options.prepare.resample_hz = 1 / coarse;
  const auto found = solve(p);
  EXPECT_NEAR(found.records[0].time[1] - found.records[0].time[0], coarse, 1e-12);
  const auto& r = found.responses[0];
  for (std::size_t k = 2; r.transfer.frequency_hz[k] < 0.25 / coarse; ++k)
    EXPECT_NEAR(std::abs(r.transfer.h1[k]), gain, 4 * gain * r.transfer.gain_relative_error[k]);
}

}  // namespace
}  // namespace irregular_waves_test
