#include "fit/correlated.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace correlated_test {
namespace {

using froude_test::ar1_noise;

Eigen::VectorXd as_vector(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

Eigen::MatrixXd cosine_and_sine(Eigen::Index n, double omega) {
  Eigen::MatrixXd columns(n, 2);
  for (Eigen::Index j = 0; j < n; ++j)
    columns.row(j) << std::cos(omega * static_cast<double>(j)), std::sin(omega * static_cast<double>(j));
  return columns;
}

TEST(Autoregression, OfAFirstOrderSeriesHasItsCoefficientAndAutocovariance) {
  const auto ar = fit::fit_autoregression(as_vector(ar1_noise(20000, 0.9, 1.0, 1)));
  // Standard error √((1 − φ²)/n) = 0.003; four of them.
  ASSERT_GE(ar.coefficients.size(), 1);
  EXPECT_NEAR(ar.coefficients[0], 0.9, 0.013 + 0.01 * static_cast<double>(ar.coefficients.size() > 1));
  for (int k = 1; k < 10; ++k) EXPECT_NEAR(ar.autocovariance[k] / ar.autocovariance[0], std::pow(0.9, k), 0.05);
}

TEST(Autoregression, OfWhiteNoiseIsOfOrderZero) {
  const auto ar = fit::fit_autoregression(as_vector(ar1_noise(4000, 0.0, 1.0, 2)));
  EXPECT_EQ(ar.coefficients.size(), 0);
  EXPECT_EQ(ar.autocovariance.size(), 1);
}

TEST(CorrelatedCovariance, OfWhiteResidualsIsTheOrdinaryOne) {
  const auto columns = cosine_and_sine(4000, 0.05);
  const auto c = fit::correlated_covariance(columns, as_vector(ar1_noise(4000, 0.0, 2.0, 2)));
  EXPECT_LT((c.covariance - c.white_covariance).norm(), 2e-3 * c.white_covariance.norm());  // p/n and rounding
  EXPECT_NEAR(c.effective_samples[0], 4000, 4);
  EXPECT_NEAR(c.white_covariance(0, 0), 2 * 4.0 / 4000,
              4.0 / 2000 * 5 * std::sqrt(2.0 / 4000));  // 2σ²/n, five errors of σ²
}

TEST(CorrelatedCovariance, CountsTheIndependentSquaresOfTheResiduals) {
  const auto c = fit::correlated_covariance(cosine_and_sine(20000, 0.1), as_vector(ar1_noise(20000, 0.9, 1.0, 6)));
  // Σρ² = φ²/(1 − φ²), so n(1 − φ²)/(1 + φ²) − 2 = 2097; φ is known to 0.003, which is 3 % of it; four of them.
  EXPECT_NEAR(c.dof, 2097, 0.12 * 2097);
  EXPECT_FALSE(c.dof_raised);
}

TEST(CorrelatedCovariance, OfASinusoidsAmplitudeIsTheSpectrumAtItsFrequency) {
  // Amplitude of a line at ω in noise with S(ω) = Σ γ_k cos kω: variance (2/n)² Σ γ_{j−k} c_j c_k → 2 S(ω)/n. For
  // AR(1): S = σ_w²/|1 − φ e^{−iω}|².
  for (const double omega : {0.02, 0.1, 0.8}) {
    const double phi = 0.8, sigma = 1;
    const double density = sigma * sigma * (1 - phi * phi) / (1 - 2 * phi * std::cos(omega) + phi * phi);
    const auto c =
        fit::correlated_covariance(cosine_and_sine(20000, omega), as_vector(ar1_noise(20000, phi, sigma, 3)));
    // φ is known to 0.0042, which moves S at low frequency by 2·0.0042/0.2 = 4 % per standard error; three of them.
    EXPECT_NEAR(c.covariance(0, 0) / (2 * density / 20000), 1, 0.13) << "ω = " << omega;
  }
}

TEST(CorrelatedCovariance, HardlyDependsOnTheBlock) {
  const auto columns = cosine_and_sine(20000, 0.01);  // 628 samples per period: blocks of 15 are a fortieth
  double ratio = 0, inflation = 0;
  for (std::uint64_t stream = 20; stream < 40; ++stream) {
    const auto noise = as_vector(ar1_noise(20000, 0.9, 1.0, stream));
    const auto one = fit::correlated_covariance(columns, noise, 1),
               fifteen = fit::correlated_covariance(columns, noise, 15);
    ratio += fifteen.covariance(0, 0) / one.covariance(0, 0) / 20;
    inflation += one.covariance(0, 0) / one.white_covariance(0, 0) / 20;
  }
  EXPECT_NEAR(ratio, 1, 0.08);         // single ratios scatter by 15 %, twenty of them by 3 %; some 2 % from the block
  EXPECT_NEAR(inflation, 18.83, 1.5);  // (1 − φ²)/(1 − 2φ cos ω + φ²), known to 7 %/√20 from each record
}

TEST(CorrelatedCovariance, RefusesWhatItCannotJudge) {
  const auto columns = cosine_and_sine(100, 0.3);
  const auto noise = as_vector(ar1_noise(100, 0.0, 1.0, 5));
  EXPECT_THROW(fit::correlated_covariance(columns, noise.head(99)), hydro::InputError);
  EXPECT_THROW(fit::correlated_covariance(columns, noise, 20), hydro::InputError);
  EXPECT_THROW(fit::correlated_covariance(columns, Eigen::VectorXd::Zero(100)), hydro::InputError);
  Eigen::MatrixXd twice(100, 2);
  twice << columns.col(0), columns.col(0);
  EXPECT_THROW(fit::correlated_covariance(twice, noise), hydro::InputError);
}

}  // namespace
}  // namespace correlated_test
