#include "hydro/signal/harmonics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace harmonics_test {
namespace {

using hydro::signal::fit_harmonics;
using Complex = std::complex<double>;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Record {
  std::vector<double> time, values;
};

Record made(double from, double duration, std::size_t n, double mean, const std::vector<double>& omega,
            const std::vector<Complex>& amplitude, double jitter = 0) {
  const hydro::RandomStream random(3, 0);
  Record r;
  for (std::size_t j = 0; j < n; ++j) {
    const double step = duration / static_cast<double>(n - 1);
    r.time.push_back(from + step * (static_cast<double>(j) + jitter * (random.uniform(j) - 0.5)));
    double x = mean;
    for (std::size_t k = 0; k < omega.size(); ++k)
      x += (amplitude[k] * std::polar(1.0, omega[k] * r.time.back())).real();
    r.values.push_back(x);
  }
  return r;
}

TEST(Harmonics, RecoverMeanAmplitudesAndPhasesOfAnUnevenRecordThatFillsNoWholePeriod) {
  const std::vector<double> omega{0.7, 1.4, 1.53};
  const std::vector<Complex> a{std::polar(2.0, 0.4), std::polar(0.3, -2.5), std::polar(1.1, 3.0)};
  const auto record = made(3.0, 61.7, 400, -0.8, omega, a, 0.6);
  const auto h = fit_harmonics(record.time, record.values, omega);
  EXPECT_NEAR(h.mean, -0.8, 1e-12);  // rounding times the condition number, which is below 10 here
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT(std::abs(h.amplitude[k] - a[k]), 1e-12);
  EXPECT_LT(h.residual_rms, 1e-13);
}

TEST(Harmonics, CountTimeFromTheZeroOfTheTimeColumnHoweverFarAway) {
  const auto record = made(1e4, 20, 300, 0, {2.0}, {Complex(0, 1)});
  const auto h = fit_harmonics(record.time, record.values, std::vector<double>{2.0});
  EXPECT_LT(std::abs(h.amplitude[0] - Complex(0, 1)), 1e-10);  // ωt = 2e4 rad is known to 4e-12
}

TEST(Harmonics, LeaveInTheResidualWhatWasNotAskedFor) {
  // Exactly ten and twenty periods: the columns are orthogonal and the residual is the whole second harmonic.
  const double omega = 2 * 3.14159265358979323846;
  Record r = made(0, 10 - 0.01, 1000, 0, {omega, 2 * omega}, {1.0, 0.5});
  const auto h = fit_harmonics(r.time, r.values, std::vector<double>{omega});
  EXPECT_NEAR(h.residual_rms, 0.5 / std::sqrt(2.0), 1e-12);
  EXPECT_LT(std::abs(h.amplitude[0] - 1.0), 1e-12);
}

TEST(Harmonics, WithNoFrequenciesGiveTheMean) {
  const auto h = fit_harmonics(std::vector<double>{0, 1}, std::vector<double>{1, 3}, {});
  EXPECT_DOUBLE_EQ(h.mean, 2);
  EXPECT_DOUBLE_EQ(h.residual_rms, 1);
}

TEST(Harmonics, RefuseWhatTheRecordCannotAnswer) {
  const auto record = made(0, 10, 100, 0, {1.0}, {1.0});
  const auto fit = [&](const std::vector<double>& omega) {
    return [&record, omega] { fit_harmonics(record.time, record.values, omega); };
  };
  EXPECT_THAT(fit({1.0, 1.0 + 1e-9}), ThrowsMessage<hydro::InputError>(HasSubstr("cannot tell")));
  EXPECT_THAT(fit({1e-6}), ThrowsMessage<hydro::InputError>(HasSubstr("cannot tell")));
  EXPECT_THAT(fit({1.0, 1.0}), ThrowsMessage<hydro::InputError>(HasSubstr("given twice")));
  EXPECT_THAT(fit({0.0}), ThrowsMessage<hydro::InputError>(HasSubstr("must be positive")));
  EXPECT_THROW(fit_harmonics(std::vector<double>{0, 1}, std::vector<double>{1, 2}, std::vector<double>{1.0}),
               hydro::InputError);
  EXPECT_THROW(fit_harmonics(std::vector<double>{0, 1}, std::vector<double>{1}, {}), hydro::InputError);
  EXPECT_THROW(fit_harmonics(std::vector<double>{0, 1}, std::vector<double>{1, std::nan("")}, {}), hydro::InputError);
}

}  // namespace
}  // namespace harmonics_test
