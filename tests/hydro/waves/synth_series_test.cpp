#include "hydro/waves/synthesis/synthesis.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace hydro::waves::synth_series_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double two_pi = 2 * std::numbers::pi;
using Extended = long double;  // 64-bit mantissa

// The reference for late samples: the phase as a product in quadruple precision, whole turns taken off before any
// rounding, then a sine of the remainder. __float128 is software, plain and slow.
double exact_sum(std::span<const double> omega, const Eigen::MatrixXcd& c, Eigen::Index signal, double start, double dt,
                 std::size_t n) {
  __extension__ using Quad = __float128;
  const Quad inverse_turn = static_cast<Quad>(0.15915494309189535) + static_cast<Quad>(-9.8393383375912429e-18);
  const Quad t = static_cast<Quad>(start) + static_cast<Quad>(dt) * static_cast<Quad>(n);
  Extended sum = 0;
  for (std::size_t j = 0; j < omega.size(); ++j) {
    const Quad turns = static_cast<Quad>(omega[j]) * t * inverse_turn;
    const Extended rest = static_cast<Extended>(turns - static_cast<Quad>(static_cast<long long>(turns)));
    const Extended angle = 2 * std::numbers::pi_v<Extended> * rest;
    const auto a = c(signal, static_cast<Eigen::Index>(j));
    sum += static_cast<Extended>(a.real()) * std::cos(angle) - static_cast<Extended>(a.imag()) * std::sin(angle);
  }
  return static_cast<double>(sum);
}

Sea random_sea(std::size_t components, double repetition_s, std::uint64_t seed) {
  const double d_omega = two_pi / repetition_s;
  return Sea::irregular(Jonswap(3, 9, 3.3),
                        {FftGrid{repetition_s}, 0.2, 0.2 + static_cast<double>(components) * d_omega, seed},
                        {Angle::from_degrees(20)}, Water{});
}

std::vector<double> frequencies(const Sea& sea) {
  std::vector<double> omega;
  for (const Component& w : sea.components()) omega.push_back(w.omega);
  return omega;
}

Eigen::MatrixXcd some_signals(const Sea& sea, Eigen::Index signals) {
  Eigen::MatrixXcd c(signals, static_cast<Eigen::Index>(sea.components().size()));
  for (Eigen::Index s = 0; s < signals; ++s)
    for (Eigen::Index j = 0; j < c.cols(); ++j) {
      const Component& w = sea.components()[static_cast<std::size_t>(j)];
      c(s, j) = std::polar(w.amplitude, w.phase + 0.7 * static_cast<double>(s));
    }
  return c;
}

constexpr SeriesMethod free_methods[] = {SeriesMethod::blocked_phasors, SeriesMethod::nonuniform_fft,
                                         SeriesMethod::plain_sum};

TEST(Synthesis, MethodsAgreeWithTheExactSumWithinTheErrorEachStates) {
  const Sea sea = random_sea(150, 900, 3);
  const auto omega = frequencies(sea);
  const Eigen::MatrixXcd c = some_signals(sea, 4);
  for (const std::size_t samples : {1ul, 2ul, 15ul, 16ul, 17ul, 1000ul, 1024ul, 3001ul, 20001ul})
    for (const auto method : free_methods) {
      const TimeGrid grid{0.37, samples, -12.5};  // neither the step nor the start suit the grid
      const Synthesis made = synthesise(sea, grid, c, method);
      ASSERT_EQ(made.series.rows(), static_cast<Eigen::Index>(samples));
      ASSERT_EQ(made.report.method, method);
      EXPECT_LT(made.report.relative_error, 1e-12);
      for (const std::size_t n : {std::size_t{0}, samples / 3, samples / 2, samples - 1})
        for (Eigen::Index s = 0; s < 4; ++s)
          EXPECT_NEAR(made.series(static_cast<Eigen::Index>(n), s), exact_sum(omega, c, s, -12.5, 0.37, n),
                      made.report.relative_error * c.row(s).cwiseAbs().sum())
              << name_of(method) << ", sample " << n << " of " << samples;
    }
}

TEST(Synthesis, DecimatedRecordsAgreeWithTheExactSumWithinTheErrorTheyState) {
  const Sea sea = random_sea(150, 900, 3);  // up to 1.25 rad/s: one sample in 2 … 64 is summed
  const auto omega = frequencies(sea);
  const Eigen::MatrixXcd c = some_signals(sea, 3);
  for (const double dt : {0.6, 0.31, 0.11, 0.05, 0.013, 0.001})
    for (const std::size_t samples : {1ul, 7ul, 64ul, 5000ul}) {
      const Synthesis made = synthesise(sea, {dt, samples, 33.3}, c, SeriesMethod::decimated);
      EXPECT_LT(made.report.relative_error, 5e-12);
      for (const std::size_t n : {std::size_t{0}, samples / 3, samples / 2, samples - 1})
        for (Eigen::Index s = 0; s < 3; ++s)
          EXPECT_NEAR(made.series(static_cast<Eigen::Index>(n), s), exact_sum(omega, c, s, 33.3, dt, n),
                      made.report.relative_error * c.row(s).cwiseAbs().sum())
              << dt << " s, sample " << n << " of " << samples;
    }
  EXPECT_THAT(
      [&] {
        synthesise(sea, {1.0, 10}, c, SeriesMethod::decimated);
      },
      ThrowsMessage<InputError>(HasSubstr("none can be interpolated")));
}

TEST(Synthesis, InverseFftAgreesWithTheExactSumWithinTheErrorItStates) {
  const Sea sea = random_sea(150, 900, 3);
  const auto omega = frequencies(sea);
  const Eigen::MatrixXcd c = some_signals(sea, 2);
  const Synthesis made = synthesise(sea, {0.5, 2000}, c, SeriesMethod::inverse_fft);  // 1.1 repetitions
  EXPECT_LT(made.report.relative_error, 1e-12);
  for (const std::size_t n : {0ul, 700ul, 1799ul, 1800ul, 1999ul})
    for (Eigen::Index s = 0; s < 2; ++s)
      EXPECT_NEAR(made.series(static_cast<Eigen::Index>(n), s), exact_sum(omega, c, s, 0, 0.5, n),
                  made.report.relative_error * c.row(s).cwiseAbs().sum());
}

TEST(Synthesis, OneWaveKeepsItsPhaseForADayAtTenHertz) {
  // 864 000 samples; at 30 rad/s the phase is 2.6e6 rad, of which a double has 4.7e-10 rad left. The promise is 1e-9.
  constexpr std::size_t day = 864000;
  for (const double omega : {0.07, 0.7853981, 3.0 / 7, 30.1}) {
    const Eigen::MatrixXcd c = Eigen::MatrixXcd::Constant(1, 1, std::complex<double>(1, 0));
    const std::vector<double> one{omega};
    for (const auto method : {SeriesMethod::blocked_phasors, SeriesMethod::nonuniform_fft, SeriesMethod::decimated}) {
      if (method == SeriesMethod::decimated && omega > 7) continue;  // needs every sample
      const auto made = synthesise(one, {0.1, day}, c, method);
      for (const std::size_t n : {day - 1, day - 7, day / 2 + 3})
        EXPECT_NEAR(made.series(static_cast<Eigen::Index>(n), 0), exact_sum(one, c, 0, 0, 0.1, n), 1e-12)
            << name_of(method) << " at " << omega << " rad/s, sample " << n;
    }
  }
}

TEST(Synthesis, ASeaKeepsItsPhaseForADayAtTenHertz) {
  constexpr std::size_t day = 864000;
  const Sea sea = random_sea(40, 86400, 9);  // the repetition is the day itself: all three methods apply
  const auto omega = frequencies(sea);
  const Eigen::MatrixXcd c = some_signals(sea, 1);
  const double size = c.cwiseAbs().sum();
  for (const auto method : {SeriesMethod::inverse_fft, SeriesMethod::blocked_phasors, SeriesMethod::nonuniform_fft,
                            SeriesMethod::decimated}) {
    const auto made = synthesise(sea, {0.1, day}, c, method);
    EXPECT_LT(made.report.relative_error, 1e-9) << name_of(method);
    for (const std::size_t n : {day - 1, day - 1000, day / 2})
      // A phase that is off by 1e-9 in every wave would show as 1e-9 Σ|c|.
      EXPECT_NEAR(made.series(static_cast<Eigen::Index>(n), 0), exact_sum(omega, c, 0, 0, 0.1, n), 1e-9 * size)
          << name_of(method);
  }
}

TEST(Synthesis, ALateStartIsTheSameAsTheLatePartOfALongRecord) {
  const Sea sea = random_sea(60, 777, 5);
  const Eigen::MatrixXcd c = some_signals(sea, 2);
  const double dt = 0.25;  // a power of two: start and samples then meet exactly
  for (const auto method : free_methods) {
    const auto whole = synthesise(sea, {dt, 40000}, c, method).series;
    const auto part = synthesise(sea, {dt, 500, 39000 * dt}, c, method).series;
    EXPECT_LT((whole.middleRows(39000, 500) - part).cwiseAbs().maxCoeff(), 1e-12 * c.row(0).cwiseAbs().sum())
        << name_of(method);
  }
}

TEST(Synthesis, SignalsMadeTogetherAreThoseMadeAlone) {
  const Sea sea = random_sea(130, 777, 5);  // more than one chunk of components
  const Eigen::MatrixXcd c = some_signals(sea, 7);
  for (const auto method : free_methods) {
    const auto together = synthesise(sea, {0.3, 3000}, c, method).series;
    for (Eigen::Index s = 0; s < 7; ++s) {
      const auto alone = synthesise(sea, {0.3, 3000}, Eigen::MatrixXcd(c.row(s)), method).series;
      EXPECT_TRUE((together.col(s).array() == alone.col(0).array()).all()) << name_of(method) << ", signal " << s;
    }
  }
}

TEST(Synthesis, NegativeFrequenciesAndZeroAreSummedLikeAnyOther) {
  // Second-order differences come with such frequencies: Re(c e^{−iωt}) = Re(conj(c) e^{iωt}).
  const std::vector<double> omega{-0.8, 0.0, 0.8};
  Eigen::MatrixXcd c(1, 3);
  c << std::complex<double>(0.3, -0.2), std::complex<double>(1.5, 9), std::complex<double>(-0.1, 0.4);
  for (const auto method : free_methods) {
    const auto made = synthesise(omega, {0.5, 300}, c, method).series;
    for (const Eigen::Index n : {0, 5, 299}) {
      const double angle = 0.8 * 0.5 * static_cast<double>(n);
      const double closed = 1.5 + (0.3 - 0.1) * std::cos(angle) + (-0.2 - 0.4) * std::sin(angle);
      EXPECT_NEAR(made(n, 0), closed, 1e-12) << name_of(method);
    }
  }
}

TEST(Synthesis, TakesTheTransformWhereTheStepSuitsTheSeaAndNotWhereItDoesNot) {
  const Sea sea = random_sea(500, 3600, 1);
  const Eigen::MatrixXcd c = some_signals(sea, 1);
  // 1.2 s: five samples in the shortest period, so that none is left to interpolate.
  EXPECT_EQ(synthesise(sea, {1.2, 3000}, c).report.method, SeriesMethod::inverse_fft);
  EXPECT_NE(synthesise(sea, {1.2, 3000, 1.0}, c).report.method, SeriesMethod::inverse_fft);
  EXPECT_NE(synthesise(sea, {1.2, 1}, c).report.method, SeriesMethod::inverse_fft);     // one sample needs no transform
  EXPECT_EQ(synthesise(sea, {0.05, 72000}, c).report.method, SeriesMethod::decimated);  // 120 samples a period
}

TEST(Synthesis, RefusesComponentsAtOrAboveNyquistByAnyMethod) {
  const std::vector<double> omega{1.0, -std::numbers::pi};
  const Eigen::MatrixXcd c = Eigen::MatrixXcd::Ones(1, 2);
  for (const auto method : free_methods)
    EXPECT_THAT(
        [&] {
          synthesise(omega, {1.0, 10}, c, method);
        },
        ThrowsMessage<InputError>(AllOf(HasSubstr("period 2 s"), HasSubstr("every 1 s"))));
  EXPECT_NO_THROW(synthesise(omega, {0.99, 10}, c));
}

TEST(Synthesis, RefusesWhatItCannotUse) {
  const Sea sea = random_sea(10, 100, 1);
  const Eigen::MatrixXcd c = some_signals(sea, 1);
  EXPECT_THAT(
      [&] {
        synthesise(sea, {0.3, 10}, c, SeriesMethod::inverse_fft);
      },
      ThrowsMessage<InputError>(HasSubstr("does not suit an inverse FFT")));
  EXPECT_THAT([&] { synthesise(sea, {0.1, 10, NAN}, c); }, ThrowsMessage<InputError>(HasSubstr("first instant")));
  EXPECT_THAT([&] { synthesise(sea, {-0.1, 10}, c); }, ThrowsMessage<InputError>(HasSubstr("got -0.1 s")));
  EXPECT_THROW(synthesise(sea, {0.1, 10}, Eigen::MatrixXcd(1, 3)), InputError);
  Eigen::MatrixXcd broken = c;
  broken(0, 2) = {NAN, 0};
  EXPECT_THAT([&] { synthesise(sea, {0.1, 10}, broken); }, ThrowsMessage<InputError>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace hydro::waves::synth_series_test
